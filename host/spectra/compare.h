/* Are two averaged spectra those of the same sampler? Bin by bin, with a rate of false alarms for
 * all bins together.
 *
 * The power of a bin in one realization, a mean of periodograms, scatters nearly like a gamma
 * variable. If both sides are averages over realizations of one sampler, the two means are gamma
 * variables of one shape per realization, 1 / cv^2, cv the relative scatter, and their ratio has an
 * F distribution. cv is estimated from the standard errors of both sides together, so that one side
 * may be a single realization; the uncertainty of the estimate is that of Student's distribution.
 * Welch's test, which takes the scatter of each side from that side, gives 40 to 250 times too many
 * false alarms where few realizations of low rings are compared with many, for small samples of
 * skewed variables have small means and small standard errors together. docs/user/gate.md has the
 * formulas and what was measured.
 *
 * Probabilities of all bins are judged together by Holm's method, which needs no independence. */
#ifndef PS_SPECTRA_COMPARE_H
#define PS_SPECTRA_COMPARE_H

#include "frequencies/frequencies.h"
#include "spectra/normalization.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A bin of one side. */
typedef struct ps_compared {
    double power, standard_error; /* of the mean; not looked at for one realization */
    double error;                 /* bound of the numerical error of power */
} ps_compared;

/* What is said about a bin. */
typedef struct ps_comparison {
    double score;   /* normal score of the ratio; positive: measured more */
    double p_value; /* of this bin alone */
    /* Holm's: the smallest rate of false alarms at which the bin differs */
    double adjusted_p_value;
    /* relative change of power that is found with probability 0.9, see compare.c */
    double detectable;
    bool differs;
} ps_comparison;

/* out[num_bins]. false_alarm_rate: probability that any bin differs between realizations of one
 * sampler, above 0 and below 1. Bins that agree within both numerical errors have p_value 1. One
 * realization on both sides, where nothing tells the scatter, is PSPEC_ERROR_INPUT unless all bins
 * agree like that. */
pspec_status ps_compare(ps_comparison *out, size_t num_bins, const ps_compared *saved,
                        uint64_t num_saved, const ps_compared *measured, uint64_t num_measured,
                        double false_alarm_rate, ps_error *error) PS_MUST_CHECK;

/* Frequencies of both signs, or orders, over which the error of S is a root mean square; those of a
 * box where it is not known whether corners were left out. */
double ps_compared_modes(const ps_frequencies *frequencies);

/* The power of white noise: N V / W^2 from means over the realizations, of N and of W^2 / V; 1 with
 * equal weights and under the effective normalization. Under that of integrals sets of few points
 * have more, at most as if all were the smallest. */
double ps_compared_unit(pspec_normalization normalization, double mean_points,
                        double mean_sample_size, uint64_t smallest_points);

/* Bound of the error of a power, of an engine whose error of S is `error` sqrt(V), root mean square
 * over all frequencies, of which the bin has the share `share`; unit: ps_compared_unit. */
double ps_compared_error(double power, double error, double share, double unit);

#endif
