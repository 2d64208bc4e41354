/* The row of capacity-constrained sets of the plane: docs/samplers/optimized.md#ccvt. */
#include "samplers/list.h"

#include "samplers/ccvt/ccvt_values.h"
#include "samplers/ccvt/torus_ccvt.h"
#include "samplers/values.h"

static double seconds(const ps_sampler_request *request) {
    const double each = 27;
    const double root = 1.65;
    return ps_ccvt_seconds(request, each, root);
}

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    ps_random random = ps_random_init(request->seed, PS_STREAM_COORDINATES, realization);
    size_t capacity = 0;
    PS_TRY(ps_ccvt_capacity(request, &capacity, error));
    return ps_torus_ccvt_make(request->num_points, capacity, &random, request->watch, points, NULL,
                              error);
}

const ps_sampler ps_sampler_ccvt = {
    .name = "ccvt",
    .summary = "blue noise through cells of equal capacity",
    .aliases = {"capacity"},
    .minimum_dimension = 2,
    .maximum_dimension = 2,
    .minimum_points = PS_TORUS_CCVT_LEAST_POINTS,
    .parameters = {PS_CCVT_PARAMETER("256")},
    .version = 1,
    .seconds = seconds,
    .is_deterministic = ps_sampler_never,
    .check = ps_ccvt_check_request,
    .generate = generate,
};
