/* The numbers among the arguments of nufft/whole.cl, for host and device. */
#ifndef PS_NUFFT_WHOLE_H
#define PS_NUFFT_WHOLE_H

#include "nufft/numbers.h"

typedef struct whole_numbers {
    ps_u64 stride;                /* of rows of powers */
    ps_u64 grid_reals, row_reals; /* of a work-group */
    window_numbers across, along; /* of axis 0 and axis 1; in one dimension the width across is 1 */
    transform_numbers first, second; /* one behind the other */
    ps_u32 dimension, num_realizations;
    ps_u32 first_row; /* of powers and scales */
    ps_u32 num_tiles;
    ps_u32 pitch, grid_rows; /* of a grid in memory */
    /* Lanes of the last tile, of each realization (nufft/shared_tile.h); 0: it is as the others */
    ps_u32 shared_lanes;
    ps_u32 unused; /* fills the size up to whole numbers of eight bytes */
} whole_numbers;

SAME_SIZE(whole_numbers, 104);

#endif
