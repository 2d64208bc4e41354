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

/* The rows of one question; tables of several have them one after the other, with what they are of
 * in their first columns. */
typedef struct curve {
    const ps_chart_part *part;
    size_t number; /* of the question among those of its table */
    size_t first, num;
    const char *label;
    const char *line; /* the label without the number of points */
} curve;

static bool is_lead(const ps_table *table, size_t column) {
    const char *const name = ps_table_column_name(table, column);
    return strcmp(name, "sampler") == 0 || strcmp(name, "points") == 0;
}

static bool are_alike(ps_cell a, ps_cell b) {
    return a.kind == PS_CELL_TEXT ? strcmp(a.text, b.text) == 0 : a.integer == b.integer;
}

static bool is_of_same(const ps_table *table, size_t a, size_t b) {
    size_t column = 0;
    while (column < ps_table_num_columns(table) && is_lead(table, column) &&
           are_alike(ps_table_cell(table, a, column), ps_table_cell(table, b, column))) {
        column++;
    }
    return column == ps_table_num_columns(table) || !is_lead(table, column);
}

static pspec_status write_labels(curve *out, ps_pool *memory, ps_error *error) {
    const ps_table *const table = out->part->table;
    ps_text label = {0};
    ps_text line = {0};
    ps_text_append(&label, "%s", out->part->label);
    ps_text_append(&line, "%s", out->part->label);
    for (size_t i = 0; i < ps_table_num_columns(table) && is_lead(table, i) && out->num > 0; i++) {
        const ps_cell cell = ps_table_cell(table, out->first, i);
        const char *const comma = label.length > 0 ? ", " : "";
        if (cell.kind == PS_CELL_TEXT) {
            ps_text_append(&label, "%s%s", comma, cell.text);
            ps_text_append(&line, "%s%s", comma, cell.text);
        } else {
            ps_text_append(&label, "%sN = %lld", comma, (long long)cell.integer);
        }
    }
    const pspec_status status = ps_text_keep(&out->label, memory, &label, error);
    if (status != PSPEC_OK) {
        ps_text_free(&line);
        return status;
    }
    return ps_text_keep(&out->line, memory, &line, error);
}

static pspec_status list_curves(curve **out, size_t *num, ps_pool *memory, const ps_chart *chart,
                                ps_error *error) {
    size_t most = 0;
    for (size_t i = 0; i < chart->num_parts; i++) {
        most += ps_table_num_rows(chart->parts[i].table);
    }
    *num = 0;
    PS_TRY(PS_POOL_NEW(memory, out, most, "a picture", error));
    for (size_t i = 0; i < chart->num_parts; i++) {
        const ps_chart_part *const part = &chart->parts[i];
        size_t number = 0;
        for (size_t row = 0; row < ps_table_num_rows(part->table); number++) {
            curve *const own = &(*out)[(*num)++];
            *own = (curve){.part = part, .number = number, .first = row};
            while (row < ps_table_num_rows(part->table) &&
                   is_of_same(part->table, own->first, row)) {
                row++;
            }
            own->num = row - own->first;
            PS_TRY(write_labels(own, memory, error));
        }
    }
    return PSPEC_OK;
}

static double entry_of(const curve *own, const char *key) {
    return ps_cell_number(ps_entry_of(own->part->table, "sampler", own->number, key));
}

/* ---- figures --------------------------------------------------------------------------------- */

typedef struct picture {
    ps_figure *figure;
    ps_pool *memory;
    const ps_chart *chart;
    ps_error *error;
    curve *curves;
    size_t num_curves;
    size_t num; /* of series */
    ps_series *series;
    size_t *panels; /* of each */
} picture;

static pspec_status begin(picture *self) {
    PS_TRY(list_curves(&self->curves, &self->num_curves, self->memory, self->chart, self->error));
    const size_t most = PS_MOST_LINES * self->num_curves;
    PS_TRY(PS_POOL_NEW(self->memory, &self->series, most, "a picture", self->error));
    return PS_POOL_NEW(self->memory, &self->panels, most, "a picture", self->error);
}

static ps_series *add_series(picture *self, const curve *own, const char *label) {
    self->panels[self->num] = own->part->panel;
    ps_series *const series = &self->series[self->num++];
    series->label = label;
    series->num_realizations = 1;
    series->look = self->chart->num_panels > 1 ? PS_LOOK_SMALL : PS_LOOK_LINE;
    return series;
}

/* Curves of one panel are told apart; those with the same label look the same in all panels. */
static void number_kinds(const picture *self) {
    size_t num_kinds = 0;
    for (size_t i = 0; i < self->num; i++) {
        size_t same = self->chart->num_panels > 1 ? 0 : i;
        while (same < i && strcmp(self->series[same].label, self->series[i].label) != 0) {
            same++;
        }
        self->series[i].kind = same < i ? self->series[same].kind : num_kinds++;
    }
}

static pspec_status finish(picture *self) {
    const ps_chart *const chart = self->chart;
    const ps_picture_kind *const what = chart->what;
    ps_panel *panels = NULL;
    PS_TRY(PS_POOL_NEW(self->memory, &panels, chart->num_panels, "a picture", self->error));
    number_kinds(self);
    for (size_t i = 0; i < self->num; i++) {
        ps_panel *const panel = &panels[self->panels[i]];
        panel->series = panel->num_series++ == 0 ? &self->series[i] : panel->series;
        panel->title = chart->panels != NULL ? chart->panels[self->panels[i]] : NULL;
    }
    *self->figure = (ps_figure){.form = chart->num_panels > 1 ? PS_FIGURE_PANELS
                                        : what->is_spectrum   ? PS_FIGURE_SPECTRA
                                                              : PS_FIGURE_FRAME,
                                .title = chart->title,
                                .x_label = what->x_label,
                                .y_label = what->y_label,
                                .axes = chart->axes,
                                .num_panels = chart->num_panels,
                                .panels = panels,
                                .shares_axes = true};
    if (self->figure->form != PS_FIGURE_SPECTRA) {
        self->figure->is_log_x = what->is_log_x;
        self->figure->is_log_y = what->is_log_y;
    }
    return PSPEC_OK;
}

