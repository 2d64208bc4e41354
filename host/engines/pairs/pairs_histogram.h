/* The engine pairs_histogram: the chords of all pairs of points in a histogram,
 * docs/engines/pairs_histogram.md. */
#ifndef PS_ENGINES_PAIRS_PAIRS_HISTOGRAM_H
#define PS_ENGINES_PAIRS_PAIRS_HISTOGRAM_H

#include "engines/engine.h"

/* Expected error of a problem that it may do, for a set of any mean power (ps_survey.error). */
double ps_pairs_histogram_error(const ps_problem *problem, const ps_device_limits *limits,
                                ps_precision precision, double mean_power);

/* The histogram behind the sums, for functions of the chord that are no P_l: bins of either side of
 * this state, and after a run the weights of their nodes (ps_pairs_bins_nodes) of its only
 * realization, [2][num_bins][PS_PAIRS_MOMENTS]: the sum of f over pairs, each once and none with
 * itself, is the sum of weight times f over the nodes. Weights of points are w 2^-exponent. */
size_t ps_pairs_histogram_num_bins(const void *state);
pspec_status ps_pairs_histogram_weights(void *state, double *weights,
                                        ps_error *error) PS_MUST_CHECK;

#endif
