/* What is said about one ring or shell besides its mean: anisotropy, and the standard error where
 * only a random subset of its frequencies was computed.
 */
#ifndef PS_SPECTRA_RING_STATISTICS_H
#define PS_SPECTRA_RING_STATISTICS_H

#include "spectra/accumulate/accumulate.h"

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
