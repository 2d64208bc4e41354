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

/* torus/product_units.cl. A warp has UNIT_ROWS times UNIT_COLUMNS unit tiles of 8 left and 4 right
 * frequencies: 64 registers of sums for an item, as many of second sums, and what is multiplied fit
 * into 255. Blocks have BLOCK_TILES or LARGE_TILES tiles of 4 a side; in double
 * precision large ones would not fit into 48 KiB. Factors of UNIT_CHUNK points are in local memory
 * at a time, UNIT_RUN of them are added before their sum goes into the second sum; it divides the
 * slabs of points. */
#define LARGE_TILES 16
#define UNIT_ROWS(precision) ((precision) == 32 ? 4 : 2)
#define UNIT_COLUMNS 4
#define UNIT_LANES 4
#define UNIT_CHUNK 32
#define UNIT_STEPS(precision) (UNIT_CHUNK / ((precision) == 32 ? 16 : 4))
#define UNIT_RUN 128
#define UNIT_GAP 64 /* bytes behind a step, so that two of them are in other banks */
#define UNIT_ITEMS(precision, tiles)                                                               \
    ((tiles) / 2 / UNIT_ROWS(precision) * ((tiles) / UNIT_COLUMNS) * 32)

typedef struct product_numbers {
    ps_u64 num_pairs, num_tiles, num_left_tiles;
    ps_u64 table_points; /* of a tile of the table, where there is one */
    ps_u64 first_row;    /* of powers and scales */
    ps_u64 stride;       /* of rows of powers */
    ps_u32 is_first, is_last;
    ps_u32 keeps_sums; /* also when is_last is set */
    ps_u32 unused;     /* fills the size up to whole numbers of eight bytes */
} product_numbers;

SAME_SIZE(product_numbers, 64);

#endif
