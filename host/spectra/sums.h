/* Sum and sum of squares in double pairs: enough digits that a variance from raw sums loses
 * nothing. */
#ifndef PS_SPECTRA_SUMS_H
#define PS_SPECTRA_SUMS_H

#include <math.h>
#include <stdint.h>

typedef struct ps_sums {
    double sum, sum_low, square, square_low;
} ps_sums;

void ps_sums_add(ps_sums *sums, double x);
/* For means alone: the squares stay as they are. Begun as PS_SUMS_MEAN_ONLY, sums have a standard
 * error of nan, and so have those that they are merged with. */
#define PS_SUMS_MEAN_ONLY ((ps_sums){.square = NAN, .square_low = NAN})
void ps_sums_add_to_mean(ps_sums *sums, double x);
/* Adds the sums of factor * x: those of other realizations whose powers had another unit. With
 * factor 1 (or a power of two), to the pair's last digit what adding the x one by one gives. */
void ps_sums_merge(ps_sums *sums, const ps_sums *other, double factor);
/* Mean and standard error s / sqrt(count) with s^2 = sum (x - mean)^2 / (count - 1); nan when
 * count < 2. Numbers that differ by no more than rounding give exactly 0: a standard error below
 * sqrt(count) 2^-53 of the mean is taken for that. */
void ps_sums_finish(const ps_sums *sums, uint64_t count, double *mean, double *standard_error);

#endif
