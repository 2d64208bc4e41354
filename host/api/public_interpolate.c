/* The public library: kernel interpolation (docs/mathematics/quadrature.md#interpolation). */
#include "api/public_objects.h"
#include "base/memory.h"
#include "jobs/pattern_check.h"
#include "math/sobolev.h"
#include "rules/kernel/kernel_system.h"

#include <math.h>
#include <stdlib.h>

typedef struct interpolant {
    pspec_context *context;
    ps_kernel_system *system;
    double smoothness;
    size_t num_points;
    double *points;  /* [num_points][3], unit vectors */
    double *alpha;   /* [num_points] */
    double *row, *x; /* [num_points] */
} interpolant;

static pspec_status check(size_t num_points, const double *points, const double *values,
                          ps_error *error) {
    ps_pattern_count count = {.realization = 0, .on_sphere = true};
    const pspec_pattern pattern = {PS_SPHERE_DIMENSION, num_points, points, NULL};
    if (num_points == 0 || points == NULL || values == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "an interpolant needs at least one point and its value");
    }
    for (size_t j = 0; j < num_points; j++) {
        if (!isfinite(values[j])) {
            return ps_fail(error, PSPEC_ERROR_INPUT, "value %zu is %g", j + 1, values[j]);
        }
    }
    return ps_pattern_count_add(&count, &pattern, error);
}

static void copy_directions(size_t num, const double *points, double *directions) {
    for (size_t j = 0; j < num; j++) {
        const double *const u = points + 3 * j;
        const double length = sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
        for (size_t i = 0; i < 3; i++) {
            directions[3 * j + i] = u[i] / length;
        }
    }
}

/* A device helps conjugate gradients; without one they use threads. */
static ps_device *find_device(pspec_context *context, size_t num_points) {
    const bool is_wanted = !ps_kernel_system_is_dense(num_points, 0, context->memory_limit);
    return is_wanted && ps_context_open_device(context) == PSPEC_OK ? context->device : NULL;
}

static pspec_status solve(interpolant *self, const double *points, const double *values,
                          ps_error *error) {
    enum { NUMBERS = PS_SPHERE_DIMENSION + 3 };
    const ps_kernel_options options = {.memory_limit = self->context->memory_limit,
                                       .device = find_device(self->context, self->num_points),
                                       .watch = &self->context->watch};
    PS_TRY(PS_NEW(&self->points, self->num_points * NUMBERS, "an interpolant", error));
    self->alpha = self->points + PS_SPHERE_DIMENSION * self->num_points;
    self->row = self->alpha + self->num_points;
    self->x = self->row + self->num_points;
    copy_directions(self->num_points, points, self->points);
    PS_TRY(ps_kernel_system_create(&self->system, self->num_points, self->points, self->smoothness,
                                   &options, error));
    return ps_kernel_system_solve(self->system, values, self->alpha, NULL, error);
}

static pspec_status find_bound(interpolant *self, const double *at, double *bound,
                               ps_error *error) {
    const double constant = ps_sobolev_constant(self->smoothness);
    double square = constant;
    for (size_t j = 0; j < self->num_points; j++) {
        self->row[j] = constant - ps_sobolev_distance(self->smoothness, at, self->points + 3 * j);
    }
    PS_TRY(ps_kernel_system_solve(self->system, self->row, self->x, NULL, error));
    for (size_t j = 0; j < self->num_points; j++) {
        square -= self->row[j] * self->x[j];
    }
    *bound = sqrt(fmax(square, 0)); /* at a point itself rounding may leave less than nothing */
    return PSPEC_OK;
}

static pspec_status add_rows(ps_table *table, interpolant *self, size_t num_at, const double *at,
                             const double *found, bool with_bounds, ps_error *error) {
    for (size_t i = 0; i < num_at; i++) {
        double bound = 0;
        PS_TRY(with_bounds ? find_bound(self, at + 3 * i, &bound, error) : PSPEC_OK);
        const ps_cell cells[] = {PS_NUMBER(found[i]), PS_NUMBER(bound)};
        PS_TRY(ps_table_add_row(table, cells, error));
    }
    return PSPEC_OK;
}

static pspec_status fill(ps_table *table, interpolant *self, const double *values, size_t num_at,
                         const double *at, bool with_bounds, ps_error *error) {
    double square = 0;
    double *found = NULL;
    for (size_t j = 0; j < self->num_points; j++) {
        square += values[j] * self->alpha[j];
    }
    const ps_meta entries[] = {
        {"norm", PS_NUMBER(sqrt(fmax(square, 0)))},
        {"condition", PS_NUMBER(ps_kernel_system_facts(self->system).condition)}};
    PS_TRY(ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error));
    PS_TRY(PS_NEW(&found, num_at, "an interpolant", error));
    ps_kernel_interpolate(self->num_points, self->points, self->smoothness, 1, self->alpha, num_at,
                          at, found);
    const pspec_status status = add_rows(table, self, num_at, at, found, with_bounds, error);
    free(found);
    return status;
}

pspec_status pspec_interpolate(pspec_answer **out, pspec_context *context, size_t num_points,
                               const double *points, const double *values, double smoothness,
                               size_t num_at, const double *at, int with_bounds) {
    static const char *const columns[] = {"value", "bound"};
    ps_answer made = {0};
    pspec_status status = PSPEC_OK;
    if (out == NULL || context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    ps_error *const error = &context->error;
    interpolant self = {.context = context, .smoothness = smoothness, .num_points = num_points};
    *out = NULL;
    PS_TRY(ps_sobolev_check(smoothness, error));
    PS_TRY(check(num_points, points, values, error));
    PS_TRY_OUT(status, solve(&self, points, values, error));
    PS_TRY_OUT(status,
               ps_table_create(&made.table, "interpolate", columns, with_bounds ? 2 : 1, error));
    PS_TRY_OUT(status, fill(made.table, &self, values, num_at, at, with_bounds != 0, error));
out:
    ps_kernel_system_destroy(self.system);
    free(self.points);
    if (status != PSPEC_OK) {
        ps_answer_free(&made);
        return status;
    }
    return ps_public_answer(out, &made, NULL, error);
}
