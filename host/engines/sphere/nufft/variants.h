/* The variants of sphere_nufft and sphere_grid, and the state that they have in common. Private to
 * sphere_nufft.c, which is both engines, and variants.c, which has what differs.
 */
#ifndef PS_ENGINES_SPHERE_NUFFT_VARIANTS_H
#define PS_ENGINES_SPHERE_NUFFT_VARIANTS_H

#include "engines/late_rows.h"
#include "engines/sphere/nufft/places.h"
#include "engines/sphere/nufft/shape.h"
#include "engines/sphere/nufft/sphere_powers.h"
#include "engines/sphere/nufft/tables.h"

/* From points on the device to values on rings (kernels/sphere/nufft/orders.cl), and from these to
 * powers or coefficients (kernels/sphere/nufft/orders_sum.cl, of a set alone orders_sum_one.cl).
 */

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

/* From points on the device to values on the angles of the grid
 * (kernels/sphere/nufft/grid_values.cl), and from these to powers or coefficients
 * (kernels/sphere/nufft/grid_sums.cl).
 */

/* The table of sphere_grid on the device: what a cell of the grid counts in c_lm, for all degrees
 * and orders. */

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

typedef struct ps_sphere_state ps_sphere_state;

typedef struct ps_sphere_variant {
    double kernels; /* programs, without the one of coefficients */
    double (*count_table_flops)(const ps_sphere_shape *); /* once for all realizations */
    pspec_status (*create)(ps_sphere_state *, bool only_even, ps_error *);
    /* Makes values of some realizations, no more than the shape's `together`, from first_value on.
     */
    pspec_status (*make_values)(ps_sphere_state *, size_t first_value, const ps_batch *some,
                                ps_error *);
    /* Powers of the first num values, and where they are; coefficients of the first one. */
    pspec_status (*sum)(ps_sphere_state *, size_t num, const ps_buffer **powers, ps_error *);
    pspec_status (*keep)(ps_sphere_state *, double *coefficients, ps_error *);
    void (*describe)(const ps_sphere_state *, ps_text *);
    void (*free)(ps_sphere_state *); /* also what was created in part, or not at all */
} ps_sphere_variant;

const ps_sphere_variant *ps_sphere_variant_of(const ps_sphere_shape *shape);

struct ps_sphere_state {
    ps_device *device;
    ps_problem problem;
    ps_precision precision;
    ps_sphere_shape shape;
    const ps_sphere_variant *variant; /* of the shape */
    ps_sphere_places points;
    ps_sphere_tables tables;
    ps_sphere_stages stages;           /* by rings, */
    ps_sphere_grid_stages grid_stages; /* or by cells */
    ps_late_rows rows;
};

#endif
