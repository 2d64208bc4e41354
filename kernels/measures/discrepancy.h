/* What host and device know alike of measures/discrepancy.cl. */
#ifndef PS_MEASURES_DISCREPANCY_H
#define PS_MEASURES_DISCREPANCY_H

#include "shared/fixed.h"

/* Terms of a plain sum: their rounding is some 1e-16 of the sum of each. */
#define DISCREPANCY_RUN 64

typedef struct discrepancy_sizes {
    ps_u64 num_points;
    ps_u64 capacity; /* numbers of an axis: whole vectors */
} discrepancy_sizes;

SAME_SIZE(discrepancy_sizes, 16);

#endif
