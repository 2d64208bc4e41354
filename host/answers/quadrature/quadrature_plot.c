#include "answers/quadrature/quadrature_table.h"
#include "answers/spectra/spectrum_header.h"
#include "base/memory.h"
#include "plots/plot.h"

#include <stdio.h>
#include <stdlib.h>

/* Lines of a job: d_l^2, C_l^2, e_l^2. */
enum { LINES = 3 };

typedef struct curves {
    double *numbers; /* [1 + LINES][max_degree + 1] */
} curves;

static pspec_status make_curves(curves *out, ps_series *lines, size_t first, const char *sampler,
                                const ps_quadrature_result *result, ps_error *error) {
    static const char *const names[LINES] = {"d_l^2", "C_l^2", "e_l^2"};
    const size_t num = result->max_degree + 1;
    PS_TRY(PS_NEW(&out->numbers, (1 + LINES) * num, "a picture", error));
    for (size_t l = 0; l < num; l++) {
        const ps_quadrature_degree *const degree = &result->degrees[l];
        out->numbers[l] = (double)l;
        out->numbers[num + l] = degree->d2.mean;
        out->numbers[2 * num + l] = degree->c2.mean;
        out->numbers[3 * num + l] = degree->e2.mean;
    }
    for (size_t i = 0; i < LINES; i++) {
        lines[i] = (ps_series){.formula = names[i],
                               .label = sampler,
                               .kind = first + i,
                               .num = num,
                               .floor = result->numerical_bound,
                               .x = out->numbers,
                               .y = out->numbers + (i + 1) * num};
    }
    return PSPEC_OK;
}

typedef struct axis_labels {
    const char *x, *y;
} axis_labels;

static pspec_status write_plot(const ps_request *arguments, const axis_labels *labels,
                               const ps_series *lines, size_t num_lines,
                               const ps_quadrature_result *results, size_t num, ps_error *error) {
    ps_text title = {0};
    ps_points_span span = {0};
    for (size_t i = 0; i < num; i++) {
        ps_points_span_add(&span,
                           &(ps_points_range){results[i].mean_points, results[i].smallest_points,
                                              results[i].largest_points});
    }
    ps_text_append(&title, "%s, smoothness %g", arguments->brdf, arguments->smoothness);
    ps_points_span_show(&span, &title);
    ps_text_append(&title, ", %llu realization%s", (unsigned long long)results[0].num_realizations,
                   results[0].num_realizations == 1 ? "" : "s");
    const ps_panel panel = {NULL, num_lines, lines};
    const ps_figure figure = {.form = PS_FIGURE_FRAME,
                              .title = ps_text_string(&title),
                              .x_label = labels->x,
                              .y_label = labels->y,
                              .axes = arguments->plot_axes,
                              .is_log_x = true,
                              .is_log_y = true,
                              .num_panels = 1,
                              .panels = &panel};
    pspec_status status = ps_text_check(&title, error);
    if (status == PSPEC_OK) {
        status = ps_figure_write(arguments->plot, &figure, error);
    }
    ps_text_free(&title);
    return status;
}

pspec_status ps_quadrature_plot(const ps_request *arguments, const ps_quadrature_list *list,
                                const ps_quadrature_result *results, ps_error *error) {
    static const axis_labels labels = {"degree l",
                                       "{/*1.35 d_l^2 ,  C_l^2 ,  e_l^2 = a_l (d_l^2 + C_l^2 )}"};
    curves all[PS_MAX_SAMPLERS] = {{.numbers = NULL}};
    ps_series lines[LINES * PS_MAX_SAMPLERS];
    pspec_status status = PSPEC_OK;
    for (size_t i = 0; i < list->num; i++) {
        const char *const sampler = list->num > 1 ? ps_request_name(arguments, i) : NULL;
        PS_TRY_OUT(status,
                   make_curves(&all[i], lines + LINES * i, LINES * i, sampler, &results[i], error));
    }
    status = write_plot(arguments, &labels, lines, LINES * list->num, results, list->num, error);
out:
    for (size_t i = 0; i < list->num; i++) {
        free(all[i].numbers);
    }
    return status;
}

/* ---- E against N --------------------------------------------------------------------------- */

typedef struct error_lines {
    size_t num;
    ps_series series[PS_MAX_SAMPLERS];
    ps_text labels[PS_MAX_SAMPLERS];
    double *numbers; /* N and E of all questions */
} error_lines;

/* The line of a sampler: its questions stand together. */
static pspec_status take_errors(error_lines *out, size_t line, const ps_request *arguments,
                                const ps_quadrature_result *results, ps_error *error) {
    const size_t num = arguments->num_counts;
    double *const x = out->numbers + 2 * num * line;
    double *const y = x + num;
    ps_text *const label = &out->labels[line];
    for (size_t i = 0; i < num; i++) {
        const ps_quadrature_result *const result = &results[line * num + i];
        x[i] = result->mean_points;
        y[i] = ps_quadrature_error(result);
    }
    ps_series *const series = &out->series[line];
    *series = (ps_series){.kind = line, .num = num, .x = x, .y = y};
    if (out->num > 1) {
        ps_text_append(label, "%s", ps_request_name(arguments, line * num));
    }
    ps_series_say_slope(series, label);
    series->label = ps_text_string(label);
    return ps_text_check(label, error);
}

pspec_status ps_quadrature_plot_errors(const ps_request *arguments, const char *x_label,
                                       const char *y_label, const ps_quadrature_result *results,
                                       ps_error *error) {
    const axis_labels labels = {x_label, y_label};
    const size_t num_counts = arguments->num_counts;
    error_lines lines = {.num = ps_request_num_questions(arguments) / num_counts};
    pspec_status status = PSPEC_OK;
    PS_TRY(PS_NEW(&lines.numbers, 2 * num_counts * lines.num, "a picture", error));
    for (size_t i = 0; i < lines.num; i++) {
        PS_TRY_OUT(status, take_errors(&lines, i, arguments, results, error));
    }
    status = write_plot(arguments, &labels, lines.series, lines.num, results,
                        lines.num * num_counts, error);
out:
    for (size_t i = 0; i < lines.num; i++) {
        ps_text_free(&lines.labels[i]);
    }
    free(lines.numbers);
    return status;
}
