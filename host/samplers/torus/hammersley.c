/* Hammersley: j/N, then the radical inverses of j in the first d - 1 primes. In the plane, with
 * N = 2^m, m > 1, N D* = m/3 + 13/9 - (-1)^m 4/(9 2^m) exactly. */
#include "samplers/list.h"

#include "samplers/pace.h"
#include "samplers/radical_inverse.h"
#include "samplers/values.h"

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    (void)realization;
    for (size_t j = 0; j < request->num_points; j++) {
        double *point = points + j * request->dimension;
        PS_TRY(ps_sampler_go_on(request, PS_PACE_POINTS_MADE, j, error));
        point[0] = (double)j / (double)request->num_points;
        for (unsigned i = 1; i < request->dimension; i++) {
            point[i] = radical_inverse(i - 1, j);
        }
    }
    return PSPEC_OK;
}

const ps_sampler ps_sampler_hammersley = {
    .name = "hammersley",
    .summary = "j/N and radical inverses",
    .minimum_dimension = 1,
    .maximum_dimension = PS_MAX_DIMENSION,
    .nanoseconds = 9.5,
    .is_deterministic = ps_sampler_always,
    .generate = generate,
    .by_index = {.name = "hammersley", .needs_doubles = true, .places = hammersley_places},
};
