/* Jittered (stratified): one uniform point in each of m_1 x .. x m_d cells. In expectation
 * P(k) = 1 - prod_i sinc^2(k_i/m_i), docs/mathematics/samplers.md#spectra-on-the-torus. */
#include "samplers/list.h"

#include "samplers/pace.h"
#include "samplers/lifted.h"
#include "samplers/torus/strata.h"
#include "samplers/values.h"

enum { STRATA };

static pspec_status check(const ps_sampler_request *request, ps_error *error) {
    uint64_t counts[PS_MAX_DIMENSION];
    return ps_strata_resolve(request, STRATA, counts, error);
}

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    uint64_t counts[PS_MAX_DIMENSION];
    PS_TRY(ps_strata_resolve(request, STRATA, counts, error));
    ps_random random = ps_random_init(request->seed, PS_STREAM_COORDINATES, realization);
    PS_TRY(ps_sampler_fill_uniform(request, &random, request->dimension, points, error));
    return ps_strata_place(request, counts, points, error);
}

static pspec_status fill(const ps_sampler_request *request, ps_sampler_places *out,
                         ps_error *error) {
    return ps_strata_resolve(request, STRATA, out->numbers.counts, error);
}

const ps_sampler ps_sampler_jittered = {
    .name = "jittered",
    .stands_beside = true,
    .summary = "one uniform point in each cell of a grid",
    .aliases = {"stratified", "jitter"},
    .minimum_dimension = 1,
    .maximum_dimension = PS_MAX_DIMENSION,
    .parameters = {PS_STRATA_PARAMETER},
    .nanoseconds = 4.3,
    .is_deterministic = ps_sampler_never,
    .most_power = ps_sampler_white_power,
    .check = check,
    .generate = generate,
    .by_index = {.name = "jittered",
                 .needs_doubles = true,
                 .fill = fill,
                 .places = jittered_places,
                 .point = jittered_point},
};
