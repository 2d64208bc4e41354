/* cos(2 pi (k.x + phase)), whole k. */
#ifndef PS_INTEGRANDS_WAVE_H
#define PS_INTEGRANDS_WAVE_H

#include "integrands/fold.h"

#ifdef __OPENCL_C_VERSION__
#include "shared/turn.h"
#endif

enum { WAVE_VECTOR = 0, WAVE_PHASE = 6 }; /* places among the numbers; the phase in turns */

/* cos(2 pi t), |t| <= 1/2: the sign is that of the nearest half turn. On the host, which is the
 * referee of the device, by libm. */
static inline realv wave_cosine(const realv t) {
#ifdef __OPENCL_C_VERSION__
    const realv half_turns = nearest_whole(2 * t);
    const realv rest = 2 * t - half_turns;
    return (1 - 2 * half_turns * half_turns) * TURN_COSINE(rest * rest);
#else
    return cos((real)6.283185307179586477 * t);
#endif
}

static inline realv wave_value(const realv *x, const unsigned dimension, const real *numbers) {
    realv turns = numbers[WAVE_PHASE];
    FOR_AXES(unsigned i = 0; i < dimension; i++) {
        turns += x[i] * numbers[WAVE_VECTOR + i];
    }
    return wave_cosine(turns - nearest_whole(turns));
}

#endif
