/* What makes the points of samplers whose points are known by their index alone, for host and
 * device: NAME_places of samplers/NAME.h writes the coordinates of point j of a realization as
 * multiples of 2^-64, the bits of ps_fixed_point of what the sampler makes on the host. For points
 * of the sphere NAME_point has them as doubles, on devices that have such.
 */
#ifndef PS_SAMPLERS_NUMBERS_H
#define PS_SAMPLERS_NUMBERS_H

#include "shared/fixed.h"
#include "shared/philox.h"

#define SAMPLER_AXES 6    /* PS_MAX_DIMENSION */
#define SAMPLER_PLANE 2   /* axes of the plane, from which the sphere's points are lifted */
#define SAMPLER_DIGITS 32 /* of a digital net: numbers of its table for each axis */
#define SAMPLER_DROP 11   /* 64 bits of a place - 53 of a double */

#ifdef __OPENCL_C_VERSION__
#define SAMPLER_TABLE __global const ps_u32 *
#define SAMPLER_INLINE static inline __attribute__((always_inline))
#define SAMPLER_FOR _Pragma("unroll") for /* else arrays would be in memory */
#else
#define SAMPLER_TABLE const ps_u32 *
#define SAMPLER_INLINE static inline
#define SAMPLER_FOR for
#endif

/* Of all realizations. */
typedef struct sampler_numbers {
    ps_u64 seed;
    ps_u64 num_points;           /* of a realization */
    ps_u64 start;                /* index of point 0 */
    ps_u64 counts[SAMPLER_AXES]; /* of strata; of heights, or nside */
    ps_u32 origin[SAMPLER_AXES]; /* point 0 of a net */
    ps_u32 scramble;             /* ps_net_scramble */
    ps_u32 unused;               /* fills the size up to whole numbers of eight bytes */
} sampler_numbers;

SAME_SIZE(sampler_numbers, 104);

/* Points begin, begin + step, .. modulo num_points, `count` of them, of realizations from
 * `realization` on. */
typedef struct sampler_range {
    ps_u64 realization, num_realizations;
    ps_u64 begin, step, count;
} sampler_range;

SAME_SIZE(sampler_range, 40);

/* Sets that the device made, all of one size (samplers/coordinates.cl). */
typedef struct sampler_sets {
    ps_u64 capacity; /* numbers of an axis */
    ps_u64 num_sets, num_points;
    ps_u64 padded; /* num_points, rounded up to whole vectors */
} sampler_sets;

SAME_SIZE(sampler_sets, 32);

#endif
