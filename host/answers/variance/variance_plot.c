/* Variances against N: a panel for each integrand, and in it a colour for each sampler. */
#include "answers/variance/rates_table.h"
#include "answers/variance/variance_table.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef enum quantity {
    POINTS,
    PREDICTED,
    LOWER,
    UPPER,
    MEASURED,
    MEASURED_ERROR,
    WHITE,
    BEST_BOUND,
    WORST_BOUND,
    NUM_QUANTITIES
} quantity;

/* Texts are borrowed from the parts. */
typedef struct row {
    const char *label, *sampler, *integrand; /* sampler "": its table has one, and no such column */
    double numbers[NUM_QUANTITIES];
    size_t curve, panel;
    ps_uncertain rate; /* of its curve in its panel; nan: unknown */
} row;

/* A curve is a line, with the places and ends of its band, marks, with places and errors, and the
 * lines of two bounds; white noise has the rows of one curve of each panel. */
enum {
    SERIES_OF_CURVE = 4,
    NUMBERS_OF_LINE = 4,
    NUMBERS_OF_MARKS = 3,
    NUMBERS_OF_BOUNDS = 4,
    NUMBERS_OF_WHITE = 2
};

typedef struct picture {
    size_t num_rows, num_curves, num_panels;
    row *rows;
    const row **curves, **panels; /* [num_rows]: the first row of each */
    size_t num_series, num_numbers;
    ps_series *series; /* those of a panel together */
    ps_text *labels;   /* [num_series] */
    double *numbers;   /* of all series */
    double *floors;    /* [num_panels] */
    ps_panel *plots;   /* [num_panels] */
} picture;

static void release(picture *self) {
    for (size_t i = 0; self->labels != NULL && i < self->num_series; i++) {
        ps_text_free(&self->labels[i]);
    }
    free(self->rows);
    free(self->curves);
    free(self->panels);
    free(self->series);
    free(self->labels);
    free(self->numbers);
    free(self->floors);
    free(self->plots);
}

/* ---- rows ------------------------------------------------------------------------------------ */

static const char *text_of(ps_cell cell) {
    return cell.kind == PS_CELL_TEXT ? cell.text : "";
}

/* The cell of a column, or where there is no such column what `otherwise` is. */
static const char *find_text(const ps_table *table, size_t index, const char *name,
                             const char *otherwise) {
    size_t column = 0;
    return ps_table_find_column(table, name, &column) ? text_of(ps_table_cell(table, index, column))
                                                      : otherwise;
}

static double find_number(const ps_table *table, size_t index, const char *name) {
    size_t column = 0;
    return ps_table_find_column(table, name, &column)
               ? ps_cell_number(ps_table_cell(table, index, column))
               : NAN;
}

static bool are_of_one_curve(const row *a, const row *b) {
    return strcmp(a->label, b->label) == 0 && strcmp(a->sampler, b->sampler) == 0;
}

static bool are_of_one_panel(const row *a, const row *b) {
    return strcmp(a->integrand, b->integrand) == 0;
}

typedef bool are_alike(const row *a, const row *b);

/* The number of the first row that is like this one, which may become that row. */
static size_t find_class(const row **firsts, size_t *num, const row *one, are_alike *are) {
    size_t i = 0;
    while (i < *num && !are(firsts[i], one)) {
        i++;
    }
    if (i == *num) {
        firsts[(*num)++] = one;
    }
    return i;
}

static void take_part(picture *self, const ps_chart_part *part) {
    static const char *const names[NUM_QUANTITIES] = {
        [POINTS] = "points", [PREDICTED] = "predicted",   [LOWER] = "lower",
        [UPPER] = "upper",   [MEASURED] = "measured",     [MEASURED_ERROR] = "measured_error",
        [WHITE] = "white",   [BEST_BOUND] = "best_bound", [WORST_BOUND] = "worst_bound"};
    const ps_table *const table = part->table;
    const char *const integrand = text_of(ps_table_find_meta(table, "integrand"));
    for (size_t i = 0; i < ps_table_num_rows(table); i++) {
        row *const one = &self->rows[self->num_rows++];
        one->label = part->label;
        one->sampler = find_text(table, i, "sampler", "");
        one->integrand = find_text(table, i, "integrand", integrand);
        for (size_t k = 0; k < NUM_QUANTITIES; k++) {
            one->numbers[k] = find_number(table, i, names[k]);
        }
        one->rate = ps_rates_find(table, one->sampler, one->integrand);
        one->curve = find_class(self->curves, &self->num_curves, one, are_of_one_curve);
        one->panel = find_class(self->panels, &self->num_panels, one, are_of_one_panel);
    }
}

static pspec_status take_rows(picture *self, const ps_chart *chart, ps_error *error) {
    size_t num = 0;
    for (size_t i = 0; i < chart->num_parts; i++) {
        num += ps_table_num_rows(chart->parts[i].table);
    }
    PS_TRY(PS_NEW(&self->rows, num, "a picture", error));
    PS_TRY(PS_NEW(&self->curves, num, "a picture", error));
    PS_TRY(PS_NEW(&self->panels, num, "a picture", error));
    for (size_t i = 0; i < chart->num_parts; i++) {
        take_part(self, &chart->parts[i]);
    }
    return PSPEC_OK;
}

