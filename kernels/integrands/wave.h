/* cos(2 pi (k.x + phase)), whole k. */
#ifndef PS_INTEGRANDS_WAVE_H
#define PS_INTEGRANDS_WAVE_H

#include "integrands/phase.h"

enum { WAVE_VECTOR = 0, WAVE_PHASE = 6 }; /* places among the numbers; the phase in turns */

static inline realv wave_value(const realv *x, const unsigned dimension, const real *numbers) {
    realv turns = numbers[WAVE_PHASE];
    FOR_AXES(unsigned i = 0; i < dimension; i++) {
        turns += x[i] * numbers[WAVE_VECTOR + i];
    }
    return phase_cosine(turns - nearest_whole(turns));
}

#endif
