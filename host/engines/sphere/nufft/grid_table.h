/* The table of sphere_grid on the device: what a cell of the grid counts in c_lm, for all degrees
 * and orders. */
#ifndef PS_ENGINES_SPHERE_NUFFT_GRID_TABLE_H
#define PS_ENGINES_SPHERE_NUFFT_GRID_TABLE_H

#include "engines/sphere/nufft/shape.h"

/* Names of kernels/sphere/nufft/grid_table.h and grid_begins.cl. */
typedef struct ps_sphere_grid_table {
    ps_buffer numbers; /* [shape->table_reals], in the precision of sums */
    ps_buffer offsets, begins;
} ps_sphere_grid_table;

/* With only_even the parts of odd degrees stay empty. The device must have double precision, in
 * which the table is made. */
pspec_status ps_sphere_grid_table_create(ps_sphere_grid_table *out, const ps_sphere_shape *shape,
                                         bool only_even, ps_precision precision, ps_device *device,
                                         ps_error *error) PS_MUST_CHECK;
void ps_sphere_grid_table_free(ps_sphere_grid_table *table);

/* Additions and multiplications of making it. */
double ps_sphere_grid_table_flops(const ps_sphere_shape *shape);

#endif
