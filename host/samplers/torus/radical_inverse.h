/* Van der Corput's radical inverses, for Halton and Hammersley. */
#ifndef PS_SAMPLERS_TORUS_RADICAL_INVERSE_H
#define PS_SAMPLERS_TORUS_RADICAL_INVERSE_H

#include <stdint.h>

/* Indices below this are mirrored exactly: the numerator stays below 13 * 2^48 < 2^53. */
#define PS_RADICAL_INVERSE_LIMIT ((uint64_t)1 << 48)

/* Digits of index in the prime base number i_prime (2, 3, 5, 7, 11, 13), mirrored at the point:
 * whole numbers throughout, one correctly rounded division at the end. */
double ps_radical_inverse(unsigned i_prime, uint64_t index);

#endif
