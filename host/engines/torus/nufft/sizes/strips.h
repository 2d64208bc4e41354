/* Sizes of the strips of a grid in two dimensions (kernels/nufft/strips.cl). */
#ifndef PS_ENGINES_TORUS_NUFFT_SIZES_STRIPS_H
#define PS_ENGINES_TORUS_NUFFT_SIZES_STRIPS_H

#include "engines/torus/nufft/choice.h"

typedef struct ps_nufft_strip_sizes {
    uint32_t columns, pitch; /* of a strip, and with those behind it that windows reach into */
    size_t strip_reals;
    size_t tile_reals;   /* of all tiles */
    size_t window_reals; /* of a chunk */
} ps_nufft_strip_sizes;

/* Columns of a strip; axis 1 of the grid has a multiple of them. */
uint32_t ps_nufft_strip_columns(unsigned lanes);

/* lanes: those of the device, or fewer. */
ps_nufft_strip_sizes ps_nufft_strips_measure(const ps_nufft_choice *choice, unsigned lanes);

/* Tiles of a realization belong to one core: false where they are more than 32 MiB, for several
 * realizations have theirs at a time. */
bool ps_nufft_strips_fit(const ps_nufft_choice *choice, ps_precision precision);

#endif
