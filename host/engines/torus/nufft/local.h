/* Local memory of the launches of torus_nufft, for planning and for the launches themselves: a
 * layout whose launches need more than the device has is none.
 */
#ifndef PS_ENGINES_TORUS_NUFFT_LOCAL_H
#define PS_ENGINES_TORUS_NUFFT_LOCAL_H

#include "engines/torus/nufft/layout.h"

/* Numbers of a chunk of points, kernels/nufft/spread.h, with how much each turns for every tile of
 * a group. */
size_t ps_nufft_chunk_reals(const ps_nufft_layout *layout);

/* Tiles whose rows local memory has room for, beside a chunk of points. */
size_t ps_nufft_fitting_tiles(const ps_nufft_layout *layout, uint64_t local_bytes);
/* What a group of layout->group tiles takes. */
size_t ps_nufft_tiles_local_bytes(const ps_nufft_layout *layout);

/* Arguments of a launch that makes windows: rows of a block, windows and cells of a chunk. */
typedef struct ps_nufft_local {
    size_t rows, windows, cells;
} ps_nufft_local;

/* Of kernels/nufft/boxes.cl, whose rows are those of a box, and of kernels that have none
 * (whole.cl, strips.cl). */
ps_nufft_local ps_nufft_boxes_local(const ps_nufft_layout *layout);
ps_nufft_local ps_nufft_windows_local(const ps_nufft_layout *layout, size_t window_reals);
size_t ps_nufft_local_sum(ps_nufft_local local);

#endif
