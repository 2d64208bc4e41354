/* Realizations whose places are there, into powers: tiles of frequencies of axis 0 by direct
 * phases, those of the other axes by spreading and transforms (kernels/nufft/tile.cl, rows.cl,
 * columns.cl).
 */
#ifndef PS_ENGINES_TORUS_NUFFT_TILES_H
#define PS_ENGINES_TORUS_NUFFT_TILES_H

#include "engines/nufft/grid_axis.h"
#include "engines/torus/nufft/lines.h"
#include "engines/torus/nufft/places.h"

typedef struct ps_nufft_tiles {
    const ps_nufft_layout *layout;
    const ps_nufft_plan *plans; /* of the axes */
    const ps_nufft_places *places;
    ps_device *device;
    cl_kernel tile, rows, columns;
    ps_buffer pattern; /* how frequency 0 turns from cell to cell of the first axis */
    ps_buffer grid;    /* transformed rows, in three dimensions */
    ps_nufft_lines lines;
} ps_nufft_tiles;

/* For batches of so many realizations. layout, plans and places are borrowed. */
pspec_status ps_nufft_tiles_create(ps_nufft_tiles *out, const ps_nufft_layout *layout, size_t batch,
                                   const ps_nufft_plan *plans, const ps_nufft_places *places,
                                   ps_precision precision, ps_device *device,
                                   ps_error *error) PS_MUST_CHECK;
void ps_nufft_tiles_free(ps_nufft_tiles *tiles);

/* The realizations that places hold, into rows from target->realization on. means: what frequency 0
 * leaves in a cell, of each of them. */
pspec_status ps_nufft_tiles_run(ps_nufft_tiles *tiles, size_t num_realizations,
                                const ps_buffer *means, const ps_nufft_target *target,
                                ps_error *error) PS_MUST_CHECK;

/* What realizations of a batch have in common, once all of them were run: frequency 0 of axis 0,
 * where it is a line. */
pspec_status ps_nufft_tiles_finish(ps_nufft_tiles *tiles, size_t num_realizations,
                                   const ps_nufft_target *target, ps_error *error) PS_MUST_CHECK;

#endif
