/* Figures of curves: columns of tables against each other, entries of headers against numbers of
 * points. */
#include "answers/figure.h"

#include "base/text.h"

#include <math.h>
#include <string.h>

/* ---- questions of a table -------------------------------------------------------------------- */

ps_cell ps_entry_of(const ps_table *table, const char *first, size_t number, const char *key) {
    size_t num_before = 0;
    const bool has_blocks = ps_table_find_meta(table, first).kind != PS_CELL_MISSING;
    for (size_t i = 0; i < ps_table_num_meta(table); i++) {
        const char *own = NULL;
        const ps_cell value = ps_table_meta(table, i, &own);
        num_before += strcmp(own, first) == 0;
        if (strcmp(own, key) == 0 && (!has_blocks || num_before == number + 1)) {
            return value;
        }
    }
    return PS_MISSING;
}

/* Tables of several questions have their rows one after the other, with what they are of in their
 * first columns. */
static bool is_lead(const ps_picture_kind *what, const ps_table *table, size_t column) {
    const char *const name = ps_table_column_name(table, column);
    return strcmp(name, "sampler") == 0 || strcmp(name, "points") == 0 ||
           strcmp(name, "smoothness") == 0 ||
           (strcmp(name, "integrand") == 0 && what->panels == NULL);
}

static bool are_alike(ps_cell a, ps_cell b) {
    return a.kind == PS_CELL_TEXT ? strcmp(a.text, b.text) == 0
                                  : ps_cell_number(a) == ps_cell_number(b);
}

static bool is_of_same(const ps_picture_kind *what, const ps_table *table, size_t a, size_t b) {
    size_t column = 0;
    while (column < ps_table_num_columns(table) && is_lead(what, table, column) &&
           are_alike(ps_table_cell(table, a, column), ps_table_cell(table, b, column))) {
        column++;
    }
    return column == ps_table_num_columns(table) || !is_lead(what, table, column);
}

/* ---- curves ---------------------------------------------------------------------------------- */

/* A row of a part, the number of its question among those of its table, and its curve. */
typedef struct place {
    const ps_chart_part *part;
    size_t row, number, curve;
} place;

/* Texts are borrowed from the parts, but for the label: what tells it apart from others. */
typedef struct curve {
    const ps_chart_part *part;                /* of its first place */
    size_t number;                            /* of the first question */
    const char *label, *sampler, *panel_name; /* ""; there is no such column */
    size_t panel, kind;
    size_t num; /* of places */
} curve;

typedef struct picture {
    ps_pool *memory;
    const ps_chart *chart;
    ps_error *error;
    bool is_of_counts; /* numbers of points are along a curve */
    bool is_of_panels; /* small ones, which share a key */
    size_t num_places, num_curves, num_kinds;
    place *places;
    curve *curves;
    size_t num_panels, num_series;
    ps_panel *panels;
    ps_series *series;
} picture;

/* A command whose table has one sampler or set, or files, has no word for it. */
static const char *name_part(const picture *self, const ps_chart_part *part) {
    const ps_request *const request = part->request;
    size_t column = 0;
    if (self->chart->what->panels == NULL && self->chart->num_parts == 1 &&
        ps_table_find_column(part->table, "integrand", &column)) {
        return ""; /* its functions are told apart */
    }
    return part->label[0] != '\0' || self->chart->what->panels == NULL ||
                   ps_table_find_column(part->table, "sampler", &column)
               ? part->label
           : request->num_sources > 0 ? ps_request_source_name(request, 0)
                                      : "files";
}

static pspec_status write_label(const picture *self, const place *own, const char **out) {
    const ps_table *const table = own->part->table;
    ps_text label = {0};
    ps_text_append(&label, "%s", name_part(self, own->part));
    for (size_t i = 0; i < ps_table_num_columns(table) && is_lead(self->chart->what, table, i);
         i++) {
        const ps_cell cell = ps_table_cell(table, own->row, i);
        const char *const comma = label.length > 0 ? ", " : "";
        const bool is_space = strcmp(ps_table_column_name(table, i), "smoothness") == 0;
        if (cell.kind == PS_CELL_TEXT) {
            ps_text_append(&label, "%s%s", comma, cell.text);
        } else if (is_space && own->part->request->num_smoothness > 1) {
            ps_text_append(&label, "%ss = %g", comma, cell.number);
        } else if (!is_space && !self->is_of_counts) {
            ps_text_append(&label, "%sN = %lld", comma, (long long)cell.integer);
        }
    }
    return ps_text_keep(out, self->memory, &label, self->error);
}

