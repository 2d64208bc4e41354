/* Directions of points, in double precision, as sphere/sums.cl wants them: one array for each
 * quantity.
 *
 * One work-item owns LANES points. Launch: vectors, rounded up at will; no local memory.
 *
 *   points  [num_vectors * LANES][3]
 *   values  [NUM_ARRAYS][capacity] in the precision of the sums: t, side, rho, its rest, cos, sin
 *   turns   [capacity]
 *
 * side is -1 where z < 0 and 1 elsewhere. With ONLY_EVEN a point u with z < 0 becomes -u, which has
 * the same even degrees, and side is 1.
 */
#define PRECISION 64
#include "sphere/direction.h"
#include "sphere/layout.h"

#ifndef OUT_PRECISION
#define OUT_PRECISION 32
#endif

#if OUT_PRECISION == 64
#define OUT_REAL double
#else
#define OUT_REAL float
#endif
typedef OUT_REAL out_real;
#define TO_OUTV(x) PS_JOIN(convert_, PS_VECTOR(OUT_REAL))(x)

static inline void put(__global out_real *values, const ulong capacity, const int array,
                       const size_t vector, const realv x) {
    STOREV(TO_OUTV(x), vector, values + array * capacity);
}

__kernel void sphere_prepare(__global const double *restrict points,
                             __global out_real *restrict values, __global ulong *restrict turns,
                             const ulong num_vectors, const ulong capacity) {
    const size_t vector = get_global_id(0);
    if (vector >= num_vectors) {
        return;
    }
    real x[3][LANES];
    for (int lane = 0; lane < LANES; lane++) {
        for (int axis = 0; axis < 3; axis++) {
            x[axis][lane] = points[(vector * LANES + lane) * 3 + axis];
        }
    }
    const realv z = LOADV(0, x[2]);
    const realv turned = z < (realv)0 ? (realv)-1 : (realv)1;
    const realv side = ONLY_EVEN ? (realv)1 : turned;
    const realv flip = ONLY_EVEN ? turned : (realv)1;
    const direction to = direction_of(LOADV(0, x[0]) * flip, LOADV(0, x[1]) * flip, z,
                                      DIRECTION_SMALLEST(OUT_PRECISION));
    const realv rho = TO_REALV(TO_OUTV(to.rho));
    put(values, capacity, ARRAY_T, vector, to.t);
    put(values, capacity, ARRAY_SIDE, vector, side);
    put(values, capacity, ARRAY_RHO, vector, to.rho);
    put(values, capacity, ARRAY_RHO_REST, vector, to.rho - rho);
    put(values, capacity, ARRAY_COSINE, vector, to.cosine);
    put(values, capacity, ARRAY_SINE, vector, to.sine);
    STOREV(to.turn, vector, turns);
}
