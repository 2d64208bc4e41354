/* Fibonacci lattices: rank 1 with N = F_m and z = (1, F_(m-1)), the best of the plane. */
#include "samplers/list.h"

#include "samplers/torus/lattice.h"
#include "samplers/values.h"

enum { DEFAULT_POINTS = 987 }; /* that next to 1024 */

/* The Fibonacci numbers on both sides of num, which is one where they are equal; *before is the one
 * before *below. */
static void find_neighbours(uint64_t num, uint64_t *before, uint64_t *below, uint64_t *above) {
    *before = 1;
    *below = 1;
    *above = 2;
    while (*above <= num) {
        *before = *below;
        *below = *above;
        *above = *before + *below;
    }
    *above = *below == num ? num : *above;
}

static pspec_status open_points(const ps_sampler_request *request, size_t *num_points,
                                ps_error *error) {
    (void)request;
    (void)error;
    *num_points = DEFAULT_POINTS;
    return PSPEC_OK;
}

static pspec_status check(const ps_sampler_request *request, ps_error *error) {
    uint64_t before, below, above;
    find_neighbours(request->num_points, &before, &below, &above);
    PS_TRY(ps_sampler_limit_points(request, PS_LATTICE_MOST_POINTS, error));
    return below == request->num_points
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "sampler fibonacci-lattice: %zu is no Fibonacci number; use %llu or %llu, "
                         "or rank1, whose generator is near the golden ratio for any N",
                         request->num_points, (unsigned long long)below, (unsigned long long)above);
}

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    uint64_t z[PS_MAX_DIMENSION] = {1};
    uint64_t below, above;
    (void)realization;
    find_neighbours(request->num_points, &z[1], &below, &above);
    return ps_lattice_generate(request, z, points, error);
}

const ps_sampler ps_sampler_fibonacci_lattice = {
    .name = "fibonacci-lattice",
    .summary = "lattice of the plane, N a Fibonacci number",
    .minimum_dimension = 2,
    .maximum_dimension = 2,
    .nanoseconds = 6,
    .is_deterministic = ps_sampler_always,
    .open_points = open_points,
    .check = check,
    .generate = generate,
};
