/* Variances against N: a panel for each integrand, and in it a colour for each sampler. */
#include "answers/variance/variance_table.h"
#include "base/text.h"
#include "jobs/variance/rates.h"

#include <math.h>
#include <string.h>

/* The rows of one sampler or set for one integrand. Texts are borrowed from the parts. */
typedef struct curve {
    const char *label, *sampler, *integrand; /* sampler "": its table has one, and no such column */
    const ps_table *table;
    size_t colour, panel;
    size_t num;
    double *numbers; /* [NUM_COLUMNS][capacity] */
    size_t capacity;
} curve;

typedef enum column {
    POINTS,
    PREDICTED,
    LOWER,
    UPPER,
    MEASURED,
    MEASURED_ERROR,
    WHITE,
    BEST_BOUND,
    WORST_BOUND,
    NUM_COLUMNS
} column;

typedef struct picture {
    ps_pool *memory;
    ps_error *error;
    size_t num_rows; /* of all parts */
    size_t num_curves, num_colours, num_panels;
    curve *curves; /* [num_rows] */
    ps_series *series;
    size_t num_series;
    ps_panel *panels;
    double floor; /* of the panel that is filled */
} picture;

/* ---- rows ------------------------------------------------------------------------------------ */

static const char *text_of(ps_cell cell) {
    return cell.kind == PS_CELL_TEXT ? cell.text : "";
}

static ps_cell find_cell(const ps_table *table, size_t row, const char *name) {
    size_t place = 0;
    return ps_table_find_column(table, name, &place) ? ps_table_cell(table, row, place)
                                                     : PS_MISSING;
}

/* The curve of a row, which may be its first. */
static pspec_status find_curve(picture *self, curve **out, const curve *row) {
    curve own = *row;
    own.colour = self->num_colours;
    own.panel = self->num_panels;
    own.capacity = self->num_rows;
    for (size_t i = 0; i < self->num_curves; i++) {
        curve *const other = &self->curves[i];
        const bool is_colour =
            strcmp(other->label, own.label) == 0 && strcmp(other->sampler, own.sampler) == 0;
        const bool is_panel = strcmp(other->integrand, own.integrand) == 0;
        if (is_colour && is_panel) {
            *out = other;
            return PSPEC_OK;
        }
        own.colour = is_colour ? other->colour : own.colour;
        own.panel = is_panel ? other->panel : own.panel;
    }
    self->num_colours += own.colour == self->num_colours;
    self->num_panels += own.panel == self->num_panels;
    PS_TRY(PS_POOL_NEW(self->memory, &own.numbers, NUM_COLUMNS * own.capacity, "a picture",
                       self->error));
    *out = &self->curves[self->num_curves++];
    **out = own;
    return PSPEC_OK;
}

/* Of a command, whose table has one sampler or set, or files. */
static const char *name_part(const ps_chart_part *part) {
    const ps_request *const request = part->request;
    size_t place = 0;
    return part->label[0] != '\0' || ps_table_find_column(part->table, "sampler", &place)
               ? part->label
           : request->num_sources > 0 ? ps_request_source_name(request, 0)
                                      : "files";
}

static pspec_status take_part(picture *self, const ps_chart_part *part) {
    static const char *const names[NUM_COLUMNS] = {
        [POINTS] = "points", [PREDICTED] = "predicted",   [LOWER] = "lower",
        [UPPER] = "upper",   [MEASURED] = "measured",     [MEASURED_ERROR] = "measured_error",
        [WHITE] = "white",   [BEST_BOUND] = "best_bound", [WORST_BOUND] = "worst_bound"};
    const ps_table *const table = part->table;
    const ps_cell only = ps_table_find_meta(table, "integrand");
    for (size_t row = 0; row < ps_table_num_rows(table); row++) {
        const ps_cell integrand = find_cell(table, row, "integrand");
        curve *own = NULL;
        PS_TRY(find_curve(
            self, &own,
            &(curve){.label = name_part(part),
                     .sampler = text_of(find_cell(table, row, "sampler")),
                     .integrand = text_of(integrand.kind == PS_CELL_TEXT ? integrand : only),
                     .table = table}));
        for (size_t i = 0; i < NUM_COLUMNS; i++) {
            own->numbers[i * own->capacity + own->num] =
                ps_cell_number(find_cell(table, row, names[i]));
        }
        own->num++;
    }
    return PSPEC_OK;
}

