/* Errors in the units of what was asked. Engines that make coefficients have an error of S,
 * relative to white noise: sqrt(mean |dS|^2) = e sqrt(V) (ps_survey.error). Sums over pairs have
 * one of Q(l) itself: |dQ(l)| = d (sum |w|)^2. With s = V / (sum |w|)^2, which is 1 / N for equal
 * weights, and Q(l) <= (sum |w|)^2,
 *
 *     |dQ(l)| <= (2 x + x^2) (sum |w|)^2,  x = SPREAD e sqrt(s)
 *
 * SPREAD = 2 is how much larger the error of one degree is than the root mean square over all of
 * them (tests/engines/pairs/test_pairs_error.c). The other way round there is nothing: a small
 * power drowns in the rounding of a sum over pairs, and sets of a spectrum have small powers.
 */
#ifndef PS_ENGINES_ERROR_UNITS_H
#define PS_ENGINES_ERROR_UNITS_H

#include "engines/engine.h"

/* s of the problem: what is known, else 1 / N. */
double ps_weight_share(const ps_problem *problem);
/* Part of survey of engines that sum over pairs. */
bool ps_engine_sums_pairs(const ps_problem *problem, const char **why_not);

/* What an engine is told: the same problem with the tolerance in its own units. */
ps_problem ps_engine_problem(const ps_engine *engine, const ps_problem *problem);
/* An error in the engine's units, as the problem's tolerance has it. */
double ps_engine_error_in(const ps_engine *engine, const ps_problem *problem, double own_error);

/* That of Q(l) which coefficients of such an error have, with that share. */
double ps_pair_sums_error(double amplitude_error, double share);

/* Relative error, three standard deviations, of a power of `floor` times that of white noise; 0
 * without a floor. */
double ps_engine_floor_error(const ps_engine *engine, const ps_problem *problem, double own_error);
/* The largest of them: "powers down to P are right to 10 %". */
#define PS_FLOOR_ERROR 0.1
/* The largest error of S in sqrt(V) with which a power of `floor` is. */
double ps_floor_amplitude(double floor);

#endif