/* The curve of a place, which may be its first. Curves of a panel are told apart; those with the
 * same label are of a kind in all panels. */
static pspec_status find_curve(picture *self, place *own) {
    const char *const panels = self->chart->what->panels;
    const ps_table *const table = own->part->table;
    curve found = {.part = own->part,
                   .number = own->number,
                   .sampler = ps_cell_text(ps_table_find_cell(table, own->row, "sampler")),
                   .panel_name = "",
                   .panel = panels != NULL ? self->num_panels : own->part->panel,
                   .kind = self->num_kinds};
    PS_TRY(write_label(self, own, &found.label));
    if (panels != NULL) {
        const ps_cell cell = ps_table_find_cell(table, own->row, panels);
        found.panel_name =
            ps_cell_text(cell.kind == PS_CELL_TEXT ? cell : ps_table_find_meta(table, panels));
    }
    for (size_t i = 0; i < self->num_curves; i++) {
        const curve *const other = &self->curves[i];
        const bool is_kind = strcmp(other->label, found.label) == 0;
        const bool is_panel = panels != NULL ? strcmp(other->panel_name, found.panel_name) == 0
                                             : other->panel == found.panel;
        if (is_kind && is_panel && (self->is_of_counts || other->part == found.part)) {
            own->curve = i;
            return PSPEC_OK;
        }
        found.kind = is_kind ? other->kind : found.kind;
        found.panel = is_panel ? other->panel : found.panel;
    }
    self->num_kinds += found.kind == self->num_kinds;
    self->num_panels += found.panel == self->num_panels && panels != NULL;
    own->curve = self->num_curves;
    self->curves[self->num_curves++] = found;
    return PSPEC_OK;
}

/* Of header entries a question has one place. */
static pspec_status add_places(picture *self, const ps_chart_part *part) {
    const ps_picture_kind *const what = self->chart->what;
    place own = {.part = part};
    for (size_t row = 0; row < ps_table_num_rows(part->table); row++) {
        const bool is_same = row > 0 && is_of_same(what, part->table, row - 1, row);
        own.row = row;
        own.number += row > 0 && !is_same;
        if (is_same && what->is_of_entries) {
            continue;
        }
        if (!is_same || what->panels != NULL) {
            PS_TRY(find_curve(self, &own));
        }
        self->curves[own.curve].num++;
        self->places[self->num_places++] = own;
    }
    return PSPEC_OK;
}

static pspec_status list_curves(picture *self) {
    const ps_chart *const chart = self->chart;
    size_t most = 0;
    for (size_t i = 0; i < chart->num_parts; i++) {
        most += ps_table_num_rows(chart->parts[i].table);
    }
    PS_TRY(PS_POOL_NEW(self->memory, &self->places, most, "a picture", self->error));
    PS_TRY(PS_POOL_NEW(self->memory, &self->curves, most, "a picture", self->error));
    self->num_panels = chart->what->panels != NULL ? 0 : chart->num_panels;
    for (size_t i = 0; i < chart->num_parts; i++) {
        PS_TRY(add_places(self, &chart->parts[i]));
    }
    return PSPEC_OK;
}

/* ---- numbers --------------------------------------------------------------------------------- */

static double entry_of(const curve *own, const char *key) {
    return ps_cell_number(ps_entry_of(own->part->table, "sampler", own->number, key));
}

/* Those of a curve. */
static pspec_status take(const picture *self, const double **out, const curve *own,
                         const char *name) {
    double *numbers = NULL;
    size_t num = 0;
    PS_TRY(PS_POOL_NEW(self->memory, &numbers, own->num, "a curve", self->error));
    for (size_t i = 0; i < self->num_places; i++) {
        const place *const at = &self->places[i];
        if (&self->curves[at->curve] == own) {
            const ps_table *const table = at->part->table;
            numbers[num++] = ps_cell_number(self->chart->what->is_of_entries
                                                ? ps_entry_of(table, "sampler", at->number, name)
                                                : ps_table_find_cell(table, at->row, name));
        }
    }
    *out = numbers;
    return PSPEC_OK;
}

