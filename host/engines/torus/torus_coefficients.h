/* S(k) of the only realization of a batch, on the host, from the sums that torus_direct leaves on
 * the device once it has made the powers of them. */
#ifndef PS_ENGINES_TORUS_TORUS_COEFFICIENTS_H
#define PS_ENGINES_TORUS_TORUS_COEFFICIENTS_H

#include "engines/torus/torus_split.h"
#include "engines/torus/torus_sums.h"

typedef struct ps_torus_finished {
    const ps_frequencies *frequencies;
    const ps_split *split; /* NULL: a list */
    const ps_buffer *products;
    const ps_torus_sums *sums;
    ps_precision precision;
    int exponent; /* the weights were divided by 2^exponent */
} ps_torus_finished;

/* out: [number of frequencies][real, imaginary], in their order. */
pspec_status ps_torus_coefficients(const ps_torus_finished *finished, ps_device *device,
                                   double *out, ps_error *error) PS_MUST_CHECK;
/* Bytes of the copies of the sums that it makes. */
double ps_torus_coefficient_bytes(double num_pairs, double num_tiles, double lanes);

#endif
