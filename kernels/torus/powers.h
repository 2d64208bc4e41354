/* From the sums of products to powers. Device only. */
#ifndef PS_TORUS_POWERS_H
#define PS_TORUS_POWERS_H

#include "shared/lanes.h"

#ifdef __OPENCL_C_VERSION__

/* Powers of l + r and l - r for one left frequency, from its finished sums: cc, sc, cs, ss, and
 * their low parts. */
static inline void store_powers(const realv sum[4], const realv low[4], const realv scale,
                                __global real *out) {
    const realv plus_re = (sum[0] - sum[3]) + (low[0] - low[3]);
    const realv plus_im = (sum[1] + sum[2]) + (low[1] + low[2]);
    const realv minus_re = (sum[0] + sum[3]) + (low[0] + low[3]);
    const realv minus_im = (sum[1] - sum[2]) + (low[1] - low[2]);
    store_global(out, 0, fma(plus_re, plus_re, plus_im * plus_im) * scale);
    store_global(out, 1, fma(minus_re, minus_re, minus_im * minus_im) * scale);
}

#endif

#endif
