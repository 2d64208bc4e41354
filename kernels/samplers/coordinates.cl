/* Points that the device made itself (points.cl, sphere_points.cl), as integrands/values.cl reads
 * them. Launch: one work-item for each point of sets that are filled up to whole vectors, rounded
 * up at will.
 *
 *   sizes   of samplers/numbers.h; its names are used here
 *   made    [set][num_points][DIMENSION]: multiples of 2^-64, with ON_SPHERE=1 doubles
 *   points  [DIMENSION][capacity], 0 behind the points of a set
 */
#include "samplers/numbers.h"
#include "shared/real.h"

#ifndef DIMENSION
#define DIMENSION 2
#endif
#ifndef ON_SPHERE
#define ON_SPHERE 0
#endif

#if ON_SPHERE /* such a device has doubles */
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#define COORDINATE(bits) ((real)as_double(bits))
#else
#define COORDINATE(bits) ((real)(bits) * (real)0x1p-64f)
#endif

__kernel void sampler_coordinates(const sampler_sets sizes, __global const ulong *restrict made,
                                  __global real *restrict points) {
    const ulong at = get_global_id(0);
    if (at >= sizes.num_sets * sizes.padded) {
        return;
    }
    const ulong set = at / sizes.padded;
    const ulong j = at - set * sizes.padded;
    for (uint i = 0; i < DIMENSION; i++) {
        points[i * sizes.capacity + at] =
            j < sizes.num_points ? COORDINATE(made[(set * sizes.num_points + j) * DIMENSION + i])
                                 : 0;
    }
}
