/* The error formula of torus_direct (docs/engines/torus_direct.md). */
#ifndef PS_ENGINES_TORUS_TORUS_ERROR_H
#define PS_ENGINES_TORUS_TORUS_ERROR_H

#include "engines/engine.h"

/* ps_survey.error for sets of num_points at most, whose mean effective power is as given. by_units:
 * products are those of kernels/torus/product_units.cl. */
double ps_torus_error(const ps_frequencies *frequencies, ps_precision precision, bool by_units,
                      double num_points, double mean_power);

#endif
