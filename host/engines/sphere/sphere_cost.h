/* What a job of sphere_direct costs: a pure function of problem, kind of device and precision. */
#ifndef PS_ENGINES_SPHERE_SPHERE_COST_H
#define PS_ENGINES_SPHERE_SPHERE_COST_H

#include "engines/sphere/sphere_layout.h"

/* Degrees of points in the walks of kernels/sphere/sums.cl, which go by whole blocks of degrees and
 * vectors of points, and all that begins and ends them in units of the same time. */
double ps_sphere_harmonics(const ps_sphere_layout *layout, const ps_problem *problem,
                           const ps_device_limits *limits);

#endif
