/* Partial sums of the runs of pairs, added up in their order.
 *
 * One work-item owns LANES degrees of one realization. Launch: (vectors of degrees, realizations),
 * the first rounded up at will; no local memory.
 *
 *   partials  [realization][num_runs][high, low][num_degrees], without the low parts if `parts` is 1: degrees of
 *             pairs/sums.cl and nodes_sums.cl, moments of pairs/histogram.cl
 *   sums      [realization][high, low][num_degrees], begun anew with is_first
 */
#include "shared/real.h"
#include "shared/lanes.h"
#include "shared/pair.h"

__kernel void pairs_fold(__global const real *restrict partials, __global real *restrict sums,
                         const ulong num_runs, const uint num_degrees, const uint parts,
                         const uint is_first) {
    const size_t vector = get_global_id(0);
    const size_t realization = get_global_id(1);
    if (vector * LANES >= num_degrees) {
        return;
    }
    __global real *to = sums + realization * 2 * num_degrees;
    realv high = is_first ? (realv)0 : load_global(to, vector);
    realv low = is_first ? (realv)0 : load_global(to + num_degrees, vector);
    for (ulong run = 0; run < num_runs; run++) {
        __global const real *from = partials + (realization * num_runs + run) * parts * num_degrees;
        pair_add(&high, &low, load_global(from, vector));
        if (parts > 1) {
            low += load_global(from + num_degrees, vector);
        }
    }
    store_global(to, vector, high);
    store_global(to + num_degrees, vector, low);
}
