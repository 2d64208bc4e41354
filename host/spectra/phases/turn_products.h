/* Sums of products of coefficients that turns about the z axis multiply by one phase, on the
 * sphere: the coefficients of f^2,
 *
 *     h_lm = integral over the sphere of f^2 Y_lm,
 *     f = sum over l = 1 .. L/2 and m of conj(c_lm) Y_lm
 *
 * for l = 0 .. L, by Gauss-Legendre quadrature in z and Fourier transforms along the azimuth, which
 * are exact for them. */
#ifndef PS_SPECTRA_PHASES_TURN_PRODUCTS_H
#define PS_SPECTRA_PHASES_TURN_PRODUCTS_H

#include "base/status.h"

#include <stddef.h>
#include <stdint.h>

typedef struct ps_turn_products ps_turn_products;

/* Products of a node with a function of degree and order, for one set. */
double ps_turn_products_steps(int32_t max_degree);

pspec_status ps_turn_products_create(ps_turn_products **out, int32_t max_degree,
                                     ps_error *error) PS_MUST_CHECK;
/* Sets that share the Legendre functions of a node, which take most of the time for one. */
enum { PS_TURN_SETS = 16 };

/* Of the coefficients of num_sets <= PS_TURN_SETS, one after the other in the layout of
 * ps_engine.coefficients; h_lm in the same. */
void ps_turn_products_run(ps_turn_products *products, size_t num_sets, const double *coefficients,
                          double *out);
void ps_turn_products_destroy(ps_turn_products *products);

#endif
