/* The numbers among the arguments of orders.cl, for host and device. */
#ifndef PS_SPHERE_ORDERS_H
#define PS_SPHERE_ORDERS_H

#include "nufft/numbers.h"

typedef struct orders_numbers {
    ps_u64 most_points;    /* of a set whose strips are sorted */
    window_numbers window; /* the same on both axes; n is even */
    ps_u32 first_realization, end_realization;
    ps_u32 steps; /* bits: 1 spread, 2 around the axis, 4 rings */
    ps_u32 shares;
    ps_u32 L, only_even;     /* even degrees only: the values of others are left alone */
    ps_u32 pitch, grid_rows; /* of a grid, which has */
    ps_u32 bands, pole;      /* bands of sphere/bands.h; the north pole is this cell of a row */
    ps_u32 columns, strip;   /* columns of a strip (orders_strips.h), a multiple of LANES */
    ps_u32 rings, num_rings, ring_pitch; /* num_rings is rings / 4 + 1 */
    ps_u32 first_value, value_sets;      /* where values of realizations go, of so many */
    ps_u32 unused;                       /* fills the size up to whole numbers of eight bytes */
} orders_numbers;

SAME_SIZE(orders_numbers, 96);

#endif
