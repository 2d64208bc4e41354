/* Numbers that sphere_nufft and sphere_grid have on the device for all realizations. */
#ifndef PS_ENGINES_SPHERE_NUFFT_TABLES_H
#define PS_ENGINES_SPHERE_NUFFT_TABLES_H

#include "engines/nufft/grid_axis.h"
#include "engines/sphere/nufft/shape.h"
#include "sphere/nufft/numbers.h"

/* What Lambda_lm on rings begins with. Names of kernels/sphere/nufft/orders_sum.cl. */
typedef struct ps_sphere_starts {
    ps_buffer starts, start_scales, steps, step_scales, ratios;
    ps_buffer cosines, distances, squares;
} ps_sphere_starts;

/* What both need of the grid, and what sphere_nufft needs besides to come to rings. Names of
 * kernels/sphere/nufft/orders.cl. */
typedef struct ps_sphere_tables {
    ps_nufft_plan plan; /* of the grid: its window */
    ps_fft_plan halves; /* transforms of half its length */
    ps_buffer around_gains;
} ps_sphere_tables;

typedef struct ps_sphere_ring_tables {
    ps_fft_plan transforms; /* to rings, of half their number */
    ps_buffer turns, ring_turns;
    ps_buffer along_gains;
    ps_sphere_starts starts;
} ps_sphere_ring_tables;

pspec_status ps_sphere_starts_create(ps_sphere_starts *out, const ps_sphere_shape *shape,
                                     ps_device *device, ps_error *error) PS_MUST_CHECK;
void ps_sphere_starts_free(ps_sphere_starts *starts);
/* exp(-2 pi i j / n), j < num. */
pspec_status ps_sphere_turns_create(ps_buffer *out, uint32_t n, uint32_t num,
                                    ps_precision precision, ps_device *device,
                                    ps_error *error) PS_MUST_CHECK;
/* What kernels are told of the rings of a shape. */
ring_numbers ps_sphere_ring_numbers(const ps_sphere_shape *shape, bool only_even);

pspec_status ps_sphere_tables_create(ps_sphere_tables *out, const ps_sphere_shape *shape,
                                     double tolerance, ps_precision precision, ps_device *device,
                                     ps_error *error) PS_MUST_CHECK;
void ps_sphere_tables_free(ps_sphere_tables *tables);

pspec_status ps_sphere_ring_tables_create(ps_sphere_ring_tables *out, const ps_sphere_shape *shape,
                                          ps_precision precision, ps_device *device,
                                          ps_error *error) PS_MUST_CHECK;
void ps_sphere_ring_tables_free(ps_sphere_ring_tables *tables);

#endif
