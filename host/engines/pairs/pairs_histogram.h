/* The engine pairs_histogram: the chords of all pairs of points in a histogram,
 * docs/engines/pairs_histogram.md. */
#ifndef PS_ENGINES_PAIRS_PAIRS_HISTOGRAM_H
#define PS_ENGINES_PAIRS_PAIRS_HISTOGRAM_H

#include "engines/engine.h"

/* Expected error of a problem that it may do, for a set of any mean power (ps_survey.error). */
double ps_pairs_histogram_error(const ps_problem *problem, const ps_device_limits *limits,
                                ps_precision precision, double mean_power);

#endif
