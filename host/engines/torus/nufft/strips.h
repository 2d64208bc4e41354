/* Realizations on strips of a grid, each by one work-group: spread, transformed along axis 0 and,
 * as tiles, along axis 1 (kernels/nufft/strips.cl).
 */
#ifndef PS_ENGINES_TORUS_NUFFT_STRIPS_H
#define PS_ENGINES_TORUS_NUFFT_STRIPS_H

#include "engines/nufft/grid_axis.h"
#include "engines/torus/nufft/places.h"

typedef struct ps_nufft_strips {
    const ps_nufft_layout *layout;
    const ps_nufft_plan *plans; /* of the axes */
    const ps_nufft_places *places;
    ps_device *device;
    cl_kernel kernel;
    ps_buffer strips, tiles; /* of work-groups */
} ps_nufft_strips;

/* layout, plans and places are borrowed. */
pspec_status ps_nufft_strips_create(ps_nufft_strips *out, const ps_nufft_layout *layout,
                                    const ps_nufft_plan *plans, const ps_nufft_places *places,
                                    ps_precision precision, ps_device *device,
                                    ps_error *error) PS_MUST_CHECK;
void ps_nufft_strips_free(ps_nufft_strips *strips);

/* The realizations that places hold, into rows from target->realization on. means: what frequency 0
 * leaves in a cell, of each of them. */
pspec_status ps_nufft_strips_run(ps_nufft_strips *strips, size_t num_realizations,
                                 const ps_buffer *means, const ps_nufft_target *target,
                                 ps_error *error) PS_MUST_CHECK;

#endif