static bool has_column(const curve *own, const char *name) {
    size_t column = 0;
    return name != NULL && ps_table_find_column(own->part->table, name, &column);
}

/* The same where there is such a column. */
static pspec_status take_beside(const picture *self, const double **out, const curve *own,
                                const char *name) {
    return has_column(own, name) ? take(self, out, own, name) : PSPEC_OK;
}

/* ---- series ---------------------------------------------------------------------------------- */

/* What pure noise comes to, where the table has a level of it, and what is rounding. For powers
 * that is the square of the error of S, otherwise the error itself; pair sums have it in units of
 * W^2. */
static void take_limits(ps_series *series, const curve *own, bool is_power) {
    const double error = entry_of(own, "predicted_error");
    const double sum = entry_of(own, "weight_sum");
    if (error > 0) {
        series->floor = is_power ? error * error : error * (isfinite(sum) ? sum * sum : 1);
    }
    series->num_realizations =
        isfinite(entry_of(own, "noise_level_db")) ? entry_of(own, "realizations") : 1;
}

/* What lies below the last digit of the line that all curves have is rounding: they are sums of
 * what comes to that. */
static pspec_status take_floor(const picture *self, ps_series *series, const curve *own,
                               const ps_picture_line *of_all) {
    const double *numbers = NULL;
    PS_TRY(take(self, &numbers, own, of_all->y));
    for (size_t k = 0; k < own->num; k++) {
        series->floor = fmax(series->floor, ps_series_floor(&(ps_series){0}, numbers[k]));
    }
    return PSPEC_OK;
}

/* What is checked may be of rings or of degrees. Panels of spectra have no room for errors. */
static pspec_status take_numbers(const picture *self, ps_series *series, const curve *own,
                                 const ps_picture_line *line) {
    const ps_picture_kind *const what = self->chart->what;
    const bool is_there = what->is_of_entries || has_column(own, what->x);
    PS_TRY(take(self, &series->x, own, is_there ? what->x : "degree"));
    PS_TRY(take(self, &series->y, own, line->y));
    if (self->is_of_panels) {
        return PSPEC_OK;
    }
    PS_TRY(take_beside(self, &series->error, own, line->error));
    PS_TRY(take_beside(self, &series->low, own, line->low));
    PS_TRY(take_beside(self, &series->high, own, line->high));
    if (what->is_spectrum) {
        PS_TRY(take_beside(self, &series->anisotropy, own, "anisotropy_db"));
        PS_TRY(take_beside(self, &series->fit, own, "fit"));
    }
    return PSPEC_OK;
}

/* In the key, where lines with names of their own are if they are of all curves, or there is one.
 * Curves against numbers of points have their slopes behind them, unless the key is of many panels.
 */
static pspec_status write_name(const picture *self, ps_series *series, const curve *own,
                               const ps_picture_line *line) {
    const ps_picture_kind *const what = self->chart->what;
    const bool has_own = line->is_of_all || self->num_kinds == 1;
    const char *const name = line->name == NULL ? own->label : has_own ? line->name : "";
    const bool has_slope = self->is_of_counts && !self->is_of_panels;
    const bool is_none = line->name != NULL && name[0] == '\0';
    ps_uncertain slope = PS_UNCERTAIN_NONE;
    ps_text text = {0};
    if (is_none || (name[0] == '\0' && !has_slope && !self->is_of_panels)) {
        return PSPEC_OK;
    }
    ps_text_append(&text, "%s", name);
    if (line->name == NULL && what->find_slope != NULL) {
        slope = what->find_slope(own->part->table, own->sampler, own->panel_name);
    }
    if (has_slope && isfinite(slope.value)) {
        ps_text_append(&text, ": slope %.4g (%.2g)", slope.value, slope.error);
    } else if (has_slope) {
        ps_series_say_slope(series, &text);
    }
    return ps_text_keep(&series->label, self->memory, &text, self->error);
}

static size_t num_lines(const ps_picture_kind *what) {
    size_t num = 0;
    while (what->lines[num].y != NULL) {
        num++;
    }
    return num;
}

