/* The numbers among the arguments of nufft/strips.cl, for host and device. */
#ifndef PS_NUFFT_STRIPS_H
#define PS_NUFFT_STRIPS_H

#include "nufft/numbers.h"

typedef struct strips_numbers {
    ps_u64 stride;                /* of rows of powers */
    ps_u64 strip_reals;           /* of a work-group */
    window_numbers across, along; /* of axis 0 and axis 1, with the lengths of their transforms */
    ps_u32 K;                     /* of both */
    ps_u32 columns, pitch;        /* of a strip, and with those behind it */
    ps_u32 num_tiles;
    ps_u32 num_realizations;
    ps_u32 first_row; /* of powers and scales */
} strips_numbers;

SAME_SIZE(strips_numbers, 72);

#endif
