/* Sum and sum of squares in double pairs: enough digits that a variance from raw sums loses
 * nothing. */
#ifndef PS_SPECTRA_SUMS_H
#define PS_SPECTRA_SUMS_H

#include "store/checkpoint.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct ps_sums {
    double sum, sum_low, square, square_low;
} ps_sums;

void ps_sums_add(ps_sums *sums, double x);
/* Of means alone, whose squares stay as they are: the standard error is nan, and so is that of what
 * they are merged with. */
#define PS_SUMS_MEAN_ONLY ((ps_sums){.square = NAN, .square_low = NAN})
/* Adds the sums of factor * x: those of other realizations whose powers had another unit. With
 * factor 1 (or a power of two), to the pair's last digit what adding the x one by one gives. */
void ps_sums_merge(ps_sums *sums, const ps_sums *other, double factor);
/* The same of sums that a device had in pairs of single precision, with its bits: late, which
 * follow early, become both. */
void ps_sums_merge_singles(ps_sums *late, const ps_sums *early);
/* Of the sums over all of count realizations, from pairs of single precision: squares that differ
 * from those of equal numbers by no more than their rounding become theirs. */
void ps_sums_drop_rounding(ps_sums *sums, uint64_t count);
/* Mean and standard error s / sqrt(count) with s^2 = sum (x - mean)^2 / (count - 1); nan when
 * count < 2. Numbers that differ by no more than rounding give exactly 0: a standard error below
 * sqrt(count) 2^-53 of the mean is taken for that. */
void ps_sums_finish(const ps_sums *sums, uint64_t count, double *mean, double *standard_error);

/* ---- sums over realizations ---------------------------------------------------------------- */

/* Sums of many numbers over realizations in the order of kernels/accumulate/sums.h: the same bits
 * as on a device, whatever came at a time. */

typedef struct ps_running_sums {
    size_t num;
    uint64_t count;  /* of realizations */
    unsigned levels; /* that there is room for */
    bool mean_only;
    ps_sums *rows; /* [1 + levels][num]: the open block; levels of whole ones */
} ps_running_sums;

/* With room for `expected` realizations. What was created may be freed twice. */
pspec_status ps_running_sums_create(ps_running_sums *out, size_t num, uint64_t expected,
                                    bool mean_only, ps_error *error) PS_MUST_CHECK;
void ps_running_sums_free(ps_running_sums *sums);
/* Room for so many realizations in all, where there were more than expected. */
pspec_status ps_running_sums_reserve(ps_running_sums *sums, uint64_t count,
                                     ps_error *error) PS_MUST_CHECK;
/* One more realization, number i of which is values[i], or values[places[i]] unless that is
 * NULL. */
void ps_running_sums_add(ps_running_sums *sums, const double *values, const uint32_t *places);
/* The plain sums: rows are merged into a copy, from the open block on. */
ps_sums ps_running_sums_get(const ps_running_sums *sums, size_t i);
/* Takes the rows that there are to a checkpoint or from one, under names that begin with this. */
pspec_status ps_running_sums_walk(ps_running_sums *sums, ps_snapshot *snapshot, const char *name,
                                  ps_error *error) PS_MUST_CHECK;
/* Do so many realizations have that row? Those of the others are left from before. */
bool ps_running_has_row(uint64_t count, unsigned row);

/* ---- blocks -------------------------------------------------------------------------------- */

/* Sums over blocks of successive numbers, of one power of two each but for the last, and no more
 * than so many: in constant memory, how two means over the same realizations depend on each
 * other. */
enum { PS_MOST_BLOCKS = 256 };
typedef struct ps_block_sums {
    uint64_t count, length; /* of all numbers, and of those of a block; {0} at first */
    double sums[PS_MOST_BLOCKS];
} ps_block_sums;

void ps_block_sums_add(ps_block_sums *blocks, double x);
/* Takes them to a checkpoint or from one, under names that begin with this. */
pspec_status ps_block_sums_walk(ps_block_sums *blocks, ps_snapshot *snapshot, const char *name,
                                ps_error *error) PS_MUST_CHECK;
/* What blocks are off, from their share of the mean: their products, summed, are the covariance of
 * two means, and their squares the squared standard error of one. out[PS_MOST_BLOCKS], 0 behind the
 * last; returns how many there are, 0 where there is no error: of fewer than two blocks. */
size_t ps_block_sums_deviations(const ps_block_sums *blocks, double *out);

#endif
