/* The grid of GPUs: what kernels/nufft/grid/ agrees on with the host. Axes are numbered as the
 * last ones of three; those that a problem does not have are one cell long. */
#ifndef PS_NUFFT_GRID_GRID_H
#define PS_NUFFT_GRID_GRID_H

#include "nufft/numbers.h"

#define GRID_AXES 3

/* Points whose windows are made together for one copy of a box, and added in order. */
#define GRID_RUN 32

typedef struct grid_spread_numbers {
    window_numbers windows[GRID_AXES];
    ps_u32 flush;    /* points of a box after which sums go into pairs: whole chunks */
    ps_u32 has_sums; /* boxes have something before */
} grid_spread_numbers;

typedef struct grid_lines_numbers {
    ps_u64 lines;                  /* of a set */
    ps_u64 inner;                  /* neighbours: numbers of a line are so far apart */
    ps_u64 from_stride, to_stride; /* numbers of a set */
    /* Line (outer, inner) has frequencies outer mod `apart` + apart q of n, up to K either way */
    ps_u32 apart, n, K;
    ps_u32 boxes[GRID_AXES];
    ps_u32 first_row;  /* of powers and scales */
    ps_u32 neighbours; /* of a line that is turned: those of the axis that it is part of */
} grid_lines_numbers;

SAME_SIZE(grid_spread_numbers, 56);
SAME_SIZE(grid_lines_numbers, 64);

#endif
