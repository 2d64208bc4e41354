/* Numbers of windows and transforms, and the structs of them that launches take, for host and
 * device. */
#ifndef PS_NUFFT_NUMBERS_H
#define PS_NUFFT_NUMBERS_H

#include "shared/fixed.h"

/* A window: cells of its axis, its width, the degree and the bins of its polynomials
 * (nufft/window.h). */
typedef struct window_numbers {
    ps_u32 n, width, degree, bins;
} window_numbers;

/* The same, of points as they are: window_axis of nufft/window.h but for its buffer. */
typedef struct axis_numbers {
    ps_u64 factor;
    window_numbers window;
    ps_u32 axis, pitch;
} axis_numbers;

/* A transform: its length, the largest frequency of which is kept. */
typedef struct transform_numbers {
    ps_u32 n, K;
} transform_numbers;

/* ---- of kernels, by the names of their files ------------------------------------------------- */

/* An axis that keys are made of: its cells, or its boxes (nufft/boxes.h); keys 1: it does not
 * count. */
typedef struct sort_axis {
    ps_u32 n, width, axis, keys, per_cell;
} sort_axis;

typedef struct sort_numbers {
    ps_u64 num_realizations;
    ps_u64 factor; /* the coordinate of the first axis is factor * x[axis] mod 1 */
    sort_axis axes[3];
    ps_u32 num_keys;
    ps_u32 has_weights; /* or all are 1 */
} sort_numbers;

/* order.cl: sets of up to `tiles` tiles, and the digit of keys that they are ordered by. */
typedef struct order_numbers {
    ps_u32 tile, tiles;
    ps_u32 workers; /* of a tile, which take neighbours each; a multiple of 16 */
    ps_u32 shift, bits;
    ps_u32 is_first; /* sets are in the order in which they came */
    ps_u32 row;      /* of numbers of keys below 0, 1, .. */
} order_numbers;

/* Bits of a place in a tile, and parts that the tiles of a set are summed in. */
#define ORDER_PLACE_BITS 12
#define ORDER_SEGMENTS 32

typedef struct tile_numbers {
    ps_u64 stride; /* of rows of powers */
    axis_numbers along;
    ps_u32 first_row; /* of powers, scales and lines */
    ps_u32 base;      /* the first frequency of tile 0 */
    ps_u32 num_tiles, group, dimension, K;
} tile_numbers;

typedef struct rows_numbers {
    axis_numbers across, along; /* of rows */
    ps_u32 base, num_tiles, group, K;
    ps_u32 first_row; /* of lines */
} rows_numbers;

/* lines.cl, whose transform is that of the axis along its rows */
typedef struct line_numbers {
    ps_u64 stride; /* of rows of powers */
    ps_u64 first_power;
    transform_numbers transform;
    ps_u32 first_row; /* of powers and scales */
    ps_u32 num_realizations;
} line_numbers;

typedef struct first_numbers {
    ps_u64 columns, first_column, all_columns; /* that are there, in the grid, of the grid */
    transform_numbers transform;
    ps_u32 first_tile, num_tiles;
} first_numbers;

/* columns.cl and finish.cl */
typedef struct powers_numbers {
    ps_u64 stride; /* of rows of powers */
    ps_u64 first_power;
    transform_numbers transform;
    ps_u32 first_row; /* of powers and scales */
    ps_u32 column_K;  /* of columns alone: the largest frequency along rows */
} powers_numbers;

SAME_SIZE(sort_numbers, 88);
SAME_SIZE(order_numbers, 28);
SAME_SIZE(tile_numbers, 64);
SAME_SIZE(rows_numbers, 88);
SAME_SIZE(line_numbers, 32);
SAME_SIZE(first_numbers, 40);
SAME_SIZE(powers_numbers, 32);

#endif
