/* The table of an integrand that is from a file. */
#ifndef PS_INTEGRANDS_TABLE_H
#define PS_INTEGRANDS_TABLE_H

#include "integrands/fold.h"

#ifdef __OPENCL_C_VERSION__
#define TABLE __global const real
#else
#define TABLE const real
#endif

/* Its numbers at places that are whole, each lane its own. */
static inline realv table_look_up(TABLE *table, const realv places) {
#ifdef __OPENCL_C_VERSION__
    real at[LANES];
    STOREV(places, 0, at);
    FOR_AXES(uint i = 0; i < LANES; i++) {
        at[i] = table[(size_t)at[i]];
    }
    return LOADV(0, at);
#else
    return table[(size_t)places];
#endif
}

#endif
