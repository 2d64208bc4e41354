/* Capacity-constrained tessellation of the torus of the plane. The background is a lattice of one
 * generator, moved at random: its power is 0 at all low frequencies but 0
 * (docs/samplers/optimized.md#ccvt).
 */
#ifndef PS_SAMPLERS_CCVT_TORUS_CCVT_H
#define PS_SAMPLERS_CCVT_TORUS_CCVT_H

#include "math/random/random.h"
#include "samplers/ccvt/ccvt.h"

enum { PS_TORUS_CCVT_LEAST_POINTS = 16 };

extern const ps_ccvt_space ps_torus_ccvt_space;

/* The generator g of the lattice (j, g j mod num) / num, j = 0 .. num - 1: of 128 random ones that
 * whose continued fraction of g / num has the smallest largest number, so that no vector of the
 * lattice is much shorter than it must be. Each realization has another lattice: of one for all,
 * mean spectra would have its directions. num > 1. */
uint64_t ps_torus_ccvt_generator(uint64_t num, ps_random *random);

#endif