/* ---- series ---------------------------------------------------------------------------------- */

/* Numbers of one quantity of all rows of a curve in a panel. */
static const double *gather(picture *self, size_t curve, size_t panel, quantity which,
                            size_t *num) {
    double *const out = self->numbers + self->num_numbers;
    *num = 0;
    for (size_t i = 0; i < self->num_rows; i++) {
        const row *const one = &self->rows[i];
        if (one->curve == curve && one->panel == panel) {
            out[(*num)++] = one->numbers[which];
        }
    }
    self->num_numbers += *num;
    return out;
}

/* Variances are sums of what comes to that of white noise: so much of it is rounding. */
static void find_floors(picture *self) {
    for (size_t i = 0; i < self->num_rows; i++) {
        const row *const one = &self->rows[i];
        const double floor = ps_series_floor(&(ps_series){0}, one->numbers[WHITE]);
        self->floors[one->panel] = fmax(self->floors[one->panel], floor);
    }
}

/* Without a label, and without places where there is no such curve in the panel. */
static ps_series *add_series(picture *self, size_t curve, size_t panel, quantity which,
                             ps_look look) {
    ps_series *const series = &self->series[self->num_series++];
    *series = (ps_series){.kind = curve, .look = look, .floor = self->floors[panel]};
    series->x = gather(self, curve, panel, POINTS, &series->num);
    series->y = gather(self, curve, panel, which, &series->num);
    return series;
}

/* label: of this series, and begun already. The rate, where it was asked for, is in the header,
 * too. */
static pspec_status name_series(ps_series *series, ps_text *label, ps_uncertain rate,
                                ps_error *error) {
    if (isfinite(rate.value)) {
        ps_text_append(label, ": slope %.4g (%.2g)", -rate.value, rate.error);
    } else {
        ps_series_say_slope(series, label);
    }
    series->label = ps_text_string(label);
    return ps_text_check(label, error);
}

/* Is a line or a mark of it drawn? No line goes through a single place among others. */
static bool is_drawn(const ps_series *series) {
    size_t num = 0;
    for (size_t i = 0; i < series->num; i++) {
        num += isfinite(series->y[i]) && series->y[i] > series->floor ? 1 : 0;
    }
    return num > 1 || (num == 1 && (series->num == 1 || series->look == PS_LOOK_MARKS));
}

/* Where there is one sampler the key has its bounds, too; none where no bound was asked for, or
 * there is no such. */
static pspec_status add_bound(picture *self, size_t curve, size_t panel, quantity which,
                              ps_error *error) {
    ps_text *const label = &self->labels[self->num_series];
    ps_series *const line = add_series(self, curve, panel, which, PS_LOOK_BOUND);
    if (!is_drawn(line)) {
        self->num_series--;
        return PSPEC_OK;
    }
    if (self->num_curves > 1) {
        return PSPEC_OK;
    }
    ps_text_append(label, "%s bound", which == BEST_BOUND ? "best" : "worst");
    return name_series(line, label, PS_UNCERTAIN_NONE, error);
}

static ps_uncertain find_rate(const picture *self, size_t curve, size_t panel) {
    size_t i = 0;
    while (i < self->num_rows && (self->rows[i].curve != curve || self->rows[i].panel != panel)) {
        i++;
    }
    return i < self->num_rows ? self->rows[i].rate : PS_UNCERTAIN_NONE;
}

/* One entry of the key: marks have the colour of the line. */
static pspec_status add_curve(picture *self, size_t curve, size_t panel, ps_error *error) {
    const row *const first = self->curves[curve];
    ps_text *const label = &self->labels[self->num_series];
    ps_series *const line = add_series(self, curve, panel, PREDICTED, PS_LOOK_CURVE);
    if (line->num == 0) {
        self->num_series--;
        return PSPEC_OK;
    }
    line->low = gather(self, curve, panel, LOWER, &line->num);
    line->high = gather(self, curve, panel, UPPER, &line->num);
    ps_series *const marks = add_series(self, curve, panel, MEASURED, PS_LOOK_MARKS);
    marks->error = gather(self, curve, panel, MEASURED_ERROR, &marks->num);
    PS_TRY(add_bound(self, curve, panel, BEST_BOUND, error));
    PS_TRY(add_bound(self, curve, panel, WORST_BOUND, error));
    ps_text_append(label, "%s%s%s", first->label,
                   first->label[0] != '\0' && first->sampler[0] != '\0' ? ", " : "",
                   first->sampler);
    return name_series(line, label, find_rate(self, curve, panel), error);
}

