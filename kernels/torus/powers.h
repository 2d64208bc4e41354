/* From the sums of products to powers. Device only. */
#ifndef PS_TORUS_POWERS_H
#define PS_TORUS_POWERS_H

#include "shared/lanes.h"

#ifdef __OPENCL_C_VERSION__

/* Powers of l + r and l - r for one left frequency, from its finished sums. */
static inline void store_powers(__global const real *sum, const realv scale, __global real *out) {
    const realv cc = load_global(sum, 0), cc_low = load_global(sum, 1);
    const realv sc = load_global(sum, 2), sc_low = load_global(sum, 3);
    const realv cs = load_global(sum, 4), cs_low = load_global(sum, 5);
    const realv ss = load_global(sum, 6), ss_low = load_global(sum, 7);
    const realv plus_re = (cc - ss) + (cc_low - ss_low), plus_im = (sc + cs) + (sc_low + cs_low);
    const realv minus_re = (cc + ss) + (cc_low + ss_low), minus_im = (sc - cs) + (sc_low - cs_low);
    store_global(out, 0, fma(plus_re, plus_re, plus_im * plus_im) * scale);
    store_global(out, 1, fma(minus_re, minus_re, minus_im * minus_im) * scale);
}

#endif

#endif
