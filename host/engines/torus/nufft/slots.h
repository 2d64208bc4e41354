/* Where the powers of a row stand. */
#ifndef PS_ENGINES_TORUS_NUFFT_SLOTS_H
#define PS_ENGINES_TORUS_NUFFT_SLOTS_H

#include "engines/torus/nufft/layout.h"

/* Of frequency k in a row of tiles. */
uint32_t ps_nufft_tile_slot(const ps_nufft_layout *layout, const int32_t *k, unsigned dimension);

#endif
