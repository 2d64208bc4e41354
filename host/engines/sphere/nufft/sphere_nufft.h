/* Fast spherical-harmonic sums over many points, for all degrees up to L:
 * docs/engines/sphere_nufft.md, and for batches of not too many degrees
 * docs/engines/sphere_grid.md. */
#ifndef PS_ENGINES_SPHERE_NUFFT_SPHERE_NUFFT_H
#define PS_ENGINES_SPHERE_NUFFT_SPHERE_NUFFT_H

#include "engines/engine.h"

extern const ps_engine ps_sphere_nufft;
extern const ps_engine ps_sphere_grid;

#endif
