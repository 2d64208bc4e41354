/* LANES numbers as one access of memory. vload and vstore of PoCL 3.1 fall into halves, down to
 * pairs: half a vector cannot be forwarded from the store to the next load of the whole, which
 * waits for memory then (spreading took 1.4 times as long). Nothing of it in C11.
 */
#ifndef PS_SHARED_LANES_H
#define PS_SHARED_LANES_H

#include "shared/real.h"

#ifdef __OPENCL_C_VERSION__

/* Buffers are aligned as numbers, not always as vectors. */
typedef realv unaligned_realv __attribute__((aligned(sizeof(real))));

static inline realv load_local(__local const real *from, const size_t index) {
    return *(__local const unaligned_realv *)(from + index * LANES);
}

static inline realv load_global(__global const real *from, const size_t index) {
    return *(__global const unaligned_realv *)(from + index * LANES);
}

static inline void store_local(__local real *to, const size_t index, const realv x) {
    *(__local unaligned_realv *)(to + index * LANES) = x;
}

static inline void store_global(__global real *to, const size_t index, const realv x) {
    *(__global unaligned_realv *)(to + index * LANES) = x;
}

#endif

#endif
