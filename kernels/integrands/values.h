/* What host and device know alike of integrands/values.cl. */
#ifndef PS_INTEGRANDS_VALUES_H
#define PS_INTEGRANDS_VALUES_H

#include "shared/fixed.h"

/* Points of a piece, a multiple of every number of lanes. Fixed: sums depend on it. Their
 * coordinates stay in the nearest cache of a core for all trials of a set. */
#define VALUES_PIECE 1024

/* Some vectors of points of one set. */
typedef struct values_piece {
    ps_u64 first; /* vector */
    ps_u32 num_vectors, set;
} values_piece;

SAME_SIZE(values_piece, 16);

typedef struct values_sizes {
    ps_u64 capacity; /* numbers of an axis */
    ps_u64 num_trials;
} values_sizes;

SAME_SIZE(values_sizes, 16);

/* The numbers of an integrand, in either precision: NAME.h says which is which. */
typedef struct values_singles {
    float numbers[16];
} values_singles;

SAME_SIZE(values_singles, 64);

#if !defined __OPENCL_C_VERSION__ || PRECISION == 64
typedef struct values_doubles {
    double numbers[16];
} values_doubles;

SAME_SIZE(values_doubles, 128);
#endif

#endif
