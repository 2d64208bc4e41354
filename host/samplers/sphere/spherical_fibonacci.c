#include "samplers/sphere/spherical_fibonacci.h"

#include "math/lift.h"
#include "samplers/pace.h"

/* 2^128/Phi to the nearest whole number: j times its error stays below one unit of 2^-64 for any j
 * of 64 bits, where a constant of 64 bits is off by 2.5e-14 of a turn at j = 1e7 already. */
static const uint64_t INVERSE_PHI_HIGH = 0x9E3779B97F4A7C15;
static const uint64_t INVERSE_PHI_LOW = 0xF39CC0605CEDC834;

enum { HALF_BITS = 32 };

/* The upper 64 bits of the product, by halves: no 128-bit integers in C11. */
static uint64_t product_high(uint64_t a, uint64_t b) {
    const uint64_t a_low = (uint32_t)a;
    const uint64_t a_high = a >> HALF_BITS;
    const uint64_t b_low = (uint32_t)b;
    const uint64_t b_high = b >> HALF_BITS;
    const uint64_t cross = a_high * b_low + (a_low * b_low >> HALF_BITS);
    const uint64_t other = a_low * b_high + (uint32_t)cross;
    return a_high * b_high + (cross >> HALF_BITS) + (other >> HALF_BITS);
}

uint64_t ps_fibonacci_fraction(uint64_t j) {
    return j * INVERSE_PHI_HIGH + product_high(j, INVERSE_PHI_LOW); /* whole turns drop out */
}

static ps_height height_of(size_t j, uint64_t num_heights) {
    const double denominator = (double)num_heights;
    return ps_height_of_ratio(denominator - (2 * (double)j + 1), denominator);
}

void ps_fibonacci_point(size_t j, uint64_t num_heights, double *point) {
    ps_sphere_point(height_of(j, num_heights), ps_turns_of_fraction(ps_fibonacci_fraction(j)),
                    point);
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