/* ---- series ---------------------------------------------------------------------------------- */

static const double *numbers_of(const curve *own, column which) {
    return own->numbers + which * own->capacity;
}

static ps_series *add_series(picture *self, const curve *own, column which, ps_look look) {
    ps_series *const series = &self->series[self->num_series++];
    *series = (ps_series){.kind = own->colour,
                          .look = look,
                          .floor = self->floor,
                          .num = own->num,
                          .x = numbers_of(own, POINTS),
                          .y = numbers_of(own, which)};
    return series;
}

/* The exponent that the header has of the curve, where it was asked for. */
static ps_uncertain find_rate(const curve *own) {
    static const char block[] = "rates";
    size_t i = 0;
    ps_cell sampler = ps_entry_of(own->table, block, 0, "rate_sampler");
    while (sampler.kind == PS_CELL_TEXT &&
           ((own->sampler[0] != '\0' && strcmp(sampler.text, own->sampler) != 0) ||
            strcmp(text_of(ps_entry_of(own->table, block, i, "rate_integrand")), own->integrand) !=
                0)) {
        sampler = ps_entry_of(own->table, block, ++i, "rate_sampler");
    }
    return (ps_uncertain){.value = ps_cell_number(ps_entry_of(own->table, block, i, "rate")),
                          .error = ps_cell_number(ps_entry_of(own->table, block, i, "rate_error"))};
}

/* text: begun already. */
static pspec_status name_series(const picture *self, ps_series *series, ps_text *text,
                                ps_uncertain rate) {
    if (isfinite(rate.value)) {
        ps_text_append(text, ": slope %.4g (%.2g)", -rate.value, rate.error);
    } else {
        ps_series_say_slope(series, text);
    }
    return ps_text_keep(&series->label, self->memory, text, self->error);
}

/* Where there is one sampler the key has its bounds, too; none where no bound was asked for, or
 * there is no such. */
static pspec_status add_bound(picture *self, const curve *own, column which) {
    ps_series *const line = add_series(self, own, which, PS_LOOK_BOUND);
    ps_text label = {0};
    if (!ps_series_is_drawn(line)) {
        self->num_series--;
        return PSPEC_OK;
    }
    if (self->num_colours > 1) {
        return PSPEC_OK;
    }
    ps_text_append(&label, "%s bound", which == BEST_BOUND ? "best" : "worst");
    return name_series(self, line, &label, PS_UNCERTAIN_NONE);
}

/* One entry of the key: marks have the colour of the line. */
static pspec_status add_curve(picture *self, const curve *own) {
    ps_text label = {0};
    ps_series *const line = add_series(self, own, PREDICTED, PS_LOOK_CURVE);
    line->low = numbers_of(own, LOWER);
    line->high = numbers_of(own, UPPER);
    add_series(self, own, MEASURED, PS_LOOK_MARKS)->error = numbers_of(own, MEASURED_ERROR);
    PS_TRY(add_bound(self, own, BEST_BOUND));
    PS_TRY(add_bound(self, own, WORST_BOUND));
    ps_text_append(&label, "%s%s%s", own->label,
                   own->label[0] != '\0' && own->sampler[0] != '\0' ? ", " : "", own->sampler);
    return name_series(self, line, &label, find_rate(own));
}

/* White noise by the rows of the first sampler that there is: it depends on N alone. Variances are
 * sums of what comes to that of white noise: so much of it is rounding. */
static pspec_status add_panel(picture *self, size_t panel) {
    const size_t begin = self->num_series;
    const curve *first = NULL;
    ps_text label = {0};
    self->floor = 0;
    for (size_t i = 0; i < self->num_curves; i++) {
        const curve *const own = &self->curves[i];
        for (size_t k = 0; own->panel == panel && k < own->num; k++) {
            self->floor =
                fmax(self->floor, ps_series_floor(&(ps_series){0}, numbers_of(own, WHITE)[k]));
        }
        first = first == NULL && own->panel == panel ? own : first;
    }
    for (size_t colour = 0; colour < self->num_colours; colour++) {
        for (size_t i = 0; i < self->num_curves; i++) {
            if (self->curves[i].panel == panel && self->curves[i].colour == colour) {
                PS_TRY(add_curve(self, &self->curves[i]));
            }
        }
    }
    ps_text_append(&label, "white noise");
    PS_TRY(name_series(self, add_series(self, first, WHITE, PS_LOOK_REFERENCE), &label,
                       PS_UNCERTAIN_NONE));
    self->panels[panel] = (ps_panel){.title = first->integrand,
                                     .num_series = self->num_series - begin,
                                     .series = self->series + begin};
    return PSPEC_OK;
}

