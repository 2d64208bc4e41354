/* Regular grid: the centres of m_1 x .. x m_d cells, N = m_1 .. m_d; P(k) = N where every m_i
 * divides k_i, else 0. */
#include "samplers/list.h"

#include "samplers/pace.h"
#include "samplers/strata.h"
#include "samplers/torus/strata.h"
#include "samplers/values.h"

enum { STRATA };

static pspec_status check(const ps_sampler_request *request, ps_error *error) {
    uint64_t counts[PS_MAX_DIMENSION];
    return ps_strata_resolve(request, STRATA, counts, error);
}

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    (void)realization;
    uint64_t counts[PS_MAX_DIMENSION];
    PS_TRY(ps_strata_resolve(request, STRATA, counts, error));
    PS_TRY(ps_sampler_fill_centres(request, request->dimension, points, error));
    return ps_strata_place(request, counts, points, error);
}

static pspec_status fill(const ps_sampler_request *request, ps_sampler_places *out,
                         ps_error *error) {
    return ps_strata_resolve(request, STRATA, out->numbers.counts, error);
}

const ps_sampler ps_sampler_regular = {
    .name = "regular",
    .summary = "centres of the cells of a grid",
    .aliases = {"grid"},
    .minimum_dimension = 1,
    .maximum_dimension = PS_MAX_DIMENSION,
    .parameters = {PS_STRATA_PARAMETER},
    .nanoseconds = 2.2,
    .is_deterministic = ps_sampler_always,
    .check = check,
    .generate = generate,
    .by_index = {.name = "regular", .needs_doubles = true, .fill = fill, .places = regular_places},
};
