/* Sums of products of amplitudes that translations multiply by one phase, on the torus: those of
 * shift_families.h. Such a family is the transform of |f|^2, f being what has the coefficients
 * S'(k): one transform back and one forth, of two sets at a time, for f is real. */
#ifndef PS_SPECTRA_PHASES_SHIFT_PRODUCTS_H
#define PS_SPECTRA_PHASES_SHIFT_PRODUCTS_H

#include "spectra/phases/shift_families.h"

typedef struct ps_shift_products ps_shift_products;

/* Sets that are transformed together: one is the real part, one the imaginary. */
enum { PS_SHIFT_SETS = 2 };

/* Numbers of grids that a set takes, for boxes that need not be enumerated. */
double ps_shift_products_cells(const ps_frequencies *box);

/* For a box that is enumerated and outlives it. */
pspec_status ps_shift_products_create(ps_shift_products **out, const ps_frequencies *box,
                                      ps_error *error) PS_MUST_CHECK;
const ps_shift_family *ps_shift_products_families(const ps_shift_products *products, size_t *num);
/* Of 1 or 2 sets; set r has its amplitudes [box->num][2] at amplitudes + r * stride.
 * out[num_sets][ps_shift_families_sums][2]; norms[families]: the root of the sum of |S'(k)|^2 of
 * all that was transformed together, to which rounding is relative. */
void ps_shift_products_run(ps_shift_products *products, size_t num_sets, const double *amplitudes,
                           size_t stride, double *out, double *norms);
void ps_shift_products_destroy(ps_shift_products *products);

#endif
