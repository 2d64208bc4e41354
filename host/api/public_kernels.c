/* The public library: sums of isotropic kernels over pairs of points. */
#include "api/public_objects.h"
#include "base/memory.h"
#include "engines/pairs/pairs_isotropic.h"
#include "jobs/pattern_check.h"

#include <math.h>
#include <stdlib.h>

/* Squares of weights below 2^450, summed over up to 2^62 pairs, are below 2^1024. */
enum { MOST_EXPONENT = 450 };

static pspec_status check_pattern(const pspec_pattern *pattern, ps_pattern_sums *sums,
                                  ps_error *error) {
    ps_frequencies degrees = {0};
    if (pattern == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "there is no pattern");
    }
    PS_TRY(ps_frequencies_degrees(&degrees, 1, false, error));
    const pspec_status status =
        ps_pattern_check(pattern, &degrees, PSPEC_NORMALIZATION_EFFECTIVE, 0, sums, error);
    ps_frequencies_free(&degrees);
    if (status == PSPEC_OK && abs(sums->exponent) > MOST_EXPONENT) {
        return ps_fail(
            error, PSPEC_ERROR_INPUT,
            "the largest |weight| is about %.3g, and must be between %.3g and %.3g, where "
            "sums over pairs are numbers; multiply all weights by a constant",
            ldexp(1, sums->exponent), ldexp(1, -MOST_EXPONENT), ldexp(1, MOST_EXPONENT));
    }
    return status;
}

/* To weights as they are, or 1/N. */
static void scale(const pspec_pattern *pattern, const ps_pattern_sums *facts, size_t num,
                  double *sums, double *bounds) {
    const double points = (double)pattern->num_points;
    const double unit =
        pattern->weights != NULL ? ldexp(1, 2 * facts->exponent) : 1 / (points * points);
    for (size_t k = 0; k < num; k++) {
        sums[k] *= unit;
        bounds[k] *= unit * facts->weight_size_sum * facts->weight_size_sum;
    }
}

pspec_status pspec_kernel_sums(pspec_context *context, const pspec_pattern *pattern,
                               const pspec_kernel *kernels, size_t num_kernels, double tolerance,
                               double *sums, double *bounds) {
    ps_pattern_sums facts;
    if (context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    ps_error *const error = &context->error;
    if (kernels == NULL || num_kernels == 0 || sums == NULL || bounds == NULL ||
        !(tolerance > 0 && tolerance <= 1)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "there are no kernels, or there is no room for their sums, or the tolerance "
                       "%g is not above 0 and at most 1",
                       tolerance);
    }
    PS_TRY(check_pattern(pattern, &facts, error));
    PS_TRY(ps_context_open_device(context));
    ps_isotropic_kernel *own = NULL;
    PS_TRY(PS_NEW(&own, num_kernels, "kernels", error));
    for (size_t k = 0; k < num_kernels; k++) {
        own[k] =
            (ps_isotropic_kernel){kernels[k].coefficients != NULL ? kernels[k].num_coefficients : 0,
                                  kernels[k].coefficients, kernels[k].power};
    }
    const pspec_status status =
        ps_pairs_isotropic_sums(context->device, pattern, facts.exponent, own, num_kernels,
                                tolerance, sums, bounds, &context->watch, error);
    free(own);
    if (status == PSPEC_OK) {
        scale(pattern, &facts, num_kernels, sums, bounds);
    }
    return status;
}
