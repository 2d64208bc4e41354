/* The public library: kernel interpolation (docs/mathematics/quadrature.md#interpolation). */
#include "api/public_objects.h"
#include "base/memory.h"
#include "jobs/pattern_check.h"
#include "math/sobolev.h"
#include "rules/kernel/kernel_system.h"

#include <math.h>
#include <stdlib.h>

struct pspec_interpolant {
    pspec_context *context;
    ps_kernel_system *system;
    double smoothness, norm;
    size_t num_points;
    double *points;  /* [num_points][3], unit vectors */
    double *alpha;   /* [num_points] */
    double *row, *x; /* [num_points] */
};

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

static pspec_status allocate(pspec_interpolant *self, ps_error *error) {
    enum { NUMBERS = PS_SPHERE_DIMENSION + 3 };
    PS_TRY(PS_NEW(&self->points, self->num_points * NUMBERS, "an interpolant", error));
    self->alpha = self->points + PS_SPHERE_DIMENSION * self->num_points;
    self->row = self->alpha + self->num_points;
    self->x = self->row + self->num_points;
    return PSPEC_OK;
}

/* A device helps conjugate gradients; without one they use threads. */
static ps_device *find_device(pspec_context *context, size_t num_points) {
    const bool is_wanted = !ps_kernel_system_is_dense(num_points, context->memory_limit);
    return is_wanted && ps_context_open_device(context) == PSPEC_OK ? context->device : NULL;
}

static pspec_status make(pspec_interpolant *self, const double *points, const double *values,
                         ps_error *error) {
    const ps_kernel_options options = {.memory_limit = self->context->memory_limit,
                                       .device = find_device(self->context, self->num_points),
                                       .watch = &self->context->watch};
    double square = 0;
    PS_TRY(allocate(self, error));
    copy_directions(self->num_points, points, self->points);
    PS_TRY(ps_kernel_system_create(&self->system, self->num_points, self->points, self->smoothness,
                                   &options, error));
    PS_TRY(ps_kernel_system_solve(self->system, values, self->alpha, NULL, error));
    for (size_t j = 0; j < self->num_points; j++) {
        square += values[j] * self->alpha[j];
    }
    self->norm = sqrt(fmax(square, 0));
    return PSPEC_OK;
}

pspec_status pspec_interpolant_create(pspec_interpolant **out, pspec_context *context,
                                      size_t num_points, const double *points, const double *values,
                                      double smoothness) {
    if (out == NULL || context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    ps_error *const error = &context->error;
    *out = NULL;
    PS_TRY(ps_sobolev_check(smoothness, error));
    PS_TRY(check(num_points, points, values, error));
    pspec_interpolant *self = NULL;
    PS_TRY(PS_NEW(&self, 1, "an interpolant", error));
    self->context = context;
    self->smoothness = smoothness;
    self->num_points = num_points;
    const pspec_status status = make(self, points, values, error);
    if (status != PSPEC_OK) {
        pspec_interpolant_destroy(self);
        return status;
    }
    *out = self;
    return PSPEC_OK;
}

void pspec_interpolant_destroy(pspec_interpolant *interpolant) {
    if (interpolant != NULL) {
        ps_kernel_system_destroy(interpolant->system);
        free(interpolant->points);
        free(interpolant);
    }
}

void pspec_interpolant_evaluate(const pspec_interpolant *interpolant, size_t num, const double *at,
                                double *values) {
    ps_kernel_interpolate(interpolant->num_points, interpolant->points, interpolant->smoothness,
                          interpolant->alpha, num, at, values);
}

double pspec_interpolant_norm(const pspec_interpolant *interpolant) {
    return interpolant->norm;
}

double pspec_interpolant_condition(const pspec_interpolant *interpolant) {
    return ps_kernel_system_facts(interpolant->system).condition;
}

pspec_status pspec_interpolant_bound(pspec_interpolant *interpolant, size_t num, const double *at,
                                     double *bounds) {
    pspec_interpolant *const self = interpolant;
    const double constant = ps_sobolev_constant(self->smoothness);
    for (size_t i = 0; i < num; i++) {
        double square = constant;
        for (size_t j = 0; j < self->num_points; j++) {
            self->row[j] =
                constant - ps_sobolev_distance(self->smoothness, at + 3 * i, self->points + 3 * j);
        }
        PS_TRY(
            ps_kernel_system_solve(self->system, self->row, self->x, NULL, &self->context->error));
        for (size_t j = 0; j < self->num_points; j++) {
            square -= self->row[j] * self->x[j];
        }
        bounds[i] =
            sqrt(fmax(square, 0)); /* at a point itself rounding may leave less than nothing */
    }
    return PSPEC_OK;
}
