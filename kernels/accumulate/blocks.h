/* The numbers among the arguments of blocks.cl and weighted.cl, for host and device. */
#ifndef PS_ACCUMULATE_BLOCKS_NUMBERS_H
#define PS_ACCUMULATE_BLOCKS_NUMBERS_H

#include "shared/fixed.h"

typedef struct blocks_numbers {
    ps_u64 stride; /* of rows of powers, a multiple of LANES */
    ps_u64 num_pieces;
    ps_u32 num_realizations;
    ps_u32 unused; /* fills the size up to whole numbers of eight bytes */
} blocks_numbers;

SAME_SIZE(blocks_numbers, 24);

#endif
