/* Normalised associated Legendre functions on the host, by GSL. */
#ifndef PS_MATH_GSL_LEGENDRE_H
#define PS_MATH_GSL_LEGENDRE_H

#include <stddef.h>

/* Where degree l and order m from 0 to l stand; orders of one degree are neighbours. */
size_t ps_legendre_place(size_t degree, size_t order);
/* Numbers that ps_legendre_functions needs room for. */
size_t ps_legendre_room(size_t max_degree);
/* |Y_lm| without its phase for l <= max_degree, by their places; -1 <= z <= 1. */
void ps_legendre_functions(size_t max_degree, double z, double *out);

#endif
