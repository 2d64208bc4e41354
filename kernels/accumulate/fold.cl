/* The pieces of every bin (accumulate/blocks.cl) in order, for LANES realizations side by side.
 * Launch: (bins, groups of LANES realizations), the first extent rounded up at will.
 *
 *   sums    [group][piece][high, low][LANES]
 *   bins    [bin]: first piece, one past the last
 *   result  [group][bin][high, low][LANES]
 */
#include "shared/lanes.h"
#include "shared/pair.h"

__kernel void accumulate_fold(__global const real *restrict sums,
                              __global const uint2 *restrict bins, __global real *restrict result,
                              const ulong num_bins, const ulong num_pieces) {
    const size_t bin = get_global_id(0);
    const size_t group = get_global_id(1);
    if (bin >= num_bins) {
        return;
    }
    realv high = 0, low = 0;
    for (uint piece = bins[bin].x; piece < bins[bin].y; piece++) {
        const size_t sum = 2 * (group * num_pieces + piece);
        pair_add(&high, &low, load_global(sums, sum));
        low += load_global(sums, sum + 1);
    }
    store_global(result, 2 * (group * num_bins + bin), high);
    store_global(result, 2 * (group * num_bins + bin) + 1, low);
}
