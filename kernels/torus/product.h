/* What torus/product.cl and product_shared.cl agree on with the host. */
#ifndef PS_TORUS_PRODUCT_H
#define PS_TORUS_PRODUCT_H

#include "shared/fixed.h"

/* Left and right tiles of a block of torus/product_shared.cl: with 4 lanes 32 frequencies of either
 * side, for which the tables are read once. NO_PAIR: nobody needs these two tiles. */
#define BLOCK_TILES 8
#define NO_PAIR 0xffffffffu

/* Left frequencies of a work-item there: 8 vectors of sums, and twice as many of what pairs have so
 * far, are 96 registers in single precision. */
#define PRODUCT_STRIP 2

typedef struct product_numbers {
    ps_u64 num_pairs, num_tiles, num_left_tiles;
    ps_u64 table_points; /* of a tile of the table */
    ps_u64 first_row;    /* of powers and scales */
    ps_u64 stride;       /* of rows of powers */
    ps_u32 is_first, is_last;
} product_numbers;

SAME_SIZE(product_numbers, 56);

#endif
