/* Sums over realizations: the order in which they are added, for every device and for the host.
 *
 * Realizations are counted from the first of the job. SUM_BLOCK of them are a block, which is added
 * up one after the other, powers and their squares in pairs (shared/pair.h). Whole blocks are
 * merged two by two like the digits of a binary number: level k holds 2^k blocks where that bit of
 * the number of whole blocks is set. So a sum depends on the numbers alone.
 */
#ifndef PS_ACCUMULATE_SUMS_H
#define PS_ACCUMULATE_SUMS_H

#include "accumulate/blocks.h"
#include "shared/pair.h"

typedef struct block_sums {
    realv sum, sum_low, square, square_low;
} block_sums;

static inline void add_to_block(block_sums *block, realv x) {
    pair_add(&block->sum, &block->sum_low, x);
    pair_add_square(&block->square, &block->square_low, x);
}

/* *late, which follows early, becomes both. */
static inline void merge_blocks(block_sums *late, const block_sums *early) {
    pair_add(&late->sum, &late->sum_low, early->sum);
    late->sum_low += early->sum_low;
    pair_add(&late->square, &late->square_low, early->square);
    late->square_low += early->square_low;
}

#endif
