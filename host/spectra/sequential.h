/* When there are enough realizations: the rule by which a job stops at a standard error that was
 * asked for.
 *
 * After 16 realizations, and then each time there are sqrt(2) times as many, every reported bin
 * whose mean is above the floor is looked at. The job stops when
 *
 *     SE_b (1 + 3/4 sqrt((2 + kappa_b) / M)) <= X mean_b   for all of them,   kappa_b = 6 / n_b.
 *
 * The factor is the sequential correction. A rule that looks again and again stops sooner where SE
 * came out too small by chance; SE from M realizations has itself the relative standard deviation
 * sqrt((2 + kappa) / M) / 2, kappa being the excess kurtosis of the ring's power, taken as that of
 * the mean of n_b independent exponential powers (white noise). With one and a half of these
 * deviations 1 % of jobs stop while the true standard error is above X, without any 40 %: simulated
 * by tests/spectra/test_sequential.c.
 *
 * The looks do not depend on batches, so neither does the result.
 */
#ifndef PS_SPECTRA_SEQUENTIAL_H
#define PS_SPECTRA_SEQUENTIAL_H

#include "spectra/accumulate/accumulate.h"
#include "spectra/bins.h"

/* Fewer say too little of their own scatter. */
enum { PS_LEAST_REALIZATIONS = 16 };

/* The next number of realizations, above `done`, after which to look: 16, 24, 32, 46, 64, ..; even,
 * since engines pack realizations in pairs. */
uint64_t ps_sequential_next_look(uint64_t done);

/* The bin with the largest corrected standard error, relative to its mean. */
typedef struct ps_sequential_look {
    double relative_error, corrected; /* 0 when no bin is above the floor */
    int64_t bin;                      /* its key; 0: none */
} ps_sequential_look;

/* One more mean > 0, of so many independent numbers: *look becomes that of `bin` when its error is
 * larger. */
void ps_sequential_look_at(ps_sequential_look *look, ps_mean mean, double independent,
                           uint64_t num_realizations, int64_t bin);

/* means[bins->num], from num_realizations >= 2. Bins of mean <= floor, and all of power 0, are not
 * looked at. */
ps_sequential_look ps_sequential_find(const ps_bins *bins, const ps_mean *means, double floor,
                                      uint64_t num_realizations);

/* About how many realizations white noise needs when the bin of fewest independent frequencies has
 * so many: that of a look, where jobs end. */
double ps_sequential_expected(double fewest_independent, double standard_error);

#endif
