/* Realizations that one work-group does whole (kernels/nufft/whole.cl): lengths of the two transforms, what they
 * keep, memory.
 */
#ifndef PS_ENGINES_NUFFT_WHOLE_SHAPE_H
#define PS_ENGINES_NUFFT_WHOLE_SHAPE_H

#include "engines/nufft/choice.h"

/* Sizes in memory, in cells and numbers. */
typedef struct ps_nufft_whole_sizes {
    uint32_t columns;    /* of a row of a tile: whole vectors, twice */
    uint32_t pitch;      /* of a row of the grid */
    uint32_t grid_rows;  /* with those behind the end */
    size_t grid_reals;   /* of a work-group, */
    size_t row_reals;    /* and of a row of a tile, with what stands behind it */
    uint32_t shared;     /* lanes of the last tile, where realizations share it, else 0 */
    size_t window_reals; /* of a chunk */
} ps_nufft_whole_sizes;

/* Of a choice whose axes have grids: the lengths of the transforms, and the span of axis 0. False where the
 * cache of a core is too small for it. */
bool ps_nufft_whole_shape(ps_nufft_choice *choice, ps_precision precision);

/* Lanes of the last tile that realizations share; 0: they do not. lanes: those of the device, or fewer. */
uint32_t ps_nufft_whole_shared(const ps_nufft_choice *choice, unsigned lanes);

ps_nufft_whole_sizes ps_nufft_whole_measure(const ps_nufft_choice *choice, unsigned lanes);

#endif
