/* The variants of sphere_nufft and sphere_grid, and the state that they have in common. Private to
 * sphere_nufft.c, which is both engines, and variants.c, which has what differs.
 */
#ifndef PS_ENGINES_SPHERE_NUFFT_VARIANTS_H
#define PS_ENGINES_SPHERE_NUFFT_VARIANTS_H

#include "engines/late_rows.h"
#include "engines/sphere/nufft/grid_stages.h"
#include "engines/sphere/nufft/stages.h"

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
