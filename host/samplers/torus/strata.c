#include "samplers/torus/strata.h"

#include "samplers/pace.h"
#include "samplers/strata.h"
#include "samplers/values.h"

#include <string.h>

static pspec_status fail_strata(const ps_sampler_request *request, unsigned i_parameter,
                                const char *why, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "sampler %s: strata=%s %s",
                   request->sampler->name, request->values[i_parameter], why);
}

static bool product_is(const uint64_t *counts, unsigned num_counts, uint64_t expected) {
    uint64_t rest = expected;
    for (unsigned i = 0; i < num_counts; i++) {
        if (rest % counts[i] != 0) {
            return false;
        }
        rest /= counts[i];
    }
    return rest == 1;
}

pspec_status ps_strata_read(const ps_sampler_request *request, unsigned i_parameter,
                            unsigned num_axes, uint64_t counts[PS_MAX_DIMENSION], ps_error *error) {
    unsigned num_counts = 0;
    if (!ps_sampler_counts(request->values[i_parameter], counts, &num_counts)) {
        return fail_strata(request, i_parameter,
                           "is not positive whole numbers joined by x, as in 32x64", error);
    }
    if (num_counts != num_axes) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "sampler %s: strata=%s has %u numbers but %s %u", request->sampler->name,
                       request->values[i_parameter], num_counts,
                       num_axes == request->dimension ? "the dimension is" : "must have", num_axes);
    }
    if (!product_is(counts, num_counts, request->num_points)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "sampler %s: strata=%s does not make one stratum for each of %zu points",
                       request->sampler->name, request->values[i_parameter], request->num_points);
    }
    return PSPEC_OK;
}

static pspec_status fail_aspect(const ps_sampler_request *request, ps_error *error) {
    uint64_t below = 0;
    uint64_t above = 0;
    ps_strata_nearest(request->num_points, request->dimension, &below, &above);
    return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                   "sampler %s: %zu points cannot be laid out in %u dimensions with sides in a "
                   "ratio of at most 2; use %llu or %llu points, or give strata=",
                   request->sampler->name, request->num_points, request->dimension,
                   (unsigned long long)below, (unsigned long long)above);
}

pspec_status ps_strata_resolve(const ps_sampler_request *request, unsigned i_parameter,
                               uint64_t counts[PS_MAX_DIMENSION], ps_error *error) {
    if (strcmp(request->values[i_parameter], PS_STRATA_AUTO) != 0) {
        return ps_strata_read(request, i_parameter, request->dimension, counts, error);
    }
    return ps_strata_factorise(request->num_points, request->dimension, counts)
               ? PSPEC_OK
               : fail_aspect(request, error);
}

double ps_stratum_point(double i, double offset, double m) {
    return stratum_point(i, offset, m);
}

/* cell: an odometer whose last axis moves fastest. */
static void advance(double *cell, const double *counts, unsigned dimension) {
    for (unsigned i = dimension; i-- > 0;) {
        cell[i] += 1;
        if (cell[i] < counts[i]) {
            return;
        }
        cell[i] = 0;
    }
}

pspec_status ps_strata_place(const ps_sampler_request *request,
                             const uint64_t counts[PS_MAX_DIMENSION], double *points,
                             ps_error *error) {
    double cell[PS_MAX_DIMENSION] = {0};
    double m[PS_MAX_DIMENSION] = {0};
    for (unsigned i = 0; i < request->dimension; i++) {
        m[i] = (double)counts[i];
    }
    for (size_t j = 0; j < request->num_points; j++) {
        double *point = points + j * request->dimension;
        PS_TRY(ps_sampler_go_on(request, "sampler: points in strata", j, error));
        for (unsigned i = 0; i < request->dimension; i++) {
            point[i] = stratum_point(cell[i], point[i], m[i]);
        }
        advance(cell, m, request->dimension);
    }
    return PSPEC_OK;
}
