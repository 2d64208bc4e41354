/* The error law of sphere_direct: docs/engines/sphere_direct.md. */
#ifndef PS_ENGINES_SPHERE_SPHERE_ERROR_H
#define PS_ENGINES_SPHERE_SPHERE_ERROR_H

#include "engines/engine.h"

/* ps_engine.error */
double ps_sphere_error(const ps_problem *problem, const ps_device_limits *limits,
                       ps_precision precision, double mean_power);

#endif
