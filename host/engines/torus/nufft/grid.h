/* One very large set on a grid of all axes: spread chunk by chunk, then transformed into powers
 * (kernels/nufft/boxes.cl, first.cl, finish.cl, columns.cl). Memory does not grow with the points.
 */
#ifndef PS_ENGINES_TORUS_NUFFT_GRID_H
#define PS_ENGINES_TORUS_NUFFT_GRID_H

#include "engines/nufft/grid_axis.h"
#include "engines/torus/nufft/places.h"

typedef struct ps_nufft_grid {
    const ps_nufft_layout *layout;
    const ps_nufft_plan *plans; /* of the axes */
    ps_nufft_places *places;
    ps_device *device;
    bool is_alone; /* work-groups of one item: kernels/shared/group.h */
    bool is_empty; /* whatever the buffers hold */
    cl_kernel spread, first, tile, rows, columns;
    ps_buffer high[PS_NUFFT_MOST_SLABS], low[PS_NUFFT_MOST_SLABS]; /* [num_slabs] */
    ps_buffer high_strip, low_strip;                               /* of more than one slab */
    ps_buffer tile_rows, transformed;                              /* of tiles_at_once */
} ps_nufft_grid;

/* layout, plans and places are borrowed. */
pspec_status ps_nufft_grid_create(ps_nufft_grid *out, const ps_nufft_layout *layout,
                                  const ps_nufft_plan *plans, ps_nufft_places *places,
                                  ps_precision precision, ps_device *device,
                                  ps_error *error) PS_MUST_CHECK;
void ps_nufft_grid_free(ps_nufft_grid *grid);

/* An empty grid. */
void ps_nufft_grid_begin(ps_nufft_grid *grid);
/* Any number of points more, the only pattern of the batch; it may be cancelled. Bits are the same
 * in several calls if all but the last have a multiple of layout->parts * layout->part_points of
 * them. */
pspec_status ps_nufft_grid_add(ps_nufft_grid *grid, const ps_batch *batch,
                               ps_error *error) PS_MUST_CHECK;
/* means: a buffer whose first number is taken off every cell. */
pspec_status ps_nufft_grid_finish(ps_nufft_grid *grid, const ps_buffer *means,
                                  const ps_nufft_target *target, ps_error *error) PS_MUST_CHECK;

#endif
