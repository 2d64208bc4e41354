/* Values on rings, or on angles of the grid: [order][realization][even, odd l - m][..], as what
 * sums an order reads them. Between orders lie a few numbers more: with orders a multiple of 4096
 * bytes from each other, which those of all even lengths are, writing one order after the other
 * puts everything in one place of the caches (all of sphere_grid took 1.08 times as long at L = 64
 * and 128; Zen 5, PoCL 3.1). Device only.
 */
#ifndef PS_SPHERE_VALUES_H
#define PS_SPHERE_VALUES_H

#include "shared/real.h"

/* Lanes of the kernel that writes them. */
#ifndef VALUE_LANES
#define VALUE_LANES LANES
#endif

/* Numbers from order to order. */
static inline size_t order_pitch(const uint value_sets, const size_t parity_apart) {
    return value_sets * 2 * parity_apart + 2 * VALUE_LANES;
}

#endif
