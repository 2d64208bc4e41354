/* The picture of measures: pair correlations and number variances. */
#include "answers/measure/measure.h"

#include "base/text.h"

#include <math.h>

enum { CURVE_NUMBERS = 3, MOST_PANELS = 2 };
enum { X, Y, LOW, HIGH, NUM_DRAWN };

typedef struct picture {
    ps_pool *memory;
    ps_series *series[MOST_PANELS];
    size_t num[MOST_PANELS]; /* of series */
} picture;

/* "jittered, N = 256", or what a scene calls the part. */
static pspec_status name_curve(const char **out, picture *self, const ps_chart_part *part,
                               size_t number, ps_error *error) {
    const ps_cell source = ps_entry_of(part->table, "sampler", number, "sampler");
    const ps_cell points = ps_entry_of(part->table, "sampler", number, "points");
    ps_text text = {0};
    ps_text_append(&text, "%s", part->label);
    if (source.kind == PS_CELL_TEXT && text.length == 0) {
        ps_text_append(&text, "%s", source.text);
    }
    ps_text_append(&text, "%sN = %.6g", text.length > 0 ? ", " : "", ps_cell_number(points));
    return ps_text_keep(out, self->memory, &text, error);
}

static pspec_status add_curve(picture *self, size_t panel, const ps_npy_array *array, size_t number,
                              ps_series look, ps_error *error) {
    const size_t num = array->shape[array->rank - 2];
    double *columns = NULL;
    PS_TRY(PS_POOL_NEW(self->memory, &columns, NUM_DRAWN * num, "a curve", error));
    for (size_t i = 0; i < num; i++) {
        const double *const place = array->data + (number * num + i) * CURVE_NUMBERS;
        columns[X * num + i] = place[0];
        columns[Y * num + i] = place[1];
        columns[LOW * num + i] = place[1] - place[2];
        columns[HIGH * num + i] = place[1] + place[2];
    }
    look.num = num;
    look.x = columns + X * num;
    look.y = columns + Y * num;
    look.low = columns + LOW * num;
    look.high = columns + HIGH * num;
    self->series[panel][self->num[panel]++] = look;
    return PSPEC_OK;
}

static pspec_status add_part(picture *self, const ps_chart_part *part, ps_error *error) {
    static const char *const names[] = {"pair_correlation", "number_variance"};
    static const ps_look looks[] = {PS_LOOK_CURVE, PS_LOOK_LINE};
    for (size_t panel = 0; panel < MOST_PANELS; panel++) {
        const ps_npy_array *const array = ps_table_find_array(part->table, names[panel]);
        const size_t num = array == NULL ? 0 : array->rank == 2 ? 1 : array->shape[0];
        for (size_t i = 0; i < num && self->num[panel] < PS_MAX_CURVES; i++) {
            ps_series look = {.kind = self->num[panel], .look = looks[panel]};
            PS_TRY(name_curve(&look.label, self, part, i, error));
            PS_TRY(add_curve(self, panel, array, i, look, error));
        }
    }
    return PSPEC_OK;
}

pspec_status ps_measure_figure(ps_figure *out, ps_pool *memory, const ps_chart *chart,
                               ps_error *error) {
    picture self = {.memory = memory};
    ps_panel *panels = NULL;
    PS_TRY(PS_POOL_NEW(memory, &panels, MOST_PANELS, "a picture", error));
    for (size_t panel = 0; panel < MOST_PANELS; panel++) {
        PS_TRY(PS_POOL_NEW(memory, &self.series[panel], PS_MAX_CURVES, "a picture", error));
    }
    for (size_t i = 0; i < chart->num_parts; i++) {
        PS_TRY(add_part(&self, &chart->parts[i], error));
    }
    panels[0] = (ps_panel){.title = "pair correlation",
                           .num_series = self.num[0],
                           .series = self.series[0],
                           .frame = {.x_label = "distance r N^{1/d}", .y_label = "g(r)"}};
    panels[1] = (ps_panel){
        .title = "number variance",
        .num_series = self.num[1],
        .series = self.series[1],
        .frame = {.x_label = "radius R N^{1/d}", .y_label = "variance of the number in a ball"}};
    *out = (ps_figure){.form = PS_FIGURE_FRAME,
                       .title = chart->title,
                       .num_panels = self.num[1] > 0 ? 2 : 1,
                       .panels = panels};
    return PSPEC_OK;
}
