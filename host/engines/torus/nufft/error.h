/* The expected error of a choice.
 */
#ifndef PS_ENGINES_TORUS_NUFFT_ERROR_H
#define PS_ENGINES_TORUS_NUFFT_ERROR_H

#include "engines/torus/nufft/choice.h"

/* Expected error of a choice for sets of a mean power (ps_survey.error). */
double ps_nufft_error(const ps_nufft_choice *choice, const ps_problem *problem,
                      ps_precision precision, double mean_power);

/* The same of one axis of a choice, as if it were alone and tiles were made of it: what its window
 * is chosen by. */
double ps_nufft_error_of_axis(const ps_nufft_choice *whole, const ps_nufft_axis *axis,
                              const ps_problem *problem, ps_precision precision, double mean_power);

/* The frequencies of a problem, of both signs. */
double ps_nufft_modes(const ps_problem *problem);

#endif
