/* Pictures of spectra: curves, the averaged periodogram, points. */
#include "answers/points/points.h"
#include "answers/spectra/spectra.h"

#include <math.h>

/* Sums over pairs are drawn as what they are relative to white noise, against l / sqrt(N). */
static pspec_status scale(ps_series *series, ps_pool *memory, double white, double points,
                          ps_error *error) {
    double *numbers = NULL;
    PS_TRY(PS_POOL_NEW(memory, &numbers, 3 * series->num, "a curve", error));
    for (size_t i = 0; i < series->num; i++) {
        numbers[i] = series->x[i] / sqrt(points);
        numbers[series->num + i] = series->y[i] / white;
        numbers[2 * series->num + i] = series->error[i] / white;
    }
    series->x = numbers;
    series->y = numbers + series->num;
    series->error = numbers + 2 * series->num;
    series->floor /= white;
    return PSPEC_OK;
}

static pspec_status scale_sums(ps_figure *out, ps_pool *memory, const ps_table *table,
                               const double *white, ps_error *error) {
    const size_t num = out->panels->num_series;
    ps_panel *panel = NULL;
    ps_series *series = NULL;
    PS_TRY(PS_POOL_NEW(memory, &panel, 1, "a picture", error));
    PS_TRY(PS_POOL_NEW(memory, &series, num, "a picture", error));
    for (size_t i = 0; i < num; i++) {
        const double points = ps_cell_number(ps_entry_of(table, "sampler", i, "points"));
        series[i] = out->panels->series[i];
        PS_TRY(scale(&series[i], memory, white[i], points, error));
    }
    *panel = (ps_panel){.num_series = num, .series = series};
    out->panels = panel;
    return PSPEC_OK;
}

/* sqrt(N), of the mean N where sets differ: what frequencies are divided by. NAN without rows. */
static double find_unit(const ps_table *table) {
    return ps_table_num_rows(table) > 0
               ? ps_cell_number(ps_table_find_cell(table, 0, "frequency")) /
                     ps_cell_number(ps_table_find_cell(table, 0, "normalized_frequency"))
               : (double)NAN;
}

bool ps_spectra_find_image(ps_plot_image *out, const ps_table *table) {
    const ps_npy_array *const full = ps_table_find_array(table, "full");
    *out = (ps_plot_image){.unit = find_unit(table)};
    if (full == NULL || full->rank != 2 || !(out->unit > 0)) {
        return false;
    }
    out->size = full->shape[0];
    out->power = full->data;
    return true;
}

static pspec_status add_image(ps_figure *out, ps_pool *memory, const ps_chart *chart,
                              ps_error *error) {
    ps_plot_image *image = NULL;
    PS_TRY(PS_POOL_NEW(memory, &image, 1, "a picture", error));
    if (ps_spectra_find_image(image, chart->parts[0].table)) {
        image->maximum = chart->image_maximum;
        image->in_decibels = chart->what->is_in_decibels;
        out->image = image;
    }
    return PSPEC_OK;
}

/* One view: of more dimensions the first two coordinates, of the sphere the half above. */
static pspec_status add_points(ps_figure *out, ps_pool *memory, const ps_npy_array *set,
                               ps_error *error) {
    ps_points_picture picture = {.num_sets = 2, .memory = memory};
    const ps_drawn_set drawn = {"the first set",
                                out->on_sphere ? PS_SAMPLES_HEMISPHERE : PS_SAMPLES_TORUS,
                                (unsigned)set->shape[1], set->shape[0], set->data};
    PS_TRY(ps_points_picture_add(&picture, &drawn, &(ps_watch){0}, error));
    out->points = picture.panels;
    return PSPEC_OK;
}

pspec_status ps_spectra_figure(ps_figure *out, ps_pool *memory, const ps_chart *chart,
                               ps_error *error) {
    const ps_table *const table = chart->parts[0].table;
    const ps_npy_array *const first = ps_table_find_array(table, "first_set");
    const ps_npy_array *const white = ps_table_find_array(table, "white_sums");
    PS_TRY(ps_lines_figure(out, memory, chart, error));
    if (white != NULL) {
        PS_TRY(scale_sums(out, memory, table, white->data, error));
    }
    if (chart->what->dealing == PS_OF_EACH) {
        PS_TRY(add_image(out, memory, chart, error));
    }
    if (chart->what->is_in_decibels && !out->axes.has_log) {
        out->axes.has_log = out->axes.is_log_x = out->axes.is_log_y = true;
    }
    /* of a scene beside the image of that question alone, and once */
    const bool is_of_scene = chart->parts[0].request->plot == NULL;
    const bool has_place =
        !is_of_scene || (chart->what->dealing == PS_OF_EACH && !chart->what->is_in_decibels);
    return first != NULL && has_place ? add_points(out, memory, first, error) : PSPEC_OK;
}

pspec_status ps_first_sets_figure(ps_figure *out, ps_pool *memory, const ps_chart *chart,
                                  ps_error *error) {
    ps_points_picture picture = {.memory = memory};
    for (size_t i = 0; i < chart->num_parts; i++) {
        picture.num_sets += ps_table_find_array(chart->parts[i].table, "first_set") != NULL;
    }
    for (size_t i = 0; i < chart->num_parts; i++) {
        const ps_npy_array *const set = ps_table_find_array(chart->parts[i].table, "first_set");
        if (set != NULL) { /* samplers beside files have none */
            const ps_drawn_set drawn = {chart->parts[i].label, PS_SAMPLES_SPHERE,
                                        (unsigned)set->shape[1], set->shape[0], set->data};
            PS_TRY(ps_points_picture_add(&picture, &drawn, chart->watch, error));
        }
    }
    *out = ps_points_picture_figure(&picture, chart->title);
    return PSPEC_OK;
}
