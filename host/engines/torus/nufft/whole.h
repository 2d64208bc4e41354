/* Realizations done whole, each by one work-group: spread on a grid, transformed twice
 * (kernels/nufft/whole.cl).
 */
#ifndef PS_ENGINES_TORUS_NUFFT_WHOLE_H
#define PS_ENGINES_TORUS_NUFFT_WHOLE_H

#include "engines/nufft/grid_axis.h"
#include "engines/torus/nufft/layout.h"
#include "engines/torus/torus_points.h"

typedef struct ps_nufft_whole {
    const ps_nufft_layout *layout;
    const ps_nufft_plan *plans; /* windows of the axes */
    ps_device *device;
    cl_kernel kernel;
    bool is_alone; /* work-groups of one item: kernels/shared/group.h */
    ps_torus_points points;
    size_t num_points; /* that were uploaded */
    ps_fft_plan transforms[2];
    ps_buffer gains, lane_turns, tile_turns; /* of the kernel */
    ps_buffer grids, rows;                   /* of work-groups */
} ps_nufft_whole;

/* layout and plans are borrowed. */
pspec_status ps_nufft_whole_create(ps_nufft_whole *out, const ps_nufft_layout *layout,
                                   const ps_nufft_plan *plans, ps_precision precision,
                                   ps_device *device, ps_error *error) PS_MUST_CHECK;
void ps_nufft_whole_free(ps_nufft_whole *whole);

/* The realizations of a batch, and then their powers, into rows from target->realization on. means:
 * what frequency 0 leaves in a cell, of each of them. */
pspec_status ps_nufft_whole_upload(ps_nufft_whole *whole, const ps_batch *batch,
                                   ps_error *error) PS_MUST_CHECK;
pspec_status ps_nufft_whole_run(ps_nufft_whole *whole, size_t num_realizations,
                                const ps_buffer *means, const ps_nufft_target *target,
                                ps_error *error) PS_MUST_CHECK;

#endif
