/* The variants of sphere_nufft and sphere_grid, and the state that they have in common. Private to
 * sphere_nufft.c, which is both engines, and to rings.c, cells.c, and gridded.c with degrees.c,
 * which have what differs: how points on the device become values, and values powers or
 * coefficients.
 */
#ifndef PS_ENGINES_SPHERE_NUFFT_VARIANTS_H
#define PS_ENGINES_SPHERE_NUFFT_VARIANTS_H

#include "engines/feed.h"
#include "engines/late_rows.h"
#include "engines/sphere/nufft/shape.h"
#include "engines/sphere/nufft/tables.h"

/* Directions on their way to the device, where they become places on a torus
 * (kernels/sphere/nufft/orders_ends.cl). */

typedef struct ps_sphere_places {
    ps_device *device;
    ps_precision precision;
    const ps_sphere_shape *shape;
    size_t most_points; /* of all realizations together */
    size_t num_points;  /* that are on the device */
    unsigned lanes;
    uint64_t shift;         /* of the angle from the pole, in units of 2^-64 turns */
    bool has_unit_weights;  /* on the device */
    ps_kernel *turn;        /* or sort */
    void *host_weights;     /* [most_points] float or double; NULL: none yet */
    uint64_t *host_offsets; /* [together + 1] */
    ps_feed vectors;        /* [most_points][3] */
    ps_buffer lent;         /* of ps_sphere_places_lend; {0}: none */
    const double *lent_points;
    size_t first_point; /* of what is lent */
    ps_buffer turns, weights, offsets;
    ps_buffer keys, sorted, heights, starts; /* of kernels/sphere/nufft/orders_sort.cl */
} ps_sphere_places;

/* shape is borrowed. */
pspec_status ps_sphere_places_create(ps_sphere_places *out, const ps_sphere_shape *shape,
                                     const char *program, ps_precision precision, ps_device *device,
                                     ps_error *error) PS_MUST_CHECK;
void ps_sphere_places_free(ps_sphere_places *points);

/* Makes the places of at most shape->together patterns, of shape->most_points points together. */
pspec_status ps_sphere_places_make(ps_sphere_places *points, const ps_batch *batch,
                                   ps_error *error) PS_MUST_CHECK;

/* Where host and device share memory, the next calls of ps_sphere_places_make are told parts of a
 * pattern, which is then read where it is. It must stay until ps_sphere_places_return. */
pspec_status ps_sphere_places_lend(ps_sphere_places *points, const pspec_pattern *pattern,
                                   ps_error *error) PS_MUST_CHECK;
/* Waits until nothing reads it any more. */
pspec_status ps_sphere_places_return(ps_sphere_places *points, ps_error *error) PS_MUST_CHECK;

/* Sums on GPUs (degrees.c). */
typedef struct ps_sphere_degrees {
    ps_kernel *sum;
    uint32_t rings;         /* at a time: as the shape has them, or as many as work-items */
    ps_range range;         /* of no realizations yet */
    ps_buffer coefficients; /* of the shape's at_once realizations */
} ps_sphere_degrees;

typedef struct ps_sphere_state ps_sphere_state;

pspec_status ps_sphere_degrees_create(ps_sphere_degrees *out, const ps_sphere_state *self,
                                      ps_error *error) PS_MUST_CHECK;
void ps_sphere_degrees_free(ps_sphere_degrees *degrees); /* {0} is allowed */
/* Of values of the first num realizations, by a kernel of degree_powers.cl. */
pspec_status ps_sphere_degrees_sum(const ps_sphere_state *self, const ps_sphere_degrees *degrees,
                                   const ps_sphere_starts *starts, ps_kernel *kernel,
                                   const ps_buffer *to, size_t num, ps_error *error) PS_MUST_CHECK;

/* The table of sphere_grid on the device: what a cell of the grid counts in c_lm, for all degrees
 * and orders. */

/* Names of kernels/sphere/grid/table.h and begins.cl. */
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

/* Launches a kernel of sums for the first num realizations. */
typedef pspec_status ps_sphere_launch_sums(ps_sphere_state *state, ps_kernel *kernel,
                                           const ps_buffer *to, size_t num, ps_error *error);

typedef struct ps_sphere_variant {
    double programs;     /* without those of coefficients and of sums_one */
    const char *program; /* source of the kernels of ps_sphere_defines */
    double (*count_table_flops)(const ps_sphere_shape *); /* once for all realizations; NULL: 0 */
    size_t own_bytes; /* of ps_sphere_state.own, which begins as zeros */
    pspec_status (*create)(ps_sphere_state *, ps_error *);
    void (*free)(void *own); /* also what was created in part */
    /* Makes values of some realizations, no more than the shape's `together`, from first_value on.
     */
    pspec_status (*make_values)(ps_sphere_state *, size_t first_value, const ps_batch *some,
                                ps_error *);
    /* The kernel of sums, and what launches it; has_sums_one: of one set there is another, of
     * orders_sum_one.cl. */
    const char *sums;
    bool has_sums_one;
    ps_sphere_launch_sums *launch_sums;
    void (*describe)(const ps_sphere_state *, ps_text *);
} ps_sphere_variant;

/* By rings on CPUs (rings.c), all points at once or sorted, and on GPUs (gridded.c), and by cells
 * (cells.c). */
extern const ps_sphere_variant ps_sphere_rings, ps_sphere_sorted_rings, ps_sphere_gridded,
    ps_sphere_cells;

struct ps_sphere_state {
    ps_device *device;
    ps_problem problem;
    ps_precision precision;
    bool only_even;
    ps_sphere_shape shape;
    const ps_sphere_variant *variant; /* of the shape */
    ps_sphere_places points;
    ps_sphere_tables tables;
    ps_kernel *sum, *fold;
    ps_buffer sums;                   /* [group][realization][even, odd degrees][half_pitch] */
    ps_buffer grids, scratch, values; /* values: on rings, or on the angles of the grid */
    void *own;                        /* of the variant */
    ps_late_rows rows;
};

/* ---- from sums of orders to powers or coefficients (sphere_powers.c) ---------------------- */

ps_defines ps_sphere_defines(const ps_sphere_shape *shape, ps_precision precision);
/* A kernel of the variant's program. */
pspec_status ps_sphere_kernel_get(const ps_sphere_state *self, ps_kernel **out, const char *name,
                                  ps_error *error) PS_MUST_CHECK;

/* The kernels of sums, and room for what they leave. */
pspec_status ps_sphere_powers_create(ps_sphere_state *self, ps_error *error) PS_MUST_CHECK;
/* Of the first num values makes powers in `sums`, [realization][even, odd degrees][half_pitch]. */
pspec_status ps_sphere_powers_sum(ps_sphere_state *self, size_t num, ps_error *error) PS_MUST_CHECK;
/* The conjugates of c_lm of the first to [order][even, odd l - m][re, im][half_pitch]. Kernel and
 * room are there only as long as they are needed. */
pspec_status ps_sphere_powers_keep(ps_sphere_state *self, double *coefficients,
                                   ps_error *error) PS_MUST_CHECK;

#endif
