/* What is summed of an order and parity of l - m: rows of the table of sphere_grid. Device only. */
#ifndef PS_SPHERE_GRID_ROWS_H
#define PS_SPHERE_GRID_ROWS_H

#include "shared/group.h"
#include "shared/lanes.h"
#include "sphere/grid/table.h"
#include "sphere/nufft/orders_finish.h"

/* Vectors of degrees of a run: in registers, with real and imaginary parts of two realizations,
 * half of 32 of them, or 8 of 16; by tiles (tiles.h), so many that a run has TILE_DEGREES. */
#ifndef RUN_VECTORS
#define RUN_VECTORS 4
#endif

/* A run of the table from angle `begin` on, and where its sums go. */
typedef struct table_rows {
    __global const real *table;
    uint begin, num_angles;
    bool is_lowest; /* of the orders that are added up */
    double weight;  /* of |c|^2: orders m and -m */
} table_rows;

/* Numbers of some realizations: [realization][vector of angles][re, im][LANES]. */
typedef struct set_values {
    __global const real *values;
    size_t apart;
    uint num; /* realizations */
} set_values;

#endif
