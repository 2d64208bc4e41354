/* Weighted sums of powers, one for every realization: sum over slots of weight * power, in pieces
 * of BLOCK slots, which the host adds up in their order. Launch: (blocks, groups of LANES
 * realizations), the first extent rounded up at will.
 *
 * Realizations are lanes, as in accumulate/blocks.cl, and a work-item takes slot after slot of its
 * block: results do not depend on LANES, work-group sizes, or the batch. A slot of weight 0 is left
 * out, whatever is there: it may be padding.
 *
 *   numbers   of accumulate/blocks.h; a piece is a block
 *   power     [realization][stride]
 *   weights   [stride] of one weighted sum
 *   sums      [weighted sum][group of LANES realizations][block][high, low][LANES]
 *   index     of the weighted sum
 */
#include "accumulate/blocks.h"
#include "accumulate/rows.h"
#include "shared/lanes.h"
#include "shared/pair.h"
#include "shared/transpose.h"

/* LANES slots of as many realizations. */
static inline void add_slots(realv *high, realv *low, realv *powers,
                             __global const real *restrict weights) {
    transpose(powers);
#pragma unroll
    for (uint i = 0; i < LANES; i++) {
        const real weight = weights[i];
        const realv power = weight != 0 ? powers[i] : (realv)0;
        pair_add_product(high, low, power, (realv)weight);
    }
}

__kernel void accumulate_weighted(const blocks_numbers numbers, __global const real *restrict power,
                                  __global const real *restrict weights,
                                  __global real *restrict sums, const ulong index) {
    const ulong stride = numbers.stride;
    const size_t block = get_global_id(0), group = get_global_id(1);
    if (block >= numbers.num_pieces) {
        return;
    }
    const uint first = (uint)group * LANES;
    const uint count = min((uint)LANES, numbers.num_realizations - first);
    const size_t end = min((size_t)stride, (block + 1) * BLOCK);
    __global const real *rows = power + first * stride;
    realv high = 0, low = 0;
    for (size_t slot = block * BLOCK; slot < end; slot += LANES) {
        realv powers[LANES];
        load_rows(powers, rows + slot, stride, count);
        add_slots(&high, &low, powers, weights + slot);
    }
    const size_t piece = (index * get_global_size(1) + group) * (size_t)numbers.num_pieces + block;
    store_global(sums, 2 * piece, high);
    store_global(sums, 2 * piece + 1, low);
}
