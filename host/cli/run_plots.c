/* Pictures of the results of a scene, made from their tables: spectra here, lines in run_lines.c. */
#include "base/memory.h"
#include "cli/run_drawing.h"

#include <math.h>
#include <stdlib.h>

/* ---- spectra ----------------------------------------------------------------------------- */

enum { CURVE_COLUMNS = 4 };

static pspec_status take_curve(const ps_artist *of, size_t number, ps_plot_curve *out,
                               ps_text *label, double **numbers) {
    const ps_table *const table = of->result->questions[number].answer.table;
    const bool on_torus = of->result->asked->kind == &ps_result_power;
    const size_t num = ps_table_num_rows(table);
    void *memory = NULL;
    PS_TRY(ps_allocate(&memory, num, CURVE_COLUMNS * sizeof(double), "a curve", of->error));
    double *const columns = *numbers = memory;
    ps_read_column(table, on_torus ? "normalized_frequency" : "normalized_degree", columns);
    ps_read_column(table, "power", columns + num);
    ps_read_column(table, "standard_error", columns + 2 * num);
    ps_read_column(table, "anisotropy_db", columns + 3 * num);
    ps_run_label(of->result, number, label);
    *out = (ps_plot_curve){ps_text_string(label), num, columns, columns + num, columns + 2 * num,
                           columns + 3 * num};
    return ps_text_check(label, of->error);
}

static double noise_level(const ps_artist *of, size_t number) {
    const ps_table *const table = of->result->questions[number].answer.table;
    return ps_cell_number(ps_run_meta(table, "noise_level_db"));
}

/* Curves of a group; with an array, the picture of one spectrum. */
static pspec_status draw_spectra(const ps_artist *of, const ps_plot_group *part,
                                 const ps_plot_image *image, const char *suffix) {
    ps_plot_curve curves[PS_MOST_CURVES];
    ps_text labels[PS_MOST_CURVES] = {{0}};
    double *numbers[PS_MOST_CURVES] = {NULL};
    ps_text title = {0};
    pspec_status status = PSPEC_OK;
    for (size_t i = 0; i < part->num; i++) {
        PS_TRY_OUT(status, take_curve(of, part->first + i, &curves[i], &labels[i], &numbers[i]));
    }
    ps_plot_title(of, part, image != NULL ? curves[0].label : "", &title);
    PS_TRY_OUT(status, ps_text_check(&title, of->error));
    const ps_plot plot = {ps_text_string(&title),
                          part->num,
                          curves,
                          image,
                          noise_level(of, part->first),
                          of->result->asked->kind != &ps_result_power};
    status = ps_draw(of, &(ps_drawing){.spectra = &plot}, suffix);
out:
    for (size_t i = 0; i < PS_MOST_CURVES; i++) {
        ps_text_free(&labels[i]);
        free(numbers[i]);
    }
    ps_text_free(&title);
    return status;
}

static pspec_status draw_groups(const ps_artist *of) {
    char suffix[64];
    for (size_t g = 0; g < ps_num_plot_groups(of->result); g++) {
        const ps_plot_group part = ps_plot_group_at(of->result, g);
        snprintf(suffix, sizeof suffix, "-%zu", g + 1);
        if (part.num <= PS_MOST_CURVES) {
            PS_TRY(draw_spectra(of, &part, NULL, part.value != NULL ? suffix : ""));
        }
    }
    return PSPEC_OK;
}

/* Of every question whose array was wanted and is there. */
static pspec_status draw_pictures(const ps_artist *of) {
    char suffix[64];
    for (size_t q = 0; q < of->result->num; q++) {
        const ps_answer *const answer = &of->result->questions[q].answer;
        const double points = ps_cell_number(ps_run_meta(answer->table, "points"));
        if (answer->array == NULL || !(points > 0)) {
            continue;
        }
        const ps_plot_image image = {answer->side, answer->array, sqrt(points)};
        snprintf(suffix, sizeof suffix, "-picture-%zu", q + 1);
        PS_TRY(draw_spectra(of, &(ps_plot_group){q, 1, NULL}, &image, suffix));
    }
    return PSPEC_OK;
}

/* Lists of frequencies have no normalized ones, and no picture. */
static bool has_bins(const ps_run_result *result) {
    size_t column = 0;
    const ps_table *const table = result->questions[0].answer.table;
    return ps_table_find_column(table, "normalized_frequency", &column) ||
           ps_table_find_column(table, "normalized_degree", &column);
}

pspec_status ps_run_make_plots(const ps_run *run, ps_run_result *result, ps_error *error) {
    const ps_artist of = {run, result, error};
    const ps_result_kind *const kind = result->asked->kind;
    if (!result->asked->wants_plot) {
        return PSPEC_OK;
    }
    if (kind != &ps_result_power && kind != &ps_result_angular) {
        return ps_draw_lines(&of);
    }
    if (!has_bins(result)) {
        return PSPEC_OK;
    }
    PS_TRY(draw_groups(&of));
    return draw_pictures(&of);
}
