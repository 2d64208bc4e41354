#include "samplers/sphere/spherical_fibonacci.h"

#include "math/lift.h"
#include "samplers/fibonacci.h"
#include "samplers/pace.h"

void ps_fibonacci_point(size_t j, uint64_t num_heights, double *point) {
    fibonacci_point_of(j, num_heights, point);
}

void ps_fibonacci_points(size_t first, size_t end, uint64_t num_heights, double *points) {
    for (size_t j = first; j < end; j++) {
        ps_fibonacci_point(j, num_heights, points + PS_VECTOR_DIMENSION * j);
    }
}

static void make_piece(const void *payload, size_t first, size_t end, double *points) {
    ps_fibonacci_points(first, end, *(const uint64_t *)payload, points);
}

pspec_status ps_fibonacci_generate(const ps_sampler_request *request, uint64_t num_heights,
                                   double *points, ps_error *error) {
    return ps_sampler_pieces(request, PS_PACE_POINTS_MADE, make_piece, &num_heights, points, error);
}
