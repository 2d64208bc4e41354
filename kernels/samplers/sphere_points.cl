/* Points of realizations on the sphere, made where engines read them: POINTS=white has white_point
 * of samplers/lifted.h, which lifts to the hemisphere with ON_HEMISPHERE=1; IS_DIFFUSE=1 morphs
 * these to the diffuse lobe. The bits are those of the host. Launch: one work-item for each point,
 * rounded up at will.
 *
 *   numbers, range  of samplers/numbers.h
 *   table    anything: no sampler of the sphere has one
 *   points   [realization][point][3], in the order of the range
 */
#pragma OPENCL EXTENSION cl_khr_fp64 : enable

#include "samplers/fibonacci.h"
#include "samplers/healpix.h"
#include "samplers/lifted.h"

#ifndef POINTS
#define POINTS white
#endif
#ifndef ON_HEMISPHERE
#define ON_HEMISPHERE 0
#endif
#ifndef IS_DIFFUSE
#define IS_DIFFUSE 0
#endif

#define POINTS_JOIN_(a, b) a##b
#define POINTS_JOIN(a, b) POINTS_JOIN_(a, b)
#define POINT POINTS_JOIN(POINTS, _point)

__kernel void sampler_sphere_points(const sampler_numbers numbers, const sampler_range range,
                                    __global const uint *restrict table,
                                    __global double *restrict points) {
    const ulong i = get_global_id(0);
    (void)table;
    if (i >= range.count * range.num_realizations) {
        return;
    }
    const ulong realization = i / range.count;
    const ulong number = i - realization * range.count;
    const ulong j = (range.begin + number * range.step) % numbers.num_points;
    double point[3];
    POINT(&numbers, ON_HEMISPHERE, range.realization + realization, j, point);
    if (IS_DIFFUSE) {
        ps_sphere_point_to_diffuse(point);
    }
    vstore3((double3)(point[0], point[1], point[2]), i, points);
}
