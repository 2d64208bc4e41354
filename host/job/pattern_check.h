/* Checks and sums of one pattern, before anything is computed from it. */
#ifndef PS_JOB_PATTERN_CHECK_H
#define PS_JOB_PATTERN_CHECK_H

#include "base/status.h"

typedef struct ps_pattern_sums {
    double weight_sum;        /* W */
    double weight_square_sum; /* V */
} ps_pattern_sums;

/* realization counts from 0 and is only for messages. W = 0 under the default normalization is
 * PSPEC_ERROR_INPUT. */
pspec_status ps_pattern_check(const pspec_pattern *pattern, unsigned dimension,
                              pspec_normalization normalization, uint64_t realization,
                              ps_pattern_sums *sums, ps_error *error) PS_MUST_CHECK;

#endif
