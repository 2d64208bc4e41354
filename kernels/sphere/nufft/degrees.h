/* c_lm of a realization side by side, as GPUs sum them (degrees.cl), for host and device. */
#ifndef PS_SPHERE_NUFFT_DEGREES_H
#define PS_SPHERE_NUFFT_DEGREES_H

#include "shared/fixed.h"

/* Degrees of which Lambda_lm is in local memory at a time. */
enum { DEGREES_OF_RUN = 32 };

/* The number of c_lm up to degree L of the orders below m. */
static inline ps_u64 coefficients_of(const ps_u32 L, const ps_u32 m) {
    return (ps_u64)m * (2 * (ps_u64)L + 3 - m) / 2;
}

#endif
