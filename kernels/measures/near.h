/* What host and device know alike of measures/near.cl. */
#ifndef PS_MEASURES_NEAR_H
#define PS_MEASURES_NEAR_H

#include "shared/fixed.h"

/* Points of a work-item. Fixed: sums depend on it. */
#define NEAR_BLOCK 64
/* Bins of distances, and windows, of equal steps up to the reach. */
#define NEAR_BINS 200
#define NEAR_WINDOWS 16
#define NEAR_COUNTS (NEAR_BINS + 16) /* a lane each for what is farther */
/* Cells that the reach has: with two, runs that end with the reach have 5.4 squares of the reach in
 * the plane instead of 9; from four dimensions on there would be more runs than points. */
#define NEAR_SPAN(dimension) ((dimension) < 4 ? 2 : 1)

typedef struct near_sizes {
    ps_u64 num_points;
    ps_u64 capacity; /* numbers of an axis, a vector more than there are points */
    ps_u64 side;     /* cells along an axis; 1: one cell has all points */
} near_sizes;

SAME_SIZE(near_sizes, 24);

#if !defined __OPENCL_C_VERSION__ || PRECISION == 64
typedef struct near_lengths {
    double first;       /* where cells begin, on every axis */
    double cells, bins; /* of a unit of length: NEAR_SPAN cells are the reach or more */
    double per_diameter[NEAR_WINDOWS]; /* 1 / (2 R), R the radius of a window, the smallest first */
} near_lengths;

SAME_SIZE(near_lengths, 152);
#endif

#endif
