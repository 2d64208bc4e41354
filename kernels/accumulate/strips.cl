/* Sums over realizations for every frequency, as GPUs want them: blocks of realizations side by
 * side, in the order of accumulate/sums.h, so that bits are those of accumulate/blocks.cl.
 *
 * A strip is what a batch has of one block. accumulate_strips adds each up, the first one to the
 * open block; accumulate_merge then takes them in turn: whole ones are carried, one that stays open
 * becomes the open block.
 *
 *   numbers  of accumulate/blocks.h
 *   power    [realization][stride]
 *   sum, sum_low, square, square_low
 *            [row][stride]: the state (accumulate/state.h), and from first_strip on a row a strip;
 *            the last two are not touched without SQUARES
 */
#include "accumulate/state.h"

/* Launch: (vectors of a row, rounded up at will; strips). */
__kernel void accumulate_strips(const blocks_numbers numbers, __global const real *restrict power,
                                __global real *sum, __global real *sum_low, __global real *square,
                                __global real *square_low, const uint first_strip) {
    const size_t slot = get_global_id(0) * LANES, strip = get_global_id(1);
    const ulong block = numbers.done / SUM_BLOCK + strip;
    const ulong begin = max(block * SUM_BLOCK, numbers.done);
    const ulong end = min((block + 1) * SUM_BLOCK, numbers.done + numbers.num_realizations);
    const state sums = {sum, sum_low, square, square_low, numbers.done};
    block_sums open;
    if (slot >= numbers.stride) {
        return;
    }
    if (begin % SUM_BLOCK > 0) {
        open = load_sums(sums, slot);
    } else {
        open.sum = open.sum_low = open.square = open.square_low = 0;
    }
    for (ulong r = begin - numbers.done; r < end - numbers.done; r++) {
        add_to_block(&open, load_global(power + r * numbers.stride + slot, 0));
    }
    store_sums(sums, (first_strip + strip) * numbers.stride + slot, open);
}

/* Launch: (vectors of a row, rounded up at will). */
__kernel void accumulate_merge(const blocks_numbers numbers, __global real *sum,
                               __global real *sum_low, __global real *square,
                               __global real *square_low, const uint first_strip) {
    const size_t slot = get_global_id(0) * LANES;
    const ulong end = numbers.done + numbers.num_realizations;
    const state sums = {sum, sum_low, square, square_low, numbers.done};
    if (slot >= numbers.stride) {
        return;
    }
    for (ulong block = numbers.done / SUM_BLOCK; block * SUM_BLOCK < end; block++) {
        const size_t row = first_strip + (block - numbers.done / SUM_BLOCK);
        const block_sums strip = load_sums(sums, row * numbers.stride + slot);
        if ((block + 1) * SUM_BLOCK <= end) {
            carry(sums, slot, numbers.stride, block, strip);
        } else {
            store_sums(sums, slot, strip);
        }
    }
}
