/* Sums of products of amplitudes that translations multiply by one phase, on the torus: for shifts
 * h of a box |h_i| <= K
 *
 *     Z(h) = sum_k S(k + h) conj S(k),   |k_i| <= K/2, |k_i + h_i| <= K/2, neither of them 0
 *
 * which is the transform of |f|^2, f being what has the coefficients S(k) in the box of half the
 * size: one transform back and one forth. Points that are one in each cell of a grid of n cells an
 * axis are correlated at shifts h_i of n with one sign for -n < k_i < 0 and with the other beyond,
 * and the sum over all k is 0: K = 2n, with products up to n, shows most. */
#ifndef PS_SPECTRA_PHASES_SHIFT_PRODUCTS_H
#define PS_SPECTRA_PHASES_SHIFT_PRODUCTS_H

#include "frequencies/frequencies.h"

typedef struct ps_shift_products ps_shift_products;

/* Points of the grid of the transforms. */
double ps_shift_products_cells(const ps_frequencies *box);

/* For a box that is enumerated and outlives it. */
pspec_status ps_shift_products_create(ps_shift_products **out, const ps_frequencies *box,
                                      ps_error *error) PS_MUST_CHECK;
/* Of the amplitudes [box->num][2] of one set, for the shifts that are those frequencies:
 * out[box->num][2]. */
void ps_shift_products_run(ps_shift_products *products, const double *amplitudes, double *out);
void ps_shift_products_destroy(ps_shift_products *products);

#endif
