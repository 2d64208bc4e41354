#include "base/memory.h"
#include "plots/plot.h"
#include "report/quadrature_table.h"

#include <stdio.h>
#include <stdlib.h>

/* Lines of a job: d_l^2, C_l^2, e_l^2. */
enum { LINES = 3 };

typedef struct curves {
    double *numbers; /* [1 + LINES][max_degree + 1] */
} curves;

static pspec_status make_curves(curves *out, ps_series *lines, size_t first, const char *sampler,
                                const ps_quadrature_result *result, ps_error *error) {
    static const char *const names[LINES] = {"d@_l^2", "C@_l^2", "e@_l^2"};
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
                               .x = out->numbers,
                               .y = out->numbers + (i + 1) * num};
    }
    return PSPEC_OK;
}

static pspec_status write_plot(const ps_request *arguments, const ps_series *lines,
                               size_t num_lines, const ps_quadrature_result *first,
                               ps_error *error) {
    ps_text title = {0};
    ps_text_append(&title, "%s, smoothness %g, N = %.6g, %llu realization%s", arguments->brdf,
                   arguments->smoothness, first->mean_points,
                   (unsigned long long)first->num_realizations,
                   first->num_realizations == 1 ? "" : "s");
    const ps_panel panel = {NULL, num_lines, lines};
    const ps_figure figure = {.form = PS_FIGURE_FRAME,
                              .title = ps_text_string(&title),
                              .x_label = "degree l",
                              .y_label = "d@_l^2 , C@_l^2 , e@_l^2 = a_l (d@_l^2 + C@_l^2 )",
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
    curves all[PS_MAX_SAMPLERS] = {{.numbers = NULL}};
    ps_series lines[LINES * PS_MAX_SAMPLERS];
    pspec_status status = PSPEC_OK;
    for (size_t i = 0; i < list->num; i++) {
        const char *const sampler = list->num > 1 ? arguments->samplers[i] : NULL;
        PS_TRY_OUT(status,
                   make_curves(&all[i], lines + LINES * i, LINES * i, sampler, &results[i], error));
    }
    status = write_plot(arguments, lines, LINES * list->num, &results[0], error);
out:
    for (size_t i = 0; i < list->num; i++) {
        free(all[i].numbers);
    }
    return status;
}
