/* Lattices of rank 1: x_j = j z / N mod 1. P(k) = N where k.z is a multiple of N, else 0
 * (docs/mathematics/samplers.md#spectra-on-the-torus). */
#include "samplers/list.h"

#include "samplers/pace.h"
#include "samplers/torus/lattice.h"
#include "samplers/values.h"

#include <math.h>
#include <string.h>

enum { GENERATOR, PLANE = 2 };
#define AUTO "auto"

/* ---- lattices ------------------------------------------------------------------------------ */

pspec_status ps_lattice_generate(const ps_sampler_request *request,
                                 const uint64_t z[PS_MAX_DIMENSION], double *points,
                                 ps_error *error) {
    const uint64_t num = request->num_points;
    uint64_t at[PS_MAX_DIMENSION] = {0};
    for (uint64_t j = 0; j < num; j++) {
        PS_TRY(ps_sampler_go_on(request, PS_PACE_POINTS_MADE, j, error));
        for (unsigned i = 0; i < request->dimension; i++) {
            points[j * request->dimension + i] = (double)at[i] / (double)num;
            at[i] = (at[i] + z[i] % num) % num;
        }
    }
    return PSPEC_OK;
}

static uint64_t common_divisor(uint64_t a, uint64_t b) {
    while (b > 0) {
        const uint64_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

uint64_t ps_lattice_golden(uint64_t num_points) {
    const double golden = (double)num_points * (sqrt(5) - 1) / 2;
    const uint64_t nearest = (uint64_t)rint(golden);
    const bool is_below = (double)nearest < golden; /* then the next nearest is above it */
    for (uint64_t apart = 0;; apart++) {
        const uint64_t below = apart < nearest ? nearest - apart : 1;
        const uint64_t tries[] = {is_below ? nearest + apart : below,
                                  is_below ? below : nearest + apart};
        for (size_t i = 0; i < 2; i++) {
            if (common_divisor(tries[i], num_points) == 1) {
                return tries[i];
            }
        }
    }
}

/* ---- the sampler --------------------------------------------------------------------------- */

static pspec_status find_generator(const ps_sampler_request *request, uint64_t z[PS_MAX_DIMENSION],
                                   ps_error *error) {
    const char *const text = request->values[GENERATOR];
    unsigned num = 0;
    if (strcmp(text, AUTO) == 0 && request->dimension <= PLANE) {
        z[0] = 1;
        z[1] = ps_lattice_golden(request->num_points);
        return PSPEC_OK;
    }
    if (strcmp(text, AUTO) == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "sampler rank1: in %u dimensions generator=AxBx.. must be given, as from "
                       "tables or a search; auto is for the plane",
                       request->dimension);
    }
    return ps_sampler_counts(text, z, &num) && num == request->dimension
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "sampler rank1: generator=%s is not %u positive whole numbers joined by "
                         "x, as in 1x610",
                         text, request->dimension);
}

static pspec_status check(const ps_sampler_request *request, ps_error *error) {
    uint64_t z[PS_MAX_DIMENSION];
    PS_TRY(ps_sampler_limit_points(request, PS_LATTICE_MOST_POINTS, error));
    return find_generator(request, z, error);
}

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    uint64_t z[PS_MAX_DIMENSION];
    (void)realization;
    PS_TRY(find_generator(request, z, error));
    return ps_lattice_generate(request, z, points, error);
}

const ps_sampler ps_sampler_rank1 = {
    .name = "rank1",
    .summary = "lattice of rank 1, j z / N",
    .aliases = {"rank-1", "korobov"},
    .minimum_dimension = 1,
    .maximum_dimension = PS_MAX_DIMENSION,
    .parameters = {{"generator", AUTO,
                    "AxB.., z; auto: 1 and the nearest to N over the golden ratio"}},
    .nanoseconds = 6,
    .is_deterministic = ps_sampler_always,
    .check = check,
    .generate = generate,
};
