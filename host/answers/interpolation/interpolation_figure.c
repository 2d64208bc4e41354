/* Pictures of interpolants: the functions, and what is made of their values at points. */
#include "answers/interpolation/interpolation.h"

#include <math.h>

typedef struct gallery {
    ps_pool *memory;
    ps_panel *panels;
    size_t num;
    ps_error *error;
} gallery;

/* Black is 0, or the least value; white is at most six times the mean, so that a few bright pixels,
 * as a map has of lamps and of the sun, do not make the rest dark. */
static void find_scale(ps_frame *out, size_t num, const double *values) {
    const double most_means = 6;
    double sum = 0;
    double least = 0;
    double most = 0;
    for (size_t i = 0; i < num; i++) {
        sum += fabs(values[i]);
        least = fmin(least, values[i]);
        most = fmax(most, values[i]);
    }
    out->first = least;
    out->last = fmin(most, most_means * sum / (double)num);
}

/* An image of the part, on the scale of its function. */
static pspec_status add(gallery *self, const ps_chart_part *part, const char *array, size_t index,
                        ps_text *title) {
    const ps_npy_array *const light = ps_table_find_array(part->table, "light");
    const size_t pixels = light->shape[1] * light->shape[2];
    ps_panel *const panel = &self->panels[self->num++];
    ps_series *series = NULL;
    *panel = (ps_panel){.num_series = 1, .frame = {.form = PS_FRAME_LIGHT}};
    PS_TRY(ps_text_keep(&panel->title, self->memory, title, self->error));
    PS_TRY(PS_POOL_NEW(self->memory, &series, 1, "a picture", self->error));
    *series = (ps_series){.num = pixels,
                          .columns = light->shape[2],
                          .y = ps_table_find_array(part->table, array)->data + index * pixels};
    panel->series = series;
    find_scale(&panel->frame, pixels, light->data + index % light->shape[0] * pixels);
    return PSPEC_OK;
}

/* A label of a scene says what tells its parts apart, but for N. */
static pspec_status add_image(gallery *self, const ps_chart_part *part, size_t row, size_t index) {
    static const char *const columns[] = {"sampler", "integrand"};
    const ps_table *const table = part->table;
    const double points = ps_cell_number(ps_table_find_cell(table, row, "points"));
    const double smoothness = ps_cell_number(ps_table_find_cell(table, row, "smoothness"));
    ps_text title = {0};
    ps_text_append(&title, "%s", part->label);
    for (size_t i = 0; i < sizeof columns / sizeof columns[0]; i++) {
        const ps_cell name = ps_table_find_cell(table, row, columns[i]);
        if (name.kind == PS_CELL_TEXT) {
            ps_text_append(&title, "%s%s", title.length > 0 ? ", " : "", name.text);
        }
    }
    if (isfinite(points)) {
        ps_text_append(&title, "%sN = %g", title.length > 0 ? ", " : "", points);
    }
    if (part->label[0] == '\0' && isfinite(smoothness)) {
        ps_text_append(&title, ", s = %g", smoothness);
    }
    return add(self, part, "image", index, &title);
}

static pspec_status add_images(gallery *self, const ps_chart_part *part) {
    const ps_request *const request = part->request;
    const size_t num = ps_request_num_questions(request);
    const size_t each = ps_table_num_rows(part->table) / num;
    size_t index = 0;
    for (size_t question = 0; question < num; question++) {
        for (size_t i = 0; i < each && ps_interpolation_is_shown(request, question); i++) {
            PS_TRY(add_image(self, part, question * each + i, index++));
        }
    }
    return PSPEC_OK;
}

static pspec_status add_light(gallery *self, const ps_chart_part *part) {
    for (size_t i = 0; i < part->request->num_integrands; i++) {
        ps_text title = {0};
        ps_text_append(&title, "%s", part->request->integrands[i]);
        PS_TRY(add(self, part, "light", i, &title));
    }
    return PSPEC_OK;
}

static size_t count(const ps_chart *chart) {
    size_t num = ps_table_find_array(chart->parts[0].table, "light")->shape[0];
    for (size_t i = 0; i < chart->num_parts; i++) {
        const ps_npy_array *const images = ps_table_find_array(chart->parts[i].table, "image");
        num += images != NULL ? images->shape[0] : 0;
    }
    return num;
}

pspec_status ps_interpolation_figure(ps_figure *out, ps_pool *memory, const ps_chart *chart,
                                     ps_error *error) {
    gallery self = {.memory = memory, .error = error};
    const size_t most_columns = 3;
    const size_t num = count(chart);
    PS_TRY(PS_POOL_NEW(memory, &self.panels, num, "a picture", error));
    PS_TRY(add_light(&self, &chart->parts[0]));
    for (size_t i = 0; i < chart->num_parts && self.num < num; i++) {
        PS_TRY(add_images(&self, &chart->parts[i]));
    }
    *out = (ps_figure){.form = PS_FIGURE_POINTS,
                       .title = chart->title,
                       .num_panels = self.num,
                       .panels = self.panels,
                       .num_columns = self.num > 4 || self.num == most_columns ? most_columns
                                      : self.num > 1                           ? 2
                                                                               : 1};
    return PSPEC_OK;
}
