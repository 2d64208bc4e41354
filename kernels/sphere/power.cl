/* sum_m |c_lm|^2 over the orders of sphere/sums.cl, in pairs, order after order.
 *
 * One work-item owns LANES degrees of one realization. Launch: (stride / LANES, realizations), the
 * first rounded up at will; no local memory.
 *
 *   sums    of sphere/sums.cl, LANES a part of its alignment
 *   powers  [realization][high, low][stride]: |c_l0|^2 / 2 + sum_{m > 0} |c_lm|^2; begun by the pass whose first_order
 *           is 0, continued by the others
 */
#include "shared/real.h"
#include "shared/lanes.h"
#include "shared/pair.h"

__kernel void sphere_power(__global const real *restrict sums, __global real *restrict powers,
                           const uint first_order, const uint num_orders, const uint max_degree,
                           const ulong stride, const uint has_low) {
    const size_t vector = get_global_id(0);
    const size_t realization = get_global_id(1);
    if (vector * LANES > max_degree) {
        return;
    }
    __global real *to = powers + realization * 2 * stride;
    realv high = (realv)0, low = (realv)0;
    if (first_order > 0) {
        high = load_global(to, vector);
        low = load_global(to + stride, vector);
    }
    const uint last = min(first_order + num_orders, (uint)(vector * LANES + LANES));
    for (uint m = first_order; m < last; m++) {
        __global const real *row =
            sums + (realization * num_orders + (m - first_order)) * 4 * stride;
        realv re = load_global(row, vector);
        realv im = load_global(row + stride, vector);
        if (has_low) {
            re += load_global(row + 2 * stride, vector);
            im += load_global(row + 3 * stride, vector);
        }
        pair_add_square(&high, &low, re);
        pair_add_square(&high, &low, im);
        if (m == 0) {
            high *= (realv)0.5f;
            low *= (realv)0.5f;
        }
    }
    store_global(to, vector, high);
    store_global(to + stride, vector, low);
}
