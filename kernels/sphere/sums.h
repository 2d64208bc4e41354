/* The numbers among the arguments of sums.cl, for host and device. */
#ifndef PS_SPHERE_SUMS_H
#define PS_SPHERE_SUMS_H

#include "shared/fixed.h"

typedef struct sums_numbers {
    ps_u64 stride;   /* of rows of sums */
    ps_u64 capacity; /* of the arrays in values */
    ps_u32 first_order, num_orders;
    ps_u32 max_degree;
    ps_u32 has_low;  /* sums have low parts, which realizations of several chunks need */
    ps_u32 is_first; /* sums begin anew; else they are added to */
    ps_u32 unused;   /* fills the size up to whole numbers of eight bytes */
} sums_numbers;

SAME_SIZE(sums_numbers, 40);

#endif
