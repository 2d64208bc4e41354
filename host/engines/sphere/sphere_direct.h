/* sphere_direct: direct sums of spherical harmonics on the device, for any degree
 * (docs/engines/sphere_direct.md). */
#ifndef PS_ENGINES_SPHERE_SPHERE_DIRECT_H
#define PS_ENGINES_SPHERE_SPHERE_DIRECT_H

#include "engines/engine.h"

extern const ps_engine ps_sphere_direct;

#endif
