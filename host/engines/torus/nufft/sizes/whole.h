/* Sizes of realizations that one work-group does whole (kernels/nufft/whole.cl): what their two
 * transforms keep, memory.
 */
#ifndef PS_ENGINES_TORUS_NUFFT_SIZES_WHOLE_H
#define PS_ENGINES_TORUS_NUFFT_SIZES_WHOLE_H

#include "engines/torus/nufft/choice.h"

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

/* Gives the largest frequency that each of the two transforms of a whole realization keeps. In one
 * dimension, frequency k_1 + lengths[0] k_2, |k_1| <= kept[0], is k_1 of the first and k_2 of the
 * second. */
void ps_nufft_whole_kept(const ps_nufft_choice *choice, uint32_t kept[2]);

/* Lanes of the last tile that realizations share; 0: they do not. lanes: those of the device, or
 * fewer. */
uint32_t ps_nufft_whole_shared(const ps_nufft_choice *choice, unsigned lanes);

ps_nufft_whole_sizes ps_nufft_whole_measure(const ps_nufft_choice *choice, unsigned lanes);

#endif
