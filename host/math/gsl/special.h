/* Special functions on the host, by GSL. */
#ifndef PS_MATH_GSL_SPECIAL_H
#define PS_MATH_GSL_SPECIAL_H

/* J_{d/2}(z) for d = 1 .. 6 and z >= 0, right to some 1e-16 (1 + z), since the phase is z. */
double ps_bessel_half(unsigned d, double z);
/* The regularised incomplete beta function I_x(a, b), 0 <= x <= 1, a and b positive. */
double ps_beta_regularised(double a, double b, double x);

#endif
