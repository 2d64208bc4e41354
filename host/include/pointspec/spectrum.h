/** @file
 * Spectra: averages over realizations, saved, loaded, merged, compared. Included by pointspec.h.
 */
#ifndef POINTSPEC_SPECTRUM_H
#define POINTSPEC_SPECTRUM_H

#include "pointspec/plan.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct pspec_spectrum pspec_spectrum; /**< averages over realizations */

/** @name Spectrum
 * @{ */

/** The mean over a ring or shell. */
typedef struct pspec_bin {
    int64_t bin;                 /**< ring number b, |k|^2 of a shell, or degree l */
    double frequency;            /**< mean |k|, cycles per unit cell */
    double normalized_frequency; /**< the same divided by N^(1/d), N the mean number of points */
    uint64_t count;              /**< frequencies of both signs */
    double power;                /**< mean of P over the bin and the realizations */
    double standard_error; /**< over realizations, and of the choice where only a random subset
                                    was computed; nan for one realization and all computed */
    double anisotropy_db;  /**< 10 log10(variance in the bin / power^2); nan: not defined */
    uint64_t num_computed; /**< of count, those that were computed: fewer with per_ring */
} pspec_bin;

/** A snapshot of the averages; the plan goes on. #PSPEC_ERROR_INPUT when there are no realizations
 * yet. Where the powers that were measured make the numerical error larger than the plan's
 * tolerance, another engine runs the patterns again (see pspec_plan_create()), which takes as long
 * as they took; a failure in between is as one of pspec_plan_run(). #PSPEC_ERROR_TOLERANCE when no
 * engine that the request leaves reaches it, or the patterns were too many to be kept: make a plan
 * of higher precision then. #PSPEC_ERROR_CHECK when the powers are not finite numbers. The first
 * two do not harm the plan. */
PSPEC_EXPORT pspec_status pspec_spectrum_create(pspec_spectrum **out, pspec_plan *plan);
/** NULL is allowed. Arrays of millions of frequencies stay with the plan, while there is one, for
 * its next spectrum: up to 64 bytes for each frequency, but under a memory limit of the context no
 * more than it leaves beside the plan. */
PSPEC_EXPORT void pspec_spectrum_destroy(pspec_spectrum *spectrum);

/** Writes the sums over realizations, from which every number of the spectrum follows, into a file
 * that appears when it is complete. The format is in the documentation
 * (docs/user/spectrum_file.md). The context is for the sentence of an error. */
PSPEC_EXPORT pspec_status pspec_spectrum_save(const pspec_spectrum *spectrum,
                                              pspec_context *context, const char *path);

/** Reads what pspec_spectrum_save() wrote: the same spectrum, to the bit, on every machine. A file
 * that is none, truncated, damaged (it has a checksum) or of another version is
 * #PSPEC_ERROR_INPUT. */
PSPEC_EXPORT pspec_status pspec_spectrum_load(pspec_spectrum **out, pspec_context *context,
                                              const char *path);

/** The spectrum of the realizations of spectra[0], then those of spectra[1], and so on.
 *
 * Guaranteed: the result is what one plan would have given for all of them, but for the last digits
 * of the sums over realizations. These have about 106 bits (48 for single frequencies in single
 * precision), so that means over bins and their standard errors are the same doubles but for rare
 * last bits; powers of single frequencies in single precision agree to 1e-13. The error is the
 * largest of theirs.
 *
 * #PSPEC_ERROR_INPUT with the difference, when dimension, frequencies (with per_ring: what was
 * drawn), bins or normalization differ. Numbers of points, engines, precisions and tolerances may
 * differ. */
PSPEC_EXPORT pspec_status pspec_spectrum_merge(pspec_spectrum **out, pspec_context *context,
                                               const pspec_spectrum *const *spectra,
                                               size_t num_spectra);

/** What pspec_spectrum_compare() says about one bin. */
typedef struct pspec_bin_comparison {
    double z_score; /**< normal score of measured over saved; positive: more than saved; +-infinity
                       where neither side scatters */
    double p_value; /**< probability of a score as far from 0, of this bin alone */
    double adjusted_p_value;  /**< the same for all bins together: Holm's correction */
    double detectable_change; /**< relative change of power that would be found with probability
                                 0.9; nan: not known */
    int differs;              /**< adjusted_p_value <= false_alarm_rate */
} pspec_bin_comparison;

