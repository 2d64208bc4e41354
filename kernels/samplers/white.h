/* Points of white noise. */
#ifndef PS_SAMPLERS_WHITE_H
#define PS_SAMPLERS_WHITE_H

#include "samplers/numbers.h"

SAMPLER_INLINE void white_places(const sampler_numbers *of, SAMPLER_TABLE table,
                                 const ps_u32 dimension, const ps_u64 realization, const ps_u64 j,
                                 ps_u64 *places) {
    const philox_stream stream = {of->seed, realization, PHILOX_COORDINATES};
    ps_u32 words[PHILOX_WORDS];
    (void)table;
    SAMPLER_FOR(ps_u32 i = 0; i < dimension; i++) {
        places[i] = philox_next(stream, j * dimension + i, i == 0, words) << SAMPLER_DROP;
    }
}

/* The same in the plane, as doubles. */
SAMPLER_INLINE void white_coordinates(const sampler_numbers *of, const ps_u64 realization,
                                      const ps_u64 j, double *x) {
    const philox_stream stream = {of->seed, realization, PHILOX_COORDINATES};
    ps_u32 words[PHILOX_WORDS];
    SAMPLER_FOR(ps_u32 i = 0; i < SAMPLER_PLANE; i++) {
        x[i] = (double)philox_next(stream, j * SAMPLER_PLANE + i, i == 0, words) * 0x1p-53;
    }
}

#endif
