/* What a spectrum is made of: sums over realizations, not means, so that spectra of parts of a job
 * can be added up to the spectrum of the whole.
 *
 * Under the normalization of integrals the sums are of q = N_ref |S|^2 / W^2, N_ref being a number
 * of points that was fixed when summing began (jobs/estimator.h); sums of another N_ref are
 * rescaled.
 */
#ifndef PS_SPECTRA_SPECTRUM_SUMS_H
#define PS_SPECTRA_SPECTRUM_SUMS_H

#include "plan/replan.h"
#include "spectra/spectrum.h"
#include "spectra/sum_nodes.h"

typedef struct ps_spectrum_sums {
    ps_frequencies frequencies; /* its own, enumerated */
    pspec_normalization normalization;
    double reference_points; /* N_ref; 1 under the other normalizations */
    /* Largest of all: bound of the numerical error of S, deviation from the referee (nan: not all
     * were checked), and what vectors were off from length 1 (jobs/estimator.h, ps_accuracy) */
    double error, self_check, length_error;
    ps_pattern_totals totals;
    /* Of a deterministic set: the only realization stands for so many; 0: every one was computed */
    uint64_t num_equal;
    size_t num_bins; /* all, the unreported one included */
    ps_sums *bins;   /* [num_bins] */
    ps_sums *powers; /* [frequencies.num]; NULL: nobody asked for them */
    ps_sums *c2;     /* [frequencies.num], C_l^2 of pair sums; NULL: there are none */
    /* Of a range of the realizations of a job: what the sums above, and those of the totals, are
     * put together from, how many realizations the job has, and its tolerance; 0: of a whole job */
    ps_sum_nodes nodes;
    uint64_t num_all;
    double tolerance;
    /* The error of pair sums of coefficients follows from theirs, and the largest share of a weight
     * (engines/error_units.h), which may be those of different ranges; 0: it is the engine's */
    double amplitude_error, largest_share;
    double largest_power; /* as ps_accuracy has it */
    ps_replan planned;    /* what the plan was for */
} ps_spectrum_sums;

/* Copies the frequencies; all sums are 0. */
pspec_status ps_spectrum_sums_create(ps_spectrum_sums *out, const ps_frequencies *frequencies,
                                     size_t num_bins, bool has_powers, bool has_c2,
                                     ps_error *error) PS_MUST_CHECK;
void ps_spectrum_sums_free(ps_spectrum_sums *sums);

/* Adds the realizations of other after those of sums. Different questions, and deterministic sets,
 * which are all equal, are PSPEC_ERROR_INPUT; which names other in the sentence. */
pspec_status ps_spectrum_sums_merge(ps_spectrum_sums *sums, const ps_spectrum_sums *other,
                                    const char *which, ps_error *error) PS_MUST_CHECK;

/* Are both of the same question? Else PSPEC_ERROR_INPUT; which names b in the sentence. */
pspec_status ps_spectrum_sums_compare(const ps_spectrum_sums *a, const ps_spectrum_sums *b,
                                      const char *which, ps_error *error) PS_MUST_CHECK;

/* ---- ranges of the realizations of a job (spectrum_ranges.c) --------------------------------- */

/* Which realizations they are; [first, end). */
uint64_t ps_spectrum_sums_first(const ps_spectrum_sums *sums);
uint64_t ps_spectrum_sums_end(const ps_spectrum_sums *sums);
/* Fills the sums of a range, and the number of realizations, from its nodes. */
void ps_spectrum_sums_flatten(ps_spectrum_sums *sums);
/* Adds the range behind that of sums, of the same job, to its nodes. PSPEC_ERROR_INPUT where the
 * questions differ, the ranges overlap, or something is missing between them; names are those of
 * both in sentences. */
pspec_status ps_spectrum_sums_join(ps_spectrum_sums *sums, const ps_spectrum_sums *next,
                                   const char *const names[2], ps_error *error) PS_MUST_CHECK;
/* The error of both, larger ones of which are taken into that of sums. */
void ps_spectrum_sums_join_errors(ps_spectrum_sums *sums, const ps_spectrum_sums *next);
/* Behind the last: flattens. Where that is all of the job, they are now the sums of the job, with
 * its bits. */
void ps_spectrum_sums_close(ps_spectrum_sums *sums);

/* Means and standard errors of bins over realizations: means[num_bins]; or of C_l^2:
 * means[frequencies.num]. */
void ps_spectrum_sums_bins(const ps_spectrum_sums *sums, ps_mean *means);
void ps_spectrum_sums_c2(const ps_spectrum_sums *sums, ps_mean *means);
/* The averages; bins are those of the frequencies. */
pspec_status ps_spectrum_sums_finish(const ps_spectrum_sums *sums, const ps_bins *bins,
                                     ps_spectrum *out, ps_error *error) PS_MUST_CHECK;

#endif
