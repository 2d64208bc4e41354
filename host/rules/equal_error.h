/* How many points of a good rule have the error of a truncated product: N with E_SF(N) = E(L), E_SF
 * the worst-case error of equal-weight spherical Fibonacci points of the hemisphere morphed to the
 * lobe (docs/mathematics/quadrature.md#truncation). */
#ifndef PS_RULES_EQUAL_ERROR_H
#define PS_RULES_EQUAL_ERROR_H

#include "rules/representer.h"

/* 2^0 .. 2^15 points are the ladder; the last rung takes 5e8 pairs. */
enum { PS_EQUAL_ERROR_RUNGS = 16, PS_EQUAL_ERROR_MOST = 1 << (PS_EQUAL_ERROR_RUNGS - 1) };

/* Begins as {.representer = .., .morph = ..}; remembers the errors of its ladder. */
typedef struct ps_equal_error {
    const ps_representer *representer;
    ps_morph morph;
    double ladder[PS_EQUAL_ERROR_RUNGS]; /* E_SF(2^i), 0 until it is known */
} ps_equal_error;

/* E_SF(num_points). */
pspec_status ps_fibonacci_error(const ps_representer *representer, const ps_morph *morph,
                                size_t num_points, double *out, ps_error *error) PS_MUST_CHECK;

/* The smallest N of the ladder with E_SF(N) <= target, made finer by interpolation of the
 * logarithms; nan where more than PS_EQUAL_ERROR_MOST points are needed, and 1 where one is
 * enough. */
pspec_status ps_equal_error_points(ps_equal_error *equal_error, double target, double *num_points,
                                   ps_error *error) PS_MUST_CHECK;

#endif
