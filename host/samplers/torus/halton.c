/* Halton: point j has the radical inverses of start + j in the first d primes (J. H. Halton 1960).
 */
#include "samplers/list.h"

#include "base/text.h"
#include "samplers/pace.h"
#include "samplers/radical_inverse.h"
#include "samplers/values.h"

enum { START };

static pspec_status first_index(const ps_sampler_request *request, uint64_t *start,
                                ps_error *error) {
    const uint64_t most = RADICAL_INVERSE_LIMIT - request->num_points;
    return ps_parse_count(request->values[START], "sampler halton: start", 0, most, start, error);
}

static pspec_status check(const ps_sampler_request *request, ps_error *error) {
    uint64_t start = 0;
    return first_index(request, &start, error);
}

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    (void)realization;
    uint64_t start = 0;
    PS_TRY(first_index(request, &start, error));
    for (size_t j = 0; j < request->num_points; j++) {
        PS_TRY(ps_sampler_go_on(request, PS_PACE_POINTS_MADE, j, error));
        for (unsigned i = 0; i < request->dimension; i++) {
            points[j * request->dimension + i] = radical_inverse(i, start + j);
        }
    }
    return PSPEC_OK;
}

static pspec_status fill(const ps_sampler_request *request, ps_sampler_places *out,
                         ps_error *error) {
    return first_index(request, &out->numbers.start, error);
}

const ps_sampler ps_sampler_halton = {
    .name = "halton",
    .summary = "radical inverses in the first primes",
    .minimum_dimension = 1,
    .maximum_dimension = PS_MAX_DIMENSION,
    .parameters = {{"start", "0", "index of the first point"}},
    .nanoseconds = 9.5,
    .is_deterministic = ps_sampler_always,
    .check = check,
    .generate = generate,
    .by_index = {.name = "halton", .needs_doubles = true, .fill = fill, .places = halton_places},
};