/* ---- columns --------------------------------------------------------------------------------- */

/* The rows of a curve in a column; NULL: there is no such column. */
static pspec_status take_column(picture *self, const double **out, const curve *own,
                                const char *name) {
    size_t column = 0;
    double *numbers = NULL;
    *out = NULL;
    if (!ps_table_find_column(own->part->table, name, &column)) {
        return PSPEC_OK;
    }
    PS_TRY(PS_POOL_NEW(self->memory, &numbers, own->num, "a curve", self->error));
    for (size_t i = 0; i < own->num; i++) {
        numbers[i] = ps_cell_number(ps_table_cell(own->part->table, own->first + i, column));
    }
    *out = numbers;
    return PSPEC_OK;
}

/* What is checked may be of rings or of degrees. */
static pspec_status take_places(picture *self, const double **out, const curve *own) {
    PS_TRY(take_column(self, out, own, self->chart->what->x));
    return *out != NULL ? PSPEC_OK : take_column(self, out, own, "degree");
}

/* What pure noise comes to, where the table has a level of it, and what is rounding: of powers the
 * square of the error of S, of others the error itself, that of pair sums in units of W^2. */
static void take_limits(ps_series *series, const curve *own, bool is_power) {
    const double error = entry_of(own, "predicted_error");
    const double sum = entry_of(own, "weight_sum");
    if (error > 0) {
        series->floor = is_power ? error * error : error * (isfinite(sum) ? sum * sum : 1);
    }
    series->num_realizations =
        isfinite(entry_of(own, "noise_level_db")) ? entry_of(own, "realizations") : 1;
}

/* Errors, anisotropies, and with --fit profiles and the curve that was fitted. */
static pspec_status take_bars(picture *self, ps_series *series, const curve *own) {
    const char *const names[] = {self->chart->what->error, "anisotropy_db", "lower", "upper",
                                 "fit"};
    const double **const columns[] = {&series->error, &series->anisotropy, &series->low,
                                      &series->high, &series->fit};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        PS_TRY(take_column(self, columns[i], own, names[i]));
    }
    return PSPEC_OK;
}

static pspec_status take_curve(picture *self, const curve *own) {
    const ps_picture_kind *const what = self->chart->what;
    for (size_t i = 0; i < PS_MOST_LINES && what->y[i] != NULL; i++) {
        ps_series *const series = add_series(self, own, own->label);
        series->formula = what->formulas[i];
        series->num = own->num;
        if (self->chart->num_panels == 1 && own->label[0] == '\0') {
            series->label = NULL;
        }
        PS_TRY(take_places(self, &series->x, own));
        PS_TRY(take_column(self, &series->y, own, what->y[i]));
        take_limits(series, own, what->is_spectrum);
        if (what->is_spectrum && self->chart->num_panels == 1) {
            PS_TRY(take_bars(self, series, own));
        }
    }
    return PSPEC_OK;
}

pspec_status ps_lines_figure(ps_figure *out, ps_pool *memory, const ps_chart *chart,
                             ps_error *error) {
    picture self = {.figure = out, .memory = memory, .chart = chart, .error = error};
    size_t column = 0;
    PS_TRY(begin(&self));
    for (size_t i = 0; i < self.num_curves; i++) {
        PS_TRY(take_curve(&self, &self.curves[i]));
    }
    PS_TRY(finish(&self));
    out->on_sphere =
        chart->what->is_spectrum && ps_table_find_column(chart->parts[0].table, "degree", &column);
    if (!ps_table_find_column(chart->parts[0].table, chart->what->x, &column)) {
        out->x_label = "degree";
    }
    return PSPEC_OK;
}

/* ---- entries --------------------------------------------------------------------------------- */

/* Curves of the same line are neighbours. */
static pspec_status take_counts(picture *self, size_t first, size_t num) {
    const curve *const own = &self->curves[first];
    ps_series *const series = add_series(self, own, own->line);
    ps_text label = {0};
    double *numbers = NULL;
    PS_TRY(PS_POOL_NEW(self->memory, &numbers, 2 * num, "a curve", self->error));
    for (size_t i = 0; i < num; i++) {
        numbers[i] = entry_of(own + i, self->chart->what->x);
        numbers[num + i] = entry_of(own + i, self->chart->what->y[0]);
    }
    series->num = num;
    series->x = numbers;
    series->y = numbers + num;
    if (self->chart->num_panels > 1) {
        return PSPEC_OK;
    }
    ps_text_append(&label, "%s", own->line);
    ps_series_say_slope(series, &label);
    return ps_text_keep(&series->label, self->memory, &label, self->error);
}

pspec_status ps_counts_figure(ps_figure *out, ps_pool *memory, const ps_chart *chart,
                              ps_error *error) {
    picture self = {.figure = out, .memory = memory, .chart = chart, .error = error};
    PS_TRY(begin(&self));
    for (size_t i = 0, end = 0; i < self.num_curves; i = end) {
        while (end < self.num_curves && strcmp(self.curves[end].line, self.curves[i].line) == 0) {
            end++;
        }
        PS_TRY(take_counts(&self, i, end - i));
    }
    return finish(&self);
}
