/* Powers of many numbers side by side: those of libm come one at a time. */
#ifndef PS_MATH_POWERS_H
#define PS_MATH_POWERS_H

/* So many at a time. */
enum { PS_POWERS = 128 };

/* values[i] becomes values[i]^exponent for 0 <= values[i] <= 4 and 0 < exponent < 1. Numbers below
 * the smallest normal one become 0. The error is below 1e-15 (tests/math/test_sobolev.c), and the
 * same bits come from any processor. */
void ps_powers(double exponent, double values[PS_POWERS]);

#endif
