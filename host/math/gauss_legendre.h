/* Gauss-Legendre quadrature. GSL's own tables want memory, and end the program without it. */
#ifndef PS_MATH_GAUSS_LEGENDRE_H
#define PS_MATH_GAUSS_LEGENDRE_H

#include <stddef.h>

/* The rule with num >= 1 nodes on [0,1], exact for polynomials of degree 2 num - 1: nodes [num] in
 * rising order and weights [num], whose sum is 1, right to the last places. Takes about num^2
 * steps. */
void ps_gauss_legendre(size_t num, double *nodes, double *weights);

#endif