/* ---- words ----------------------------------------------------------------------------------- */

/* What the axis says of the series of a look: how it is drawn, "" where nothing is. */
static const char *find_form(const picture *self, ps_look look, const char *of_one,
                             const char *of_several) {
    const char *form = "";
    for (size_t i = 0; i < self->num_series; i++) {
        const ps_series *const series = &self->series[i];
        if (series->look == look && ps_series_is_drawn(series) && form != of_several) {
            form = series->num > 1 ? of_several : of_one;
        }
    }
    return form;
}

/* What is drawn, and how. */
static void write_label(const picture *self, ps_text *out) {
    static const struct {
        ps_look look;
        const char *of_one, *of_several, *what;
    } parts[] = {{PS_LOOK_CURVE, "rings", "lines", "predicted"},
                 {PS_LOOK_MARKS, "marks", "marks", "measured"},
                 {PS_LOOK_BOUND, "crosses", "dots", "bounds"}};
    const char *before = ": ";
    ps_text_append(out, "variance");
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        const char *const form =
            find_form(self, parts[i].look, parts[i].of_one, parts[i].of_several);
        if (form[0] != '\0') {
            ps_text_append(out, "%s%s %s", before, form, parts[i].what);
            before = ", ";
        }
    }
}

/* ---- all ------------------------------------------------------------------------------------- */

pspec_status ps_variance_figure(ps_figure *out, ps_pool *memory, const ps_chart *chart,
                                ps_error *error) {
    enum { SERIES_OF_CURVE = 4 }; /* line, marks, two bounds; beside one of white noise a panel */
    picture self = {.memory = memory, .error = error};
    ps_text label = {0};
    for (size_t i = 0; i < chart->num_parts; i++) {
        self.num_rows += ps_table_num_rows(chart->parts[i].table);
    }
    PS_TRY(PS_POOL_NEW(memory, &self.curves, self.num_rows, "a picture", error));
    for (size_t i = 0; i < chart->num_parts; i++) {
        PS_TRY(take_part(&self, &chart->parts[i]));
    }
    PS_TRY(PS_POOL_NEW(memory, &self.series, SERIES_OF_CURVE * self.num_curves + self.num_panels,
                       "a picture", error));
    PS_TRY(PS_POOL_NEW(memory, &self.panels, self.num_panels, "a picture", error));
    for (size_t panel = 0; panel < self.num_panels; panel++) {
        PS_TRY(add_panel(&self, panel));
    }
    write_label(&self, &label);
    *out = (ps_figure){.form = PS_FIGURE_FRAME,
                       .title = chart->title,
                       .x_label = "points N",
                       .axes = chart->axes,
                       .is_log_x = true,
                       .is_log_y = true,
                       .num_panels = self.num_panels,
                       .panels = self.panels};
    return ps_text_keep(&out->y_label, memory, &label, error);
}

/* Of one integrand there is no panel to name it. */
void ps_variance_write_title(ps_text *out, const ps_request *request, const ps_table *table) {
    const double sets = ps_variance_num_sets(request, table, NULL);
    const double shifts = ps_cell_number(ps_table_find_meta(table, "shifts"));
    ps_text_append(out, "%s", request->num_integrands == 1 ? request->integrands[0] : "variance");
    if (request->num_sources == 1) {
        ps_text_append(out, ", %s", ps_request_source_name(request, 0));
    }
    if (sets > 0) {
        ps_text_append(out, ", M = %.0f", sets);
    } else if (request->num_sources > 1) {
        ps_variance_num_sets(request, table, out);
    }
    if (sets > 0 && shifts > 0) {
        ps_text_append(out, ", %.0f trial%s", sets * shifts, sets * shifts > 1 ? "s" : "");
    }
}
