/* The rows of capacity-constrained sets of the plane and of the sphere:
 * docs/samplers/optimized.md#ccvt. */
#include "samplers/list.h"

#include "base/text.h"
#include "samplers/ccvt/sphere_ccvt.h"
#include "samplers/ccvt/torus_ccvt.h"
#include "samplers/values.h"

#include <math.h>
#include <stdio.h>

enum { CAPACITY };

#define CAPACITY_PARAMETER(preset)                                                                 \
    { "M", preset, "4 to 16384, background points of every site; more are more regular" }

/* The value; with the number of points, the limits of all background points. */
static pspec_status read_capacity(const ps_sampler_request *request, size_t *capacity,
                                  ps_error *error) {
    enum { WORDS = 64 };
    char what[WORDS];
    uint64_t value = 0;
    (void)snprintf(what, sizeof what, "sampler %s: M", request->sampler->name);
    PS_TRY(ps_parse_count(request->values[CAPACITY], what, PS_CCVT_LEAST_CAPACITY,
                          PS_CCVT_MOST_CAPACITY, &value, error));
    *capacity = (size_t)value;
    return ps_ccvt_check(request->num_points, value, error);
}

static pspec_status check(const ps_sampler_request *request, ps_error *error) {
    size_t capacity = 0;
    return read_capacity(request, &capacity, error);
}

/* N (each + root sqrt(N)) microseconds with M = 64, which grow with M as M (1 + (M/450)^1.15):
 * passes become more. M = 1024 takes 50 times as long as 64, and 4096 and 8192 take 15 and 64 times
 * as long as 1024 (bench_cells ccvt, two cores of an Intel Xeon with AVX-512). That points take
 * longer where there are more is of sites drawn at random, whose numbers differ the more from those
 * of equal capacities, the larger the part of the room. 0 of a request that is refused. */
static double count_seconds(const ps_sampler_request *request, double each, double root) {
    const double microsecond = 1e-6;
    const double few = 64;
    const double many = 450;
    const double power = 1.15;
    const double num = (double)request->num_points;
    size_t capacity = 0;
    if (read_capacity(request, &capacity, NULL) != PSPEC_OK) {
        return 0;
    }
    const double m = (double)capacity;
    const double growth = m / few * (1 + pow(m / many, power)) / (1 + pow(few / many, power));
    return num * (each + root * sqrt(num)) * growth * microsecond;
}

static double torus_seconds(const ps_sampler_request *request) {
    const double each = 27;
    const double root = 1.65;
    return count_seconds(request, each, root);
}

static double sphere_seconds(const ps_sampler_request *request) {
    const double each = 42;
    const double root = 4.3;
    return count_seconds(request, each, root);
}

static const ps_ccvt_space *space_of(const ps_sampler_request *request) {
    return ps_sampler_is_on_sphere(request) ? &ps_sphere_ccvt_space : &ps_torus_ccvt_space;
}

static double work_bytes(const ps_sampler_request *request) {
    size_t capacity = 0;
    return read_capacity(request, &capacity, NULL) == PSPEC_OK
               ? ps_ccvt_bytes(space_of(request), request->num_points, capacity)
               : 0;
}

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    ps_random random = ps_random_init(request->seed, PS_STREAM_COORDINATES, realization);
    size_t capacity = 0;
    PS_TRY(read_capacity(request, &capacity, error));
    return ps_ccvt_make(space_of(request), request->num_points, capacity, &random, request->watch,
                        points, NULL, error);
}

const ps_sampler ps_sampler_ccvt = {
    .name = "ccvt",
    .summary = "blue noise through cells of equal capacity",
    .aliases = {"capacity"},
    .minimum_dimension = 2,
    .maximum_dimension = 2,
    .minimum_points = PS_TORUS_CCVT_LEAST_POINTS,
    .parameters = {CAPACITY_PARAMETER("256")},
    .version = 1,
    .seconds = torus_seconds,
    .work_bytes = work_bytes,
    .is_deterministic = ps_sampler_never,
    .check = check,
    .generate = generate,
};

const ps_sampler ps_sampler_ccvt_sphere = {
    .name = "ccvt-sphere",
    .summary = "blue noise through cells of equal capacity",
    .aliases = {"capacity-sphere"},
    .domain = PS_SAMPLES_SPHERE,
    .minimum_points = PS_SPHERE_CCVT_LEAST_POINTS,
    .parameters = {CAPACITY_PARAMETER("64")},
    .version = 2,
    .seconds = sphere_seconds,
    .work_bytes = work_bytes,
    .is_deterministic = ps_sampler_never,
    .check = check,
    .generate = generate,
};
