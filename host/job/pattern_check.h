/* Checks and sums of one pattern, before anything is computed from it. */
#ifndef PS_JOB_PATTERN_CHECK_H
#define PS_JOB_PATTERN_CHECK_H

#include "base/status.h"

/* Weights count as w 2^-exponent, which makes the largest |w| a number in [1/2, 1): so neither the
 * squares of double weights nor sums in single precision overflow or vanish. */
typedef struct ps_pattern_sums {
    int exponent;             /* 0 for unit weights */
    double weight_sum;        /* W 2^-exponent */
    double weight_square_sum; /* V 2^(-2 exponent) */
} ps_pattern_sums;

/* realization counts from 0 and is only for messages. W = 0 under the default normalization is
 * PSPEC_ERROR_INPUT. */
pspec_status ps_pattern_check(const pspec_pattern *pattern, unsigned dimension,
                              pspec_normalization normalization, uint64_t realization,
                              ps_pattern_sums *sums, ps_error *error) PS_MUST_CHECK;

#endif
