/* From points on the device to values on the angles of the grid
 * (kernels/sphere/nufft/grid_values.cl), and from these to powers or coefficients
 * (kernels/sphere/nufft/grid_sums.cl).
 */
#ifndef PS_ENGINES_SPHERE_NUFFT_GRID_STAGES_H
#define PS_ENGINES_SPHERE_NUFFT_GRID_STAGES_H

#include "engines/sphere/nufft/grid_table.h"
#include "engines/sphere/nufft/places.h"
#include "engines/sphere/nufft/sphere_powers.h"
#include "engines/sphere/nufft/tables.h"

typedef struct ps_sphere_grid_stages {
    ps_device *device;
    ps_precision precision;
    bool only_even;
    const ps_sphere_shape *shape;
    const ps_sphere_places *points;
    const ps_sphere_tables *tables;
    ps_sphere_grid_table table;
    ps_kernel *make, *sum;
    ps_buffer grids, scratch, values;
    ps_sphere_powers powers;
} ps_sphere_grid_stages;

/* shape, points and tables are borrowed. */
pspec_status ps_sphere_grid_stages_create(ps_sphere_grid_stages *out, const ps_sphere_shape *shape,
                                          const ps_sphere_places *points,
                                          const ps_sphere_tables *tables, bool only_even,
                                          ps_precision precision, ps_device *device,
                                          ps_error *error) PS_MUST_CHECK;
void ps_sphere_grid_stages_free(ps_sphere_grid_stages *stages);

/* These do what those of stages.h do for rings. */
pspec_status ps_sphere_grid_make_values(ps_sphere_grid_stages *stages, size_t first_value,
                                        size_t num, ps_error *error) PS_MUST_CHECK;
pspec_status ps_sphere_grid_sum(ps_sphere_grid_stages *stages, size_t num,
                                ps_error *error) PS_MUST_CHECK;
pspec_status ps_sphere_grid_keep(ps_sphere_grid_stages *stages, double *coefficients,
                                 ps_error *error) PS_MUST_CHECK;

#endif
