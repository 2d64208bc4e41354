/* Coefficients of one pattern. */
#include "base/memory.h"
#include "jobs/estimator_private.h"

#include <math.h>
#include <stdlib.h>

/* (x, y, z), z >= 0, of any length -> the unit vector of the same azimuth with height 2 z / |u| -
 * 1. Hemispherical harmonics are those of the sphere there, times sqrt(2): they are orthonormal on
 * the hemisphere (docs/mathematics/quadrature.md#hemispherical-harmonics). False below the
 * horizon. */
static bool stretch_vector(const double *u, double *out) {
    const double rho = hypot(u[0], u[1]);
    const double length = hypot(rho, u[2]);
    /* 1 - z without cancellation near the pole; it doubles. */
    const double t = 2 * (rho / length) * (rho / (length + u[2]));
    const double stretched = sqrt(t * fmax(2 - t, 0));
    if (!(u[2] >= 0)) {
        return false;
    }
    out[0] = rho > 0 ? u[0] / rho * stretched : 0;
    out[1] = rho > 0 ? u[1] / rho * stretched : 0;
    out[2] = 1 - t;
    return true;
}

/* vectors: [num_points][3], freed by the caller. */
static pspec_status stretch(const pspec_pattern *pattern, double **vectors, ps_error *error) {
    PS_TRY(ps_allocate_for(vectors, pattern->num_points, PS_SPHERE_DIMENSION * sizeof(double),
                           "the stretched hemisphere", error));
    for (size_t j = 0; j < pattern->num_points; j++) {
        const size_t at = j * PS_SPHERE_DIMENSION;
        if (!stretch_vector(pattern->points + at, *vectors + at)) {
            return ps_fail(error, PSPEC_ERROR_INPUT,
                           "point %zu, z = %.17g, is below the horizon: hemispherical harmonics "
                           "are for z >= 0",
                           j + 1, pattern->points[at + 2]);
        }
    }
    return PSPEC_OK;
}

/* sqrt(2) makes spherical harmonics on the stretched hemisphere orthonormal on the hemisphere. */
static pspec_status run_stretched(ps_estimator *self, const ps_batch *one, double *out,
                                  ps_error *error) {
    const double root_two = 1.4142135623730950488;
    pspec_pattern stretched = *one->patterns;
    ps_batch batch = *one;
    double *vectors = NULL;
    pspec_status status = stretch(one->patterns, &vectors, error);
    if (status == PSPEC_OK) {
        stretched.points = vectors;
        batch.patterns = &stretched;
        status = self->options.engine->coefficients(self->engine_state, &batch, NULL, out, error);
    }
    free(vectors);
    const size_t num = ps_num_coefficients(self->options.problem.frequencies->max_frequency);
    for (size_t i = 0; status == PSPEC_OK && i < num; i++) {
        out[i] *= root_two;
    }
    return status;
}

static pspec_status require_coefficients(const ps_estimator *self, ps_error *error) {
    const ps_engine *engine = self->options.engine;
    return engine->coefficients != NULL
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s has no coefficients; ask the plan for an engine that has them",
                         engine->name);
}

static pspec_status keep_one(const ps_estimator *self, const ps_batch *one, ps_error *error) {
    const double sum = ldexp(self->sums[0].weight_sum, one->exponents[0]);
    return self->options.keep(self->options.payload, self->options.coefficients, sum, error);
}

pspec_status ps_estimator_run_with_coefficients(ps_estimator *self, const ps_batch *one,
                                                ps_rows *rows, ps_error *error) {
    const ps_engine *engine = self->options.engine;
    double *out = self->options.coefficients;
    PS_TRY(require_coefficients(self, error));
    if (self->options.problem.harmonics != PS_HEMISPHERICAL_HARMONICS) {
        PS_TRY(engine->coefficients(self->engine_state, one, rows, out, error));
        return self->options.keep != NULL ? keep_one(self, one, error) : PSPEC_OK;
    }
    PS_TRY(run_stretched(self, one, out, error)); /* first: it refuses points below the horizon */
    return engine->run(self->engine_state, one, rows, error);
}

pspec_status ps_estimator_coefficients(ps_estimator *estimator, const pspec_pattern *pattern,
                                       ps_harmonics harmonics, double *out, ps_error *error) {
    const ps_estimator_options *options = &estimator->options;
    ps_pattern_sums sums = {0};
    const ps_batch one = {.num_patterns = 1,
                          .patterns = pattern,
                          .exponents = &sums.exponent,
                          .should_stop = options->should_stop,
                          .payload = options->payload};
    PS_TRY(require_coefficients(estimator, error));
    /* any weights will do, also those that sum to 0 */
    PS_TRY(ps_pattern_check(pattern, options->problem.frequencies, PSPEC_NORMALIZATION_EFFECTIVE, 0,
                            &sums, error));
    PS_TRY(ps_estimator_get_ready(estimator, pattern->num_points, error));
    return harmonics == PS_HEMISPHERICAL_HARMONICS
               ? run_stretched(estimator, &one, out, error)
               : options->engine->coefficients(estimator->engine_state, &one, NULL, out, error);
}
