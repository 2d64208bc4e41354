/* Constants of the recurrence over degrees, for kernels/sphere/legendre.h. */
#ifndef PS_ENGINES_SPHERE_SPHERE_TABLE_H
#define PS_ENGINES_SPHERE_SPHERE_TABLE_H

#include <stddef.h>
#include <stdint.h>

enum { PS_SPHERE_DEGREES = 8, PS_SPHERE_BLOCK_REALS = 32 };

/* Blocks of degrees m .. max_degree. */
size_t ps_sphere_blocks(int32_t max_degree, int32_t m);
/* Blocks of all orders first .. first + num - 1; offsets[i] (NULL allowed) is where those of order
 * first + i begin. */
size_t ps_sphere_all_blocks(int32_t max_degree, int32_t first, size_t num, uint32_t *offsets);

/* (-1)^m sqrt((2m + 1)!! / (2m)!! / (4 pi)): Y_mm = that sin^m(theta) e^{i m phi}. One after the
 * other from constant = 1 / sqrt(4 pi) at m = 0. */
long double ps_sphere_next_constant(long double constant, int32_t m);

/* The blocks of an order, PS_SPHERE_BLOCK_REALS numbers each. */
void ps_sphere_fill_order(double *blocks, int32_t max_degree, int32_t m, long double constant);

#endif
