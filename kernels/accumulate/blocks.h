/* What host and device both know: blocks of realizations, and the numbers among the arguments of
 * blocks.cl, strips.cl and weighted.cl. */
#ifndef PS_ACCUMULATE_BLOCKS_NUMBERS_H
#define PS_ACCUMULATE_BLOCKS_NUMBERS_H

#include "shared/fixed.h"

/* Realizations of a block (accumulate/sums.h): few enough that one after the other is little to do
 * at its end, and that blocks keep a GPU busy; a power of two, so that means over blocks are
 * exact. */
#define SUM_BLOCK 128

/* Levels of whole blocks that so many realizations need. */
static inline ps_u32 sum_levels(ps_u64 count) {
    ps_u32 levels = 0;
    for (ps_u64 blocks = count / SUM_BLOCK; blocks > 0; blocks /= 2) {
        levels++;
    }
    return levels;
}

/* Blocks that `count` realizations, one at least, are part of at most. */
static inline ps_u32 most_strips(ps_u64 count) {
    return (ps_u32)((count - 1) / SUM_BLOCK + 2);
}

typedef struct blocks_numbers {
    ps_u64 stride; /* of rows of powers, a multiple of LANES */
    ps_u64 num_pieces;
    ps_u64 done; /* realizations of the job before these; not of weighted.cl */
    ps_u32 num_realizations;
    ps_u32 at_once; /* of a work-group, a multiple of LANES; not of weighted.cl */
} blocks_numbers;

SAME_SIZE(blocks_numbers, 32);

#endif
