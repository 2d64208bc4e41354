/* The discrete Fourier transform of a short line on the host, by GSL. */
#ifndef PS_MATH_GSL_FOURIER_H
#define PS_MATH_GSL_FOURIER_H

#include "base/status.h"

#include <stddef.h>

/* numbers[num][2], num a power of two: every number becomes sum_j numbers[j] exp(sign 2 pi i j k /
 * num), in place; sign is 1 or -1. */
void ps_fourier(double *numbers, size_t num, int sign);
/* The same, with sign -1, of lines of any length num, which stand one behind the other. */
pspec_status ps_fourier_lines(double *numbers, size_t num, size_t num_lines,
                              ps_error *error) PS_MUST_CHECK;

#endif
