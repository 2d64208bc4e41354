/* torus_direct: direct sums on the device, over lists of frequencies and, as separable products of
 * two tables, over full grids. Phases are exact for every |k| <= PS_MAX_FREQUENCY.
 */
#ifndef PS_ENGINES_TORUS_TORUS_DIRECT_H
#define PS_ENGINES_TORUS_TORUS_DIRECT_H

#include "engines/engine.h"

extern const ps_engine ps_torus_direct;

#endif
