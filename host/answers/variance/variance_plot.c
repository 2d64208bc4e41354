/* Variances against N. */
#include "answers/variance/variance_table.h"
#include "base/memory.h"
#include "plots/plot.h"

#include <math.h>
#include <stdlib.h>

/* Of a sampler and an integrand; white noise is one more line of each integrand. */
typedef enum curve_form { PREDICTED, MEASURED, NUM_FORMS } curve_form;

typedef struct curves {
    size_t num, num_counts;
    ps_series *series; /* [num] */
    ps_text *labels;   /* [num] */
    double *numbers;   /* [num][x, y][num_counts] */
} curves;

static void release(curves *self) {
    for (size_t i = 0; self->labels != NULL && i < self->num; i++) {
        ps_text_free(&self->labels[i]);
    }
    free(self->series);
    free(self->labels);
    free(self->numbers);
}

/* Files are one. */
static size_t count_samplers(const ps_request *request) {
    return request->num_samplers > 0 ? request->num_samplers : 1;
}

static double value_of(const ps_variance_row *row, curve_form form) {
    return form == PREDICTED  ? row->prediction.variance
           : form == MEASURED ? row->measured
                              : row->prediction.white;
}

/* form NUM_FORMS: white noise. */
static pspec_status add_curve(curves *self, size_t index, const ps_request *request,
                              ps_variance_job *const *jobs, size_t sampler, size_t integrand,
                              curve_form form, ps_error *error) {
    static const char *const names[] = {"predicted", "measured", "white noise"};
    double *const x = self->numbers + 2 * index * self->num_counts;
    double *const y = x + self->num_counts;
    ps_text *const label = &self->labels[index];
    for (size_t i = 0; i < self->num_counts; i++) {
        const ps_variance_job *const job = jobs[sampler * self->num_counts + i];
        x[i] = ps_power_job_spectrum(ps_variance_job_spectrum(job))->mean_points;
        y[i] = value_of(&ps_variance_job_rows(job)[integrand], form);
    }
    if (form != NUM_FORMS && request->num_samplers > 1) {
        ps_text_append(label, "%s, ", request->samplers[sampler]);
    }
    if (request->num_integrands > 1) {
        ps_text_append(label, "%s, ", request->integrands[integrand]);
    }
    ps_text_append(label, "%s", names[form]);
    ps_series *const series = &self->series[index];
    *series = (ps_series){.kind = index, .num = self->num_counts, .x = x, .y = y};
    ps_series_say_slope(series, label);
    series->label = ps_text_string(label);
    return ps_text_check(label, error);
}

static pspec_status add_all(curves *self, const ps_request *request, ps_variance_job *const *jobs,
                            ps_error *error) {
    size_t index = 0;
    for (size_t integrand = 0; integrand < request->num_integrands; integrand++) {
        for (size_t sampler = 0; sampler < count_samplers(request); sampler++) {
            for (int form = PREDICTED; form < NUM_FORMS; form++) {
                PS_TRY(add_curve(self, index++, request, jobs, sampler, integrand, (curve_form)form,
                                 error));
            }
        }
        PS_TRY(add_curve(self, index++, request, jobs, 0, integrand, NUM_FORMS, error));
    }
    return PSPEC_OK;
}

static pspec_status write_figure(const curves *self, const ps_request *request, ps_error *error) {
    ps_text title = {0};
    ps_text_append(&title, "%s",
                   request->num_integrands == 1 ? request->integrands[0] : "variance");
    if (request->num_samplers > 0) {
        ps_text_append(&title, ", %llu sets", (unsigned long long)request->num_realizations);
    }
    if (request->num_samplers == 1) {
        ps_text_append(&title, " of %s", request->samplers[0]);
    }
    const ps_panel panel = {NULL, self->num, self->series};
    const ps_figure figure = {.form = PS_FIGURE_FRAME,
                              .title = ps_text_string(&title),
                              .x_label = "points N",
                              .y_label = "variance of the estimate",
                              .axes = request->plot_axes,
                              .is_log_x = true,
                              .is_log_y = true,
                              .num_panels = 1,
                              .panels = &panel};
    pspec_status status = ps_text_check(&title, error);
    if (status == PSPEC_OK) {
        status = ps_figure_write(request->plot, &figure, error);
    }
    ps_text_free(&title);
    return status;
}

pspec_status ps_variance_plot(const ps_request *request, ps_variance_job *const *jobs, size_t num,
                              ps_error *error) {
    curves self = {.num = request->num_integrands * (count_samplers(request) * NUM_FORMS + 1),
                   .num_counts = num / count_samplers(request)};
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, PS_NEW(&self.series, self.num, "a picture", error));
    PS_TRY_OUT(status, PS_NEW(&self.labels, self.num, "a picture", error));
    PS_TRY_OUT(status, PS_NEW(&self.numbers, 2 * self.num * self.num_counts, "a picture", error));
    PS_TRY_OUT(status, add_all(&self, request, jobs, error));
    PS_TRY_OUT(status, write_figure(&self, request, error));
out:
    release(&self);
    return status;
}
