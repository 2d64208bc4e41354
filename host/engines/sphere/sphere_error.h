/* The error law of sphere_direct: docs/engines/sphere_direct.md. */
#ifndef PS_ENGINES_SPHERE_SPHERE_ERROR_H
#define PS_ENGINES_SPHERE_SPHERE_ERROR_H

#include "engines/engine.h"

/* Expected error for sets of a mean power (ps_survey.error). */
double ps_sphere_error(const ps_problem *problem, ps_precision precision, double mean_power);

#endif
