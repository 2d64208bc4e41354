/* The averaged power spectrum of a job: per bin and, if kept, per frequency. */
#ifndef PS_SPECTRA_SPECTRUM_H
#define PS_SPECTRA_SPECTRUM_H

#include "spectra/accumulate/accumulate.h"
#include "spectra/bins.h"
#include "spectra/normalization.h"

typedef struct ps_spectrum_bin {
    int64_t key;                  /* ring number, |k|^2 of a shell, or degree */
    double frequency;             /* mean |k|, or the degree */
    double normalized_frequency;  /* the same divided by N^(1/d); d = 2 on the sphere */
    uint64_t count;               /* lattice points of both signs, or orders */
    uint64_t num_computed;        /* of them; fewer: a random subset */
    double power, standard_error; /* nan: one realization, all computed */
    double anisotropy_db;         /* nan: fewer than two half-lattice frequencies, or power 0 */
} ps_spectrum_bin;

typedef struct ps_spectrum {
    ps_frequencies frequencies; /* a copy of its own */
    uint64_t num_realizations;
    double mean_points;
    double points_error; /* standard error of the mean of N */
    size_t smallest_points, largest_points;
    double mean_weight_sum;
    /* W^2 / V, the effective power at DC; its standard error: nan for one set */
    ps_mean sample_size;
    size_t num_bins;
    ps_spectrum_bin *bins;
    ps_mean *powers; /* [frequencies.num], or NULL */
} ps_spectrum;

/* What happened to the realizations besides their powers. */
typedef struct ps_pattern_totals {
    uint64_t num_realizations;
    double sum_weights;
    ps_sums points;       /* of N */
    ps_sums sample_sizes; /* of W^2 / V, the effective sample size */
    size_t smallest_points, largest_points;
} ps_pattern_totals;

/* mean(N) / N_ref under the normalization of integrals, else 1. */
double ps_spectrum_factor(pspec_normalization normalization, const ps_pattern_totals *totals,
                          double reference_points);

/* factor multiplies every accumulated power (ps_spectrum_factor). */
pspec_status ps_spectrum_create(ps_spectrum *out, const ps_frequencies *frequencies,
                                const ps_bins *bins, ps_accumulator *accumulator, double factor,
                                const ps_pattern_totals *totals, bool with_frequencies,
                                ps_error *error) PS_MUST_CHECK;
/* The same from means: bin_means[bins->num]; powers[frequencies->num] or NULL, taken over. */
pspec_status ps_spectrum_from_means(ps_spectrum *out, const ps_frequencies *frequencies,
                                    const ps_bins *bins, const ps_mean *bin_means, ps_mean *powers,
                                    double factor, const ps_pattern_totals *totals,
                                    ps_error *error) PS_MUST_CHECK;
void ps_spectrum_free(ps_spectrum *spectrum);

/* Marks the spectrum as that of num_realizations equal ones: standard errors become exactly 0, but
 * for that of the choice of a subset (a deterministic set, whose further realizations were
 * skipped). */
void ps_spectrum_repeat(ps_spectrum *spectrum, uint64_t num_realizations);

/* Where frequency i of a box stands in the array [2K+1]^d in C order; -k has the opposite place. */
size_t ps_spectrum_place(const ps_frequencies *set, size_t i);
/* The whole box as an array [2K+1]^d in C order, DC in the middle, axis i along x_i; DC, which is
 * not among the frequencies, is dc. which: 0 power, 1 standard error. *array is freed by the
 * caller. */
pspec_status ps_spectrum_full(const ps_spectrum *spectrum, int which, ps_mean dc, double **array,
                              size_t *num_entries, ps_error *error) PS_MUST_CHECK;

/* What is said about one ring or shell besides its mean: anisotropy, and the standard error where
 * only a random subset of its frequencies was computed.
 */

/* Anisotropy of one ring: 10 log10(s^2 / P^2), s^2 the sample variance of the averaged periodogram
 * over the ring's half-lattice frequencies, P their mean. nan when there are fewer than two of them
 * or P is 0. */
double ps_anisotropy_db(const ps_mean *powers, const uint32_t *members, size_t num_members);

/* Standard error of the mean over a subset, as an estimate of the mean over the ring's
 * num_frequencies half-lattice frequencies: standard_error, that over the realizations, and the
 * error of the choice. With one realization (standard_error nan) the second alone, about the mean
 * over the ring of this realization. A complete ring has standard_error. The formula and why:
 * docs/user/conventions.md. */
double ps_subset_standard_error(const ps_mean *powers, const uint32_t *members, size_t num_members,
                                uint64_t num_frequencies, double standard_error);

#endif
