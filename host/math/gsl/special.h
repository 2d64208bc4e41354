/* Special functions on the host, by GSL. */
#ifndef PS_MATH_GSL_SPECIAL_H
#define PS_MATH_GSL_SPECIAL_H

#include <stddef.h>

/* J_{d/2}(z) for d = 1 .. 6 and z >= 0, right to some 1e-16 (1 + z), since the phase is z. */
double ps_bessel_half(unsigned d, double z);
/* The regularised incomplete beta function I_x(a, b), 0 <= x <= 1, a and b positive. */
double ps_beta_regularised(double a, double b, double x);

/* Where degree l and order m from 0 to l of Legendre functions stand; orders of one degree are
 * neighbours. */
size_t ps_legendre_place(size_t degree, size_t order);
/* Numbers that ps_legendre_functions needs room for. */
size_t ps_legendre_room(size_t max_degree);
/* |Y_lm| without its phase for l <= max_degree, by their places; -1 <= z <= 1. */
void ps_legendre_functions(size_t max_degree, double z, double *out);

#endif