/** Is `measured` the spectrum of the sampler that `saved` is of? Compares the powers of all bins.
 *
 * Where both are averages over independent realizations of one sampler (M_1 and M_2 of them), any
 * bin differs with probability false_alarm_rate (above 0 and below 1) at most. Powers of bins are
 * taken as gamma variables of one relative scatter cv, so that their ratio has the F distribution
 * with 2 M_2 / cv^2 and 2 M_1 / cv^2 degrees of freedom; cv^2 comes from the standard errors of
 * both sides together,
 *
 *     cv^2 = sum_i (M_i - 1) M_i (standard_error_i / power_i)^2 / (M_1 + M_2 - 2)
 *
 * or from those of the mean of both powers if that is more, and the score z_score is judged by
 * Student's distribution with (M_1 + M_2 - 2) / (1 + cv^2) degrees of freedom. Bins that agree
 * within the numerical errors of both are equal; others are compared as if the errors had driven
 * them apart. So deterministic sets (standard error 0) are compared exactly. The documentation
 * (docs/user/gate.md) has measured rates.
 *
 * bins: [number of bins of saved], or NULL; *num_different, unless NULL: how many differ. That some
 * differ is no error.
 *
 * #PSPEC_ERROR_INPUT with the difference, when the spectra are answers to different questions
 * (dimension, frequencies, bins, normalization, or numbers of points, whose ranges must overlap),
 * are sums over pairs, have no bins, or are of one realization each and not equal: nothing tells
 * the scatter then. Seeds must differ, or equality says nothing: realizations of one seed are
 * equal. */
PSPEC_EXPORT pspec_status pspec_spectrum_compare(const pspec_spectrum *saved,
                                                 const pspec_spectrum *measured,
                                                 pspec_context *context, double false_alarm_rate,
                                                 pspec_bin_comparison *bins, size_t *num_different);

/** d; 3 on the sphere. */
PSPEC_EXPORT unsigned pspec_spectrum_dimension(const pspec_spectrum *spectrum);
/** M. */
PSPEC_EXPORT uint64_t pspec_spectrum_num_realizations(const pspec_spectrum *spectrum);
/** N, mean over the realizations. */
PSPEC_EXPORT double pspec_spectrum_mean_points(const pspec_spectrum *spectrum);
/** Bound on the numerical error of S, in units of sqrt(V), root mean square over frequencies. A
 * power is off by at most about 2 sqrt(P) e + e^2, in units of the effective power. */
PSPEC_EXPORT double pspec_spectrum_error(const pspec_spectrum *spectrum);

/** Bins in ascending order, [*num_bins]; none for a list of frequencies. Belongs to the
 * spectrum. */
PSPEC_EXPORT const pspec_bin *pspec_spectrum_bins(const pspec_spectrum *spectrum, size_t *num_bins);

/** Numbers of a frequency: d, or 1 for the degrees of the sphere. */
PSPEC_EXPORT unsigned pspec_spectrum_components(const pspec_spectrum *spectrum);
/** The frequencies: the list as it was given, or the half lattice of the grid (first non-zero
 * component positive, lexicographic order, DC left out; P(-k) = P(k)), or with per_ring what was
 * drawn of it, ring by ring, unless that is everything. [*num_frequencies][components]. On the
 * sphere the degrees. Belongs to the spectrum. */
PSPEC_EXPORT const int32_t *pspec_spectrum_frequencies(const pspec_spectrum *spectrum,
                                                       size_t *num_frequencies);
/** Mean powers, [num_frequencies], in the order of the frequencies. Belong to the spectrum. */
PSPEC_EXPORT const double *pspec_spectrum_powers(const pspec_spectrum *spectrum);
/** Their standard errors over realizations, [num_frequencies]; nan for one realization. */
PSPEC_EXPORT const double *pspec_spectrum_standard_errors(const pspec_spectrum *spectrum);

/** @} */

#ifdef __cplusplus
}
#endif

#endif
