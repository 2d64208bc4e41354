/* From sums of orders to powers or coefficients: what sphere_nufft and sphere_grid have in common
 * behind their kernels of sums, and the options that both compile with.
 */
#ifndef PS_ENGINES_SPHERE_NUFFT_SPHERE_POWERS_H
#define PS_ENGINES_SPHERE_NUFFT_SPHERE_POWERS_H

#include "engines/sphere/nufft/shape.h"

typedef struct ps_sphere_powers {
    ps_device *device;
    ps_precision precision;
    bool is_alone; /* work-groups of one item: kernels/shared/group.h */
    const ps_sphere_shape *shape;
    ps_kernel *fold;
    ps_buffer sums; /* [group][realization][even, odd degrees][half_pitch] */
} ps_sphere_powers;

/* shape is borrowed. */
pspec_status ps_sphere_powers_create(ps_sphere_powers *out, const ps_sphere_shape *shape,
                                     ps_precision precision, ps_device *device,
                                     ps_error *error) PS_MUST_CHECK;
void ps_sphere_powers_free(ps_sphere_powers *powers);

/* A kernel of kernels/sphere/nufft. */
typedef struct ps_sphere_source {
    const char *file, *name;
    bool sums_one; /* orders_sum_one.cl: in double precision, with sum_lanes */
} ps_sphere_source;

/* A kernel for this precision, these lanes and work-groups; keeps: with -DKEEP=1. */
pspec_status ps_sphere_kernel_get(const ps_sphere_powers *self, ps_kernel **out,
                                  const ps_sphere_source *source, bool keeps,
                                  ps_error *error) PS_MUST_CHECK;

/* Work-groups of one item on CPUs, where lanes are vectors. */
ps_range ps_sphere_group_range(const ps_device *device, bool is_alone, size_t groups, double flops);

/* Of what a kernel has left in `sums` for the groups of num realizations makes their powers there,
 * [realization][even, odd degrees][half_pitch]. */
pspec_status ps_sphere_powers_fold(const ps_sphere_powers *self, size_t num,
                                   ps_error *error) PS_MUST_CHECK;

/* Launches a kernel of sums for the first num realizations. */
typedef pspec_status (*ps_sphere_launch_sums)(void *stages, ps_kernel *kernel, const ps_buffer *to,
                                              size_t num, ps_error *error);
/* The conjugates of c_lm of the first to [order][even, odd l - m][re, im][half_pitch]. Kernel and
 * room are there only as long as they are needed. */
pspec_status ps_sphere_keep(const ps_sphere_powers *self, const ps_sphere_source *source,
                            ps_sphere_launch_sums launch, void *stages, double *coefficients,
                            ps_error *error) PS_MUST_CHECK;

#endif
