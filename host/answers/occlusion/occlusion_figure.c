/* The picture of occlusion: images of visibility, each with its error beside it. */
#include "answers/occlusion/occlusion.h"

#include "base/text.h"

#include <math.h>

/* More are pages that nobody looks at. */
enum { MOST_ROWS = 8 };

typedef struct picture {
    ps_pool *memory;
    const ps_table *table;
    size_t width, height; /* of the arrays */
    ps_panel *panels;
    size_t num_panels;
    double reach; /* of the colours of errors */
} picture;

static pspec_status add_panel(picture *self, const double *image, const char *title, double low,
                              double high, ps_error *error) {
    ps_series *series = NULL;
    PS_TRY(PS_POOL_NEW(self->memory, &series, 1, "a picture", error));
    *series = (ps_series){.num = self->width * self->height, .columns = self->width, .y = image};
    self->panels[self->num_panels++] =
        (ps_panel){.title = title,
                   .num_series = 1,
                   .series = series,
                   .frame = {.form = PS_FRAME_PIXELS, .first = low, .last = high}};
    return PSPEC_OK;
}

/* "fibonacci, N = 192, MSE 1.4e-4" */
static pspec_status add_row(picture *self, size_t row, ps_error *error) {
    const ps_npy_array *const images = ps_table_find_array(self->table, "image");
    const ps_npy_array *const errors = ps_table_find_array(self->table, "error");
    const size_t before = row * self->width * self->height;
    const char *titles[2];
    ps_text text = {0};
    const ps_cell sampler = ps_table_find_cell(self->table, row, "sampler");
    if (sampler.kind == PS_CELL_TEXT) {
        ps_text_append(&text, "%s, ", sampler.text);
    }
    ps_text_append(&text, "N = %.6g",
                   ps_cell_number(ps_entry_of(self->table, "points", row, "points")));
    PS_TRY(ps_text_keep(&titles[0], self->memory, &text, error));
    text = (ps_text){0};
    ps_text_append(&text, "error, MSE %.3g",
                   ps_cell_number(ps_entry_of(self->table, "points", row, "mse")));
    PS_TRY(ps_text_keep(&titles[1], self->memory, &text, error));
    PS_TRY(add_panel(self, images->data + before, titles[0], 0, 1, error));
    return add_panel(self, errors->data + before, titles[1], -self->reach, self->reach, error);
}

/* Three times the largest root of the mean square: of an image alike at every pixel all but one in
 * 370 are within. */
static double find_reach(const ps_npy_array *errors, size_t pixels) {
    double most = 0;
    for (size_t i = 0; i < errors->num; i += pixels) {
        double sum = 0;
        for (size_t k = i; k < i + pixels; k++) {
            sum += errors->data[k] * errors->data[k];
        }
        most = fmax(most, sum / (double)pixels);
    }
    return most > 0 ? 3 * sqrt(most) : 1;
}

/* Does the row have the same number of points as the first? */
static bool is_shown(const ps_table *table, size_t row) {
    const ps_cell first = ps_table_find_cell(table, 0, "points");
    return first.kind == PS_CELL_MISSING ||
           ps_cell_number(ps_table_find_cell(table, row, "points")) == ps_cell_number(first);
}

pspec_status ps_occlusion_figure(ps_figure *out, ps_pool *memory, const ps_chart *chart,
                                 ps_error *error) {
    const ps_table *const table = chart->parts[0].table;
    const ps_npy_array *const errors = ps_table_find_array(table, "error");
    const size_t *const sides = errors->shape + errors->rank - 2;
    picture self = {.memory = memory,
                    .table = table,
                    .width = sides[1],
                    .height = sides[0],
                    .reach = find_reach(errors, sides[0] * sides[1])};
    PS_TRY(PS_POOL_NEW(memory, &self.panels, 2 * MOST_ROWS, "a picture", error));
    for (size_t i = 0; i < ps_table_num_rows(table) && self.num_panels < 2 * MOST_ROWS; i++) {
        PS_TRY(is_shown(table, i) ? add_row(&self, i, error) : PSPEC_OK);
    }
    *out = (ps_figure){.form = PS_FIGURE_POINTS,
                       .title = chart->title,
                       .num_panels = self.num_panels,
                       .panels = self.panels,
                       .num_columns = self.num_panels > 2 ? PS_MOST_POINT_COLUMNS : 2};
    return PSPEC_OK;
}
