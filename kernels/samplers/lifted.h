/* Points of the sphere or the hemisphere that samplers of the plane are lifted to. Needs doubles.
 */
#ifndef PS_SAMPLERS_LIFTED_H
#define PS_SAMPLERS_LIFTED_H

#include "samplers/strata.h"
#include "samplers/white.h"
#include "shared/sphere_point.h"

SAMPLER_INLINE void white_point(const sampler_numbers *of, const bool on_hemisphere,
                                const ps_u64 realization, const ps_u64 j, double *point) {
    double x[SAMPLER_PLANE];
    white_coordinates(of, realization, j, x);
    ps_sphere_point_of_area(on_hemisphere, x[0], x[1], point);
}

SAMPLER_INLINE void jittered_point(const sampler_numbers *of, const bool on_hemisphere,
                                   const ps_u64 realization, const ps_u64 j, double *point) {
    double x[SAMPLER_PLANE];
    jittered_coordinates(of, realization, j, x);
    ps_sphere_point_of_area(on_hemisphere, x[0], x[1], point);
}

#endif
