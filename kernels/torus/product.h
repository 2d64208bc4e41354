/* The numbers among the arguments of torus/product.cl, for host and device. */
#ifndef PS_TORUS_PRODUCT_H
#define PS_TORUS_PRODUCT_H

#include "shared/fixed.h"

typedef struct product_numbers {
    ps_u64 num_pairs, num_tiles, num_left_tiles;
    ps_u64 table_points; /* of a tile of the table */
    ps_u64 first_row;    /* of powers and scales */
    ps_u64 stride;       /* of rows of powers */
    ps_u32 is_first, is_last;
} product_numbers;

SAME_SIZE(product_numbers, 56);

#endif
