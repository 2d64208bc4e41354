/* What torus/product.cl and product_shared.cl agree on with the host. */
#ifndef PS_TORUS_PRODUCT_H
#define PS_TORUS_PRODUCT_H

#include "shared/fixed.h"

/* Left and right tiles of a block of torus/product_shared.cl: with 4 lanes 32 frequencies of either
 * side, whose cosines and sines are made once, and with runs of 32 points 16 KiB of local memory in
 * single precision. NO_PAIR: nobody needs these two tiles. */
#define BLOCK_TILES 8
#define NO_PAIR 0xffffffffu

/* Left frequencies of a work-item there: with what pairs have so far, their sums are 192 registers
 * of 32 bits, of 255 that an item of NVIDIA's has. */
#define PRODUCT_STRIP(precision) ((precision) == 32 ? 4 : 2)

typedef struct product_numbers {
    ps_u64 num_pairs, num_tiles, num_left_tiles;
    ps_u64 table_points; /* of a tile of the table, where there is one */
    ps_u64 first_row;    /* of powers and scales */
    ps_u64 stride;       /* of rows of powers */
    ps_u32 is_first, is_last;
    ps_u32 keeps_sums; /* also when is_last is set */
    ps_u32 unused;
} product_numbers;

SAME_SIZE(product_numbers, 64);

#endif
