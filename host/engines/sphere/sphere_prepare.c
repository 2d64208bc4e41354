/* Directions on the host, for devices without double precision: the arithmetic of
 * kernels/sphere/prepare.cl. */
#define PRECISION 64
#include "sphere/direction.h"
#include "sphere/layout.h"

#include "engines/sphere/sphere_points.h"
#include "engines/sphere/sphere_layout.h"

/* The only file of the host that sees the names of the kernels. */
_Static_assert(PS_SPHERE_ARRAYS == NUM_ARRAYS && (int)PS_SPHERE_DEGREES == DEGREES &&
                   (int)PS_SPHERE_BLOCK_REALS == BLOCK_REALS,
               "sizes differ from those of kernels/sphere/layout.h");

static void put(void *values, ps_precision precision, size_t at, double x) {
    if (precision == PS_SINGLE) {
        ((float *)values)[at] = (float)x;
    } else {
        ((double *)values)[at] = x;
    }
}

void ps_sphere_prepare(const double *points, size_t num, bool only_even, ps_precision precision,
                       size_t capacity, void *values, uint64_t *turns) {
    for (size_t j = 0; j < num; j++) {
        const double *u = points + j * PS_SPHERE_DIMENSION;
        const double turned = u[2] < 0 ? -1 : 1;
        const double flip = only_even ? turned : 1;
        const direction to = direction_of(u[0] * flip, u[1] * flip, u[2],
                                          DIRECTION_SMALLEST(precision == PS_SINGLE ? 32 : 64));
        const double rho = precision == PS_SINGLE ? (double)(float)to.rho : to.rho;
        put(values, precision, ARRAY_T * capacity + j, to.t);
        put(values, precision, ARRAY_SIDE * capacity + j, only_even ? 1 : turned);
        put(values, precision, ARRAY_RHO * capacity + j, to.rho);
        put(values, precision, ARRAY_RHO_REST * capacity + j, to.rho - rho);
        put(values, precision, ARRAY_COSINE * capacity + j, to.cosine);
        put(values, precision, ARRAY_SINE * capacity + j, to.sine);
        turns[j] = to.turn;
    }
}
