/* Numbers of windows and transforms in the structs that launches take, for host and device. */
#ifndef PS_NUFFT_NUMBERS_H
#define PS_NUFFT_NUMBERS_H

#include "shared/fixed.h"

/* A window: cells of its axis, its width, the degree and the bins of its polynomials
 * (nufft/window.h). */
typedef struct window_numbers {
    ps_u32 n, width, degree, bins;
} window_numbers;

/* A transform: its length, the largest frequency of which is kept. */
typedef struct transform_numbers {
    ps_u32 n, K;
} transform_numbers;

#endif
