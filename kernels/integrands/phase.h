/* Cosine and sine of 2 pi t, |t| <= 1/2: the sign is that of the nearest half turn. On the host,
 * which is the referee of the device, by libm. */
#ifndef PS_INTEGRANDS_PHASE_H
#define PS_INTEGRANDS_PHASE_H

#include "integrands/fold.h"

#ifdef __OPENCL_C_VERSION__
#include "shared/turn.h"
#endif

static inline realv phase_cosine(const realv t) {
#ifdef __OPENCL_C_VERSION__
    const realv half_turns = nearest_whole(2 * t);
    const realv rest = 2 * t - half_turns;
    return (1 - 2 * half_turns * half_turns) * TURN_COSINE(rest * rest);
#else
    return cos((real)6.283185307179586477 * t);
#endif
}

static inline realv phase_sine(const realv t) {
#ifdef __OPENCL_C_VERSION__
    const realv half_turns = nearest_whole(2 * t);
    const realv rest = 2 * t - half_turns;
    return (1 - 2 * half_turns * half_turns) * rest * TURN_SINE(rest * rest);
#else
    return sin((real)6.283185307179586477 * t);
#endif
}

#endif
