/* Points of realizations, made where engines read them: POINTS=white takes white_places of
 * samplers/white.h; a new sampler is an #include here. Those that need doubles are there with
 * DOUBLES=1 alone. Launch: one work-item for each point, rounded up at will.
 *
 *   numbers, range  of samplers/numbers.h
 *   table    of a net, else anything
 *   points   [realization][point][DIMENSION], in the order of the range
 */
#include "samplers/digital_net.h"
#include "samplers/white.h"

#ifndef DOUBLES
#define DOUBLES 0
#endif
#if DOUBLES
#include "samplers/radical_inverse.h"
#include "samplers/strata.h"
#endif

#ifndef POINTS
#define POINTS white
#endif
#ifndef DIMENSION
#define DIMENSION 2
#endif

#define POINTS_JOIN_(a, b) a##b
#define POINTS_JOIN(a, b) POINTS_JOIN_(a, b)
#define PLACES POINTS_JOIN(POINTS, _places)

__kernel void sampler_points(const sampler_numbers numbers, const sampler_range range,
                             __global const uint *restrict table, __global ulong *restrict points) {
    const ulong i = get_global_id(0);
    if (i >= range.count * range.num_realizations) {
        return;
    }
    const ulong realization = i / range.count;
    const ulong number = i - realization * range.count;
    const ulong j = (range.begin + number * range.step) % numbers.num_points;
    ulong places[DIMENSION];
    PLACES(&numbers, table, DIMENSION, range.realization + realization, j, places);
    SAMPLER_FOR(uint axis = 0; axis < DIMENSION; axis++) {
        points[i * DIMENSION + axis] = places[axis];
    }
}
