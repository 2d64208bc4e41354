/* Frequency 0 of axis 0 of realizations in tiles, whose rows are real numbers
 * (kernels/nufft/line.h): their transforms into powers, several realizations at a time
 * (kernels/nufft/lines.cl).
 */
#ifndef PS_ENGINES_TORUS_NUFFT_TILES_LINES_H
#define PS_ENGINES_TORUS_NUFFT_TILES_LINES_H

#include "engines/nufft/grid_axis.h"
#include "engines/torus/nufft/layout.h"

typedef struct ps_nufft_lines {
    const ps_nufft_layout *layout;
    const ps_nufft_plan *plans; /* of the axes */
    ps_device *device;
    ps_kernel *powers;         /* where one axis has a transform, */
    ps_kernel *rows, *columns; /* where two have */
    ps_buffer lines; /* [realization][row][n], which kernels/nufft/tile.cl and rows.cl fill */
    ps_buffer grid;  /* between the two transforms */
} ps_nufft_lines;

/* Room for the lines of a batch. layout and plans are borrowed. Makes next to nothing where the
 * choice has no line. */
pspec_status ps_nufft_lines_create(ps_nufft_lines *out, const ps_nufft_layout *layout, size_t batch,
                                   const ps_nufft_plan *plans, ps_device *device,
                                   ps_error *error) PS_MUST_CHECK;
void ps_nufft_lines_free(ps_nufft_lines *lines);

/* The realizations of a batch, whose lines are all there, into rows from target->realization on. */
pspec_status ps_nufft_lines_run(ps_nufft_lines *lines, size_t num_realizations,
                                const ps_nufft_target *target, ps_error *error) PS_MUST_CHECK;

#endif
