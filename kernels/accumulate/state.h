/* Sums over realizations in memory, LANES slots at a time: what is loaded, stored and carried of
 * accumulate/sums.h. Device only.
 */
#ifndef PS_ACCUMULATE_STATE_H
#define PS_ACCUMULATE_STATE_H

#include "accumulate/sums.h"
#include "shared/lanes.h"

#ifdef __OPENCL_C_VERSION__

/* 0: sums alone, nobody asks for standard errors of frequencies. */
#ifndef SQUARES
#define SQUARES 1
#endif

/* Rows [1 + level][stride]: the open block, and behind it whole ones. sum 0: nobody asks for
 * frequencies. */
typedef struct state {
    __global real *sum, *sum_low, *square, *square_low;
    ulong done; /* realizations before those that are added */
} state;

static inline block_sums load_sums(const state sums, const size_t at) {
    block_sums block;
    block.sum = load_global(sums.sum + at, 0);
    block.sum_low = load_global(sums.sum_low + at, 0);
#if SQUARES
    block.square = load_global(sums.square + at, 0);
    block.square_low = load_global(sums.square_low + at, 0);
#else
    block.square = block.square_low = 0;
#endif
    return block;
}

static inline void store_sums(const state sums, const size_t at, const block_sums block) {
    store_global(sums.sum + at, 0, block.sum);
    store_global(sums.sum_low + at, 0, block.sum_low);
#if SQUARES
    store_global(sums.square + at, 0, block.square);
    store_global(sums.square_low + at, 0, block.square_low);
#endif
}

/* The block is whole: number `blocks` of the job, counted from 0. */
static inline void carry(const state sums, const size_t slot, const ulong stride,
                         const ulong blocks, block_sums block) {
    uint level = 0;
    for (; blocks >> level & 1; level++) {
        const block_sums early = load_sums(sums, (1 + level) * stride + slot);
        merge_blocks(&block, &early);
    }
    store_sums(sums, (1 + level) * stride + slot, block);
}

#endif

#endif
