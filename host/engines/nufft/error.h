/* The expected error of a choice.
 */
#ifndef PS_ENGINES_NUFFT_ERROR_H
#define PS_ENGINES_NUFFT_ERROR_H

#include "engines/nufft/choice.h"

/* Expected error of a choice for sets of a mean power (ps_survey.error). */
double ps_nufft_error(const ps_nufft_choice *choice, const ps_problem *problem,
                      ps_precision precision, double mean_power);

/* The frequencies of a problem, of both signs. */
double ps_nufft_modes(const ps_problem *problem);

#endif
