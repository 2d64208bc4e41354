/* The numbers among the arguments of kernels of this folder, for host and device; orders.h has
 * those of orders.cl. */
#ifndef PS_SPHERE_NUFFT_NUMBERS_H
#define PS_SPHERE_NUFFT_NUMBERS_H

#include "nufft/numbers.h"

/* Rings on which Lambda_lm is made. */
typedef struct ring_numbers {
    ps_u32 polar, crossing, equatorial; /* ring_angles of orders_states.h */
    ps_u32 L, only_even;                /* even degrees only */
    ps_u32 num_rings, ring_pitch;
    ps_u32 lead;  /* of num_rings, so many come before the pole, where nothing is */
    ps_u32 block; /* rings of a block, a multiple of RING_UNIT */
} ring_numbers;

/* orders_sum.cl */
typedef struct orders_sum_numbers {
    ring_numbers rings;
    ps_u32 value_sets; /* of values there is room for so many realizations */
    ps_u32 num_realizations;
    ps_u32 half_pitch; /* of powers */
} orders_sum_numbers;

SAME_SIZE(orders_sum_numbers, 48);

/* ring_lines.cl */
typedef struct ring_lines_numbers {
    ps_u64 order_apart; /* numbers from order to order in values */
    ps_u32 L, only_even;
    ps_u32 num_lines; /* of a set */
    ps_u32 num_rings, ring_pitch;
    ps_u32 first_value; /* where values of the first set go */
} ring_lines_numbers;

SAME_SIZE(ring_lines_numbers, 32);

/* degrees.cl */
typedef struct degrees_numbers {
    ps_u64 order_apart; /* numbers from order to order in values */
    ps_u32 L, only_even;
    ps_u32 num_rings, ring_pitch;
    ps_u32 block; /* rings at a time, at most RINGS */
    ps_u32 groups;
    ps_u32 num_sets; /* realizations */
    ps_u32 unused;   /* fills the size up to whole numbers of eight bytes */
} degrees_numbers;

SAME_SIZE(degrees_numbers, 40);

/* sphere/grid/table.cl */
typedef struct grid_table_numbers {
    ring_numbers rings;
    ps_u32 num_angles, angle_pitch; /* of the table, and of filters */
} grid_table_numbers;

SAME_SIZE(grid_table_numbers, 44);

/* sphere/grid/values.cl */
typedef struct grid_values_numbers {
    window_numbers window; /* the same on both axes; n is even */
    ps_u32 num_realizations;
    ps_u32 L, only_even;            /* even degrees only: the values of others are left alone */
    ps_u32 pitch, pole;             /* of a grid; the north pole is this cell of a row */
    ps_u32 num_angles;              /* (n / 2 + 1) / 2 */
    ps_u32 most_runs;               /* of an order and parity in begins */
    ps_u32 first_value, value_sets; /* where values of realizations go, of so many */
} grid_values_numbers;

SAME_SIZE(grid_values_numbers, 52);

/* orders_sort.cl */
typedef struct orders_sort_numbers {
    ps_u64 first_point; /* vectors before it are left alone */
    ps_u64 num_points;
    ps_u64 part_points; /* of each part but the last, a multiple of LANES */
    ps_u64 shift;       /* of angles from the pole (turns.h) */
    ps_u32 n, width;    /* of the fine grid (nufft/cells.h) */
    ps_u32 bands, tiles;
    ps_u32 has_weights; /* else heights are left alone */
    ps_u32 unused;      /* fills the size up to whole numbers of eight bytes */
} orders_sort_numbers;

SAME_SIZE(orders_sort_numbers, 56);

/* orders_bands.cl */
enum { STAGED_POINTS = 256 }; /* a multiple of CHUNK (nufft/place.h) */

typedef struct orders_bands_numbers {
    ps_u64 part_points;    /* as in orders_sort.cl */
    window_numbers window; /* the same on both axes */
    ps_u32 num_parts, tiles;
    ps_u32 is_first; /* the grid begins anew; else it is continued */
    ps_u32 bands, band_rows, pitch;
    ps_u32 has_weights; /* else heights are not looked at, and all are 1 */
    ps_u32 unused;      /* fills the size up to whole numbers of eight bytes */
} orders_bands_numbers;

SAME_SIZE(orders_bands_numbers, 56);

#endif
