/* The engine pairs_direct: Legendre polynomials of all pairs of points,
 * docs/engines/pairs_direct.md. */
#ifndef PS_ENGINES_PAIRS_PAIRS_DIRECT_H
#define PS_ENGINES_PAIRS_PAIRS_DIRECT_H

#include "engines/engine.h"

extern const ps_engine ps_pairs_direct;

#endif
