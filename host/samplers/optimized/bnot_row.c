/* The row of BNOT: docs/samplers/optimized.md#bnot. */
#include "samplers/list.h"

#include "base/text.h"
#include "samplers/optimized/bnot.h"
#include "samplers/optimized/bnot_weights.h"
#include "samplers/optimized/cells.h"
#include "samplers/values.h"

#include <math.h>

enum { EPS };

static pspec_status eps_of(const ps_sampler_request *request, double *eps, ps_error *error) {
    return ps_parse_number(request->values[EPS], "sampler bnot: eps", PS_BNOT_LEAST_EPS,
                           PS_BNOT_MOST_EPS, eps, error);
}

static pspec_status check(const ps_sampler_request *request, ps_error *error) {
    double eps = 0;
    PS_TRY(ps_sampler_limit_points(request, PS_CELLS_MOST_POINTS, error));
    return eps_of(request, &eps, error);
}

/* All cells are made 9 times at eps = 10, 27 at 1, 127 at 0.2 and 560 at 0.05, in 1 us each; the
 * gradients between two take a time that grows with sqrt(N) (bench_cells bnot). */
static double seconds(const ps_sampler_request *request) {
    const double num = (double)request->num_points;
    double eps = 1;
    return eps_of(request, &eps, NULL) == PSPEC_OK
               ? num * (3 + 25 / eps) * (1 + 0.004 * sqrt(num)) * 1e-6
               : 0;
}

static double work_bytes(const ps_sampler_request *request) {
    return ps_bnot_bytes(request->num_points);
}

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    ps_random random = ps_random_init(request->seed, PS_STREAM_COORDINATES, realization);
    double eps = 1;
    PS_TRY(eps_of(request, &eps, error));
    return ps_bnot_make(request->num_points, eps, &random, request->watch, points, error);
}

const ps_sampler ps_sampler_bnot = {
    .name = "bnot",
    .summary = "blue noise through optimal transport",
    .aliases = {"optimal-transport"},
    .minimum_dimension = 2,
    .maximum_dimension = 2,
    .minimum_points = PS_CELLS_LEAST_POINTS,
    .parameters = {{"eps", "1",
                    "0.02 to 10, how near to the centroids of cells; smaller is more regular"}},
    .version = 1,
    .seconds = seconds,
    .work_bytes = work_bytes,
    .is_deterministic = ps_sampler_never,
    .check = check,
    .generate = generate,
};
