/* The row of farthest-point optimisation: docs/samplers/optimized.md#fpo. */
#include "samplers/list.h"

#include "base/text.h"
#include "samplers/optimized/cells.h"
#include "samplers/optimized/fpo.h"
#include "samplers/optimized/fpo_mesh.h"
#include "samplers/values.h"

#include <math.h>

enum { DISTANCE };

static pspec_status distance_of(const ps_sampler_request *request, double *distance,
                                ps_error *error) {
    return ps_parse_number(request->values[DISTANCE], "sampler fpo: distance",
                           PS_FPO_LEAST_DISTANCE, PS_FPO_MOST_DISTANCE, distance, error);
}

static pspec_status check(const ps_sampler_request *request, ps_error *error) {
    double distance = 0;
    PS_TRY(ps_sampler_limit_points(request, PS_CELLS_MOST_POINTS, error));
    return distance_of(request, &distance, error);
}

/* 1024 points take 2 passes to 0.8, 10 to 0.9, 34 to 0.92, 60 to 0.925 and 700 to 0.93, at 4 us a
 * point; passes and the time of a point grow together like sqrt(N), right to a factor of 2
 * (bench_cells fpo). */
static double seconds(const ps_sampler_request *request) {
    const double num = (double)request->num_points;
    const double root = sqrt(num / 1024);
    double distance = 0;
    return distance_of(request, &distance, NULL) == PSPEC_OK
               ? num * (1 + 0.34 / (0.931 - distance)) * 4e-6 * (root < 1 ? 1 : root)
               : 0;
}

static double work_bytes(const ps_sampler_request *request) {
    return ps_fpo_mesh_bytes(request->num_points);
}

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    ps_random random = ps_random_init(request->seed, PS_STREAM_COORDINATES, realization);
    double distance = 0;
    PS_TRY(distance_of(request, &distance, error));
    return ps_fpo_make(request->num_points, distance, &random, request->watch, points, error);
}

const ps_sampler ps_sampler_fpo = {
    .name = "fpo",
    .summary = "farthest-point optimisation",
    .aliases = {"farthest-point"},
    .minimum_dimension = 2,
    .maximum_dimension = 2,
    .minimum_points = PS_CELLS_LEAST_POINTS,
    .parameters = {{"distance", "0.925",
                    "0.5 to 0.93 of hexagonal packing's, least distance of two points"}},
    .version = 1,
    .seconds = seconds,
    .work_bytes = work_bytes,
    .is_deterministic = ps_sampler_never,
    .check = check,
    .generate = generate,
};
