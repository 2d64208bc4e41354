/* Products of packed panels, the inner loop of a Cholesky factor, for the vectors that this
 * processor has.
 *
 * A sum is taken term by term with one rounding each (fma), whatever the width of the vectors: the
 * same bits on every processor that has fma, which are all x86-64 since 2013 and all ARM of 64
 * bits.
 */
#ifndef PS_MATH_LINEAR_TILE_PRODUCT_H
#define PS_MATH_LINEAR_TILE_PRODUCT_H

#include <stddef.h>

/* Rows of a panel and columns of a product: 24 vectors of 512 bits, of the 32 that there are, or
 * four times 12 of the 16 of 256 bits. */
enum { PS_TILE_ROWS = 24, PS_TILE_COLUMNS = 8 };

/* target[j * stride + i] -= sum over k < num of left[k * PS_TILE_ROWS + i] * right[k * PS_TILE_ROWS
 * + j], for i < PS_TILE_ROWS and j < PS_TILE_COLUMNS. What it writes overlaps nothing that it reads
 * but itself. */
typedef void (*ps_tile_product)(size_t num, const double *left, const double *right, double *target,
                                size_t stride);

/* The one for the widest vectors of this processor. */
ps_tile_product ps_tile_product_best(void);

/* All that this processor can run, the widest first: at most PS_TILE_PRODUCTS. Returns how many
 * there are. */
enum { PS_TILE_PRODUCTS = 3 };
size_t ps_tile_products(ps_tile_product products[PS_TILE_PRODUCTS]);

#endif