/* By the rows of the first sampler that there is: it depends on N alone. */
static pspec_status add_white(picture *self, size_t panel, ps_error *error) {
    ps_text *const label = &self->labels[self->num_series];
    ps_series *const line =
        add_series(self, self->panels[panel]->curve, panel, WHITE, PS_LOOK_REFERENCE);
    ps_text_append(label, "white noise");
    return name_series(line, label, PS_UNCERTAIN_NONE, error);
}

static pspec_status add_panel(picture *self, size_t panel, ps_error *error) {
    const size_t begin = self->num_series;
    for (size_t curve = 0; curve < self->num_curves; curve++) {
        PS_TRY(add_curve(self, curve, panel, error));
    }
    PS_TRY(add_white(self, panel, error));
    self->plots[panel] =
        (ps_panel){self->panels[panel]->integrand, self->num_series - begin, self->series + begin};
    return PSPEC_OK;
}

static pspec_status add_all(picture *self, ps_error *error) {
    const size_t most = self->num_panels * (SERIES_OF_CURVE * self->num_curves + 1);
    const size_t most_of_row =
        NUMBERS_OF_LINE + NUMBERS_OF_MARKS + NUMBERS_OF_BOUNDS + NUMBERS_OF_WHITE;
    PS_TRY(PS_NEW(&self->series, most, "a picture", error));
    PS_TRY(PS_NEW(&self->labels, most, "a picture", error));
    PS_TRY(PS_NEW(&self->numbers, most_of_row * self->num_rows, "a picture", error));
    PS_TRY(PS_NEW(&self->plots, self->num_panels, "a picture", error));
    PS_TRY(PS_NEW(&self->floors, self->num_panels, "a picture", error));
    find_floors(self);
    for (size_t panel = 0; panel < self->num_panels; panel++) {
        PS_TRY(add_panel(self, panel, error));
    }
    return PSPEC_OK;
}

/* ---- words ----------------------------------------------------------------------------------- */

/* What the axis says of the series of a look: how it is drawn, "" where nothing is. */
static const char *find_form(const picture *self, ps_look look, const char *of_one,
                             const char *of_several) {
    const char *form = "";
    for (size_t i = 0; i < self->num_series; i++) {
        const ps_series *const series = &self->series[i];
        if (series->look == look && is_drawn(series) && form != of_several) {
            form = series->num > 1 ? of_several : of_one;
        }
    }
    return form;
}

/* The label of the axis: what is drawn, and how. */
static pspec_status write_label(const picture *self, ps_text *out, ps_error *error) {
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
    return ps_text_check(out, error);
}

/* ---- all ------------------------------------------------------------------------------------- */

pspec_status ps_variance_chart(const ps_chart *chart, ps_error *error) {
    picture self = {0};
    ps_text label = {0};
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, take_rows(&self, chart, error));
    PS_TRY_OUT(status, add_all(&self, error));
    PS_TRY_OUT(status, write_label(&self, &label, error));
    const ps_figure figure = {.form = PS_FIGURE_FRAME,
                              .title = chart->title,
                              .x_label = "points N",
                              .y_label = ps_text_string(&label),
                              .axes = chart->axes,
                              .is_log_x = true,
                              .is_log_y = true,
                              .num_panels = self.num_panels,
                              .panels = self.plots};
    status = chart->take(chart->payload, &figure, error);
out:
    ps_text_free(&label);
    release(&self);
    return status;
}

static pspec_status write_figure(void *payload, const ps_figure *figure, ps_error *error) {
    const ps_request *const request = payload;
    return ps_figure_write(request->plot, figure, error);
}

/* Of one integrand there is no panel to name it. */
static void append_title(const ps_request *request, const ps_table *table, ps_text *out) {
    const double sets = ps_variance_sets(request, table, NULL);
    const double shifts = ps_cell_number(ps_table_find_meta(table, "shifts"));
    ps_text_append(out, "%s", request->num_integrands == 1 ? request->integrands[0] : "variance");
    if (request->num_sources == 1) {
        ps_text_append(out, ", %s", ps_request_source_name(request, 0));
    }
    if (sets > 0) {
        ps_text_append(out, ", M = %.0f", sets);
    } else if (request->num_sources > 1) {
        ps_variance_sets(request, table, out);
    }
    if (sets > 0 && shifts > 0) {
        ps_text_append(out, ", %.0f trial%s", sets * shifts, sets * shifts > 1 ? "s" : "");
    }
}

pspec_status ps_variance_plot(const ps_request *request, const ps_table *table, ps_error *error) {
    ps_text title = {0};
    append_title(request, table, &title);
    const ps_chart_part part = {table, request->num_sources == 0 ? "files"
                                       : request->num_sources == 1
                                           ? ps_request_source_name(request, 0)
                                           : ""};
    const ps_chart chart = {.title = ps_text_string(&title),
                            .axes = request->plot_axes,
                            .num_parts = 1,
                            .parts = &part,
                            .take = write_figure,
                            .payload = (void *)request};
    pspec_status status = ps_text_check(&title, error);
    if (status == PSPEC_OK) {
        status = ps_variance_chart(&chart, error);
    }
    ps_text_free(&title);
    return status;
}