/* Lines with formulas are kinds of their own. Of bounds there may be none. */
static pspec_status add_line(picture *self, const curve *own, size_t number) {
    const ps_picture_kind *const what = self->chart->what;
    const ps_picture_line *const line = &what->lines[number];
    const ps_picture_line *const last = &what->lines[num_lines(what) - 1];
    ps_series *const series = &self->series[self->num_series++];
    *series = (ps_series){.look = self->is_of_panels ? PS_LOOK_SMALL : line->look,
                          .kind = line->formula != NULL ? own->kind * num_lines(what) + number
                                                        : own->kind,
                          .formula = line->formula,
                          .num = own->num,
                          .num_realizations = 1};
    PS_TRY(take_numbers(self, series, own, line));
    if (last->is_of_all) {
        PS_TRY(take_floor(self, series, own, last));
    } else if (!what->is_of_entries) {
        take_limits(series, own, what->is_spectrum);
    }
    if (line->look == PS_LOOK_BOUND && !ps_series_is_drawn(series)) {
        self->num_series--;
        return PSPEC_OK;
    }
    return write_name(self, series, own, line);
}

/* ---- panels ---------------------------------------------------------------------------------- */

/* Curves by their kinds, then the line that all of them have. */
static pspec_status fill_panel(picture *self, size_t panel) {
    const ps_chart *const chart = self->chart;
    const size_t num = num_lines(chart->what);
    const size_t num_own = num - chart->what->lines[num - 1].is_of_all;
    const size_t begin = self->num_series;
    const curve *first = NULL;
    for (size_t kind = 0; kind < self->num_kinds; kind++) {
        for (size_t i = 0; i < self->num_curves; i++) {
            const curve *const own = &self->curves[i];
            const bool is_own = own->panel == panel && own->kind == kind;
            first = own->panel == panel && (first == NULL || own < first) ? own : first;
            for (size_t k = 0; is_own && k < num_own; k++) {
                PS_TRY(add_line(self, own, k));
            }
        }
    }
    if (num_own < num && first != NULL) {
        PS_TRY(add_line(self, first, num_own));
    }
    /* Scenes name the panels that they make, of which there may be fewer. */
    self->panels[panel] = (ps_panel){.title = chart->what->panels != NULL ? first->panel_name
                                              : chart->panels != NULL     ? chart->panels[panel]
                                                                          : NULL,
                                     .num_series = self->num_series - begin,
                                     .series = self->series + begin};
    return PSPEC_OK;
}

static pspec_status fill_panels(picture *self) {
    const size_t most = PS_MOST_LINES * self->num_curves;
    PS_TRY(PS_POOL_NEW(self->memory, &self->series, most, "a picture", self->error));
    PS_TRY(PS_POOL_NEW(self->memory, &self->panels, self->num_panels, "a picture", self->error));
    for (size_t panel = 0; panel < self->num_panels; panel++) {
        PS_TRY(fill_panel(self, panel));
    }
    return PSPEC_OK;
}

pspec_status ps_lines_figure(ps_figure *out, ps_pool *memory, const ps_chart *chart,
                             ps_error *error) {
    const ps_picture_kind *const what = chart->what;
    const ps_table *const table = chart->parts[0].table;
    picture self = {.memory = memory,
                    .chart = chart,
                    .error = error,
                    .is_of_counts = what->dealing == PS_OF_COUNTS,
                    .is_of_panels = chart->num_panels > 1};
    size_t column = 0;
    PS_TRY(list_curves(&self));
    PS_TRY(fill_panels(&self));
    const bool is_spectrum = what->is_spectrum && !self.is_of_panels;
    const bool is_there = what->is_of_entries || ps_table_find_column(table, what->x, &column);
    *out = (ps_figure){.form = self.is_of_panels ? PS_FIGURE_PANELS
                               : is_spectrum     ? PS_FIGURE_SPECTRA
                                                 : PS_FIGURE_FRAME,
                       .title = chart->title,
                       .x_label = is_there ? what->x_label : "degree",
                       .y_label = what->y_label,
                       .axes = chart->axes,
                       .is_log_x = what->is_log_x && !is_spectrum,
                       .is_log_y = what->is_log_y && !is_spectrum,
                       .num_panels = self.num_panels,
                       .panels = self.panels,
                       .shares_axes = true,
                       .on_sphere =
                           what->is_spectrum && ps_table_find_column(table, "degree", &column)};
    return PSPEC_OK;
}
