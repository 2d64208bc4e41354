/* Van der Corput's radical inverses, for Halton and Hammersley. Needs doubles.
 */
#ifndef PS_SAMPLERS_RADICAL_INVERSE_H
#define PS_SAMPLERS_RADICAL_INVERSE_H

#include "samplers/numbers.h"
#include "shared/fixed_point.h"

static inline double radical_mirror(const ps_u64 base, ps_u64 index) {
    ps_u64 numerator = 0;
    ps_u64 denominator = 1;
    for (; index > 0; index /= base) {
        numerator = numerator * base + index % base;
        denominator *= base;
    }
    return (double)numerator / (double)denominator;
}

/* Indices below this are mirrored exactly: the numerator stays below 13 * 2^48 < 2^53. */
#define RADICAL_INVERSE_LIMIT ((ps_u64)1 << 48)

/* Digits of an index below it in the prime base number i_prime (2, 3, 5, 7, 11, 13), mirrored at
 * the point: whole numbers throughout, one correctly rounded division at the end. */
static inline double radical_inverse(const ps_u32 i_prime, const ps_u64 index) {
    /* Not a table of bases: a base known to the compiler turns divisions into multiplications. */
    switch (i_prime) {
    case 0:
        return radical_mirror(2, index);
    case 1:
        return radical_mirror(3, index);
    case 2:
        return radical_mirror(5, index);
    case 3:
        return radical_mirror(7, index);
    case 4:
        return radical_mirror(11, index);
    default:
        return radical_mirror(13, index);
    }
}

SAMPLER_INLINE void halton_places(const sampler_numbers *of, SAMPLER_TABLE table,
                                  const ps_u32 dimension, const ps_u64 realization, const ps_u64 j,
                                  ps_u64 *places) {
    (void)table;
    (void)realization;
    SAMPLER_FOR(ps_u32 i = 0; i < dimension; i++) {
        places[i] = fixed_point(radical_inverse(i, of->start + j));
    }
}

SAMPLER_INLINE void hammersley_places(const sampler_numbers *of, SAMPLER_TABLE table,
                                      const ps_u32 dimension, const ps_u64 realization,
                                      const ps_u64 j, ps_u64 *places) {
    (void)table;
    (void)realization;
    places[0] = fixed_point((double)j / (double)of->num_points);
    SAMPLER_FOR(ps_u32 i = 1; i < dimension; i++) {
        places[i] = fixed_point(radical_inverse(i - 1, j));
    }
}

#endif
