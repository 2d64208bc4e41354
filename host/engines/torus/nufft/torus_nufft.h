/* torus_nufft: full grids by spreading points on a fine grid and fast transforms, two realizations
 * in one complex transform and as many pairs side by side as a vector has lanes.
 * docs/engines/torus_nufft.md.
 */
#ifndef PS_ENGINES_TORUS_NUFFT_TORUS_NUFFT_H
#define PS_ENGINES_TORUS_NUFFT_TORUS_NUFFT_H

#include "engines/engine.h"

extern const ps_engine ps_torus_nufft;

#endif
