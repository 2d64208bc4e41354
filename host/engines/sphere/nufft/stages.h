/* From points on the device to values on rings (kernels/sphere/nufft/orders.cl), and from these to
 * powers or coefficients (kernels/sphere/nufft/orders_sum.cl, of a set alone orders_sum_one.cl).
 */
#ifndef PS_ENGINES_SPHERE_NUFFT_STAGES_H
#define PS_ENGINES_SPHERE_NUFFT_STAGES_H

#include "engines/sphere/nufft/places.h"
#include "engines/sphere/nufft/sphere_powers.h"
#include "engines/sphere/nufft/tables.h"

typedef struct ps_sphere_stages {
    ps_device *device;
    ps_precision precision;
    bool only_even;
    const ps_sphere_shape *shape;
    const ps_sphere_places *points;
    const ps_sphere_tables *tables;
    ps_sphere_ring_tables rings;
    ps_kernel *orders, *bands, *sum;        /* bands: of sorted points */
    ps_buffer grids, rows, scratch, values; /* of orders.cl */
    ps_buffer strip_turns, strip_weights, strips, strip_starts;
    ps_buffer states, scales, diagonals, diagonal_scales, sums; /* of orders_sum.cl */
    ps_sphere_powers powers;
} ps_sphere_stages;

/* shape, points and tables are borrowed. */
pspec_status ps_sphere_stages_create(ps_sphere_stages *out, const ps_sphere_shape *shape,
                                     const ps_sphere_places *points, const ps_sphere_tables *tables,
                                     bool only_even, ps_precision precision, ps_device *device,
                                     ps_error *error) PS_MUST_CHECK;
void ps_sphere_stages_free(ps_sphere_stages *stages);

/* Values on rings, from first_value on, of the first num realizations whose points are on the
 * device. */
pspec_status ps_sphere_stages_make_values(ps_sphere_stages *stages, size_t first_value, size_t num,
                                          ps_error *error) PS_MUST_CHECK;
/* The same of one realization whose sorted points come in chunks: the sums of all since is_first,
 * ... */
pspec_status ps_sphere_stages_add_sorted(ps_sphere_stages *stages, bool is_first,
                                         ps_error *error) PS_MUST_CHECK;
/* ... and their values on rings. */
pspec_status ps_sphere_stages_finish_sorted(ps_sphere_stages *stages, size_t value,
                                            ps_error *error) PS_MUST_CHECK;
/* Sums |c_lm|^2 over m for these values: their powers are in powers.sums then. */
pspec_status ps_sphere_stages_sum(ps_sphere_stages *stages, size_t num,
                                  ps_error *error) PS_MUST_CHECK;
/* Writes the conjugates of c_lm of a realization: [order][even, odd l - m][re, im][half_pitch]. */
pspec_status ps_sphere_stages_keep(ps_sphere_stages *stages, double *coefficients,
                                   ps_error *error) PS_MUST_CHECK;

#endif
