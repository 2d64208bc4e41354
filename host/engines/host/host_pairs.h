/* The referee of pair sums: Legendre sums over pairs in long double. host_degree has the same sums
 * from coefficients, by formulas that share no step; it takes L times longer at high degrees of few
 * points. */
#ifndef PS_ENGINES_HOST_HOST_PAIRS_H
#define PS_ENGINES_HOST_HOST_PAIRS_H

#include "engines/engine.h"

/* sums[l] = sum_ij w_i w_j P_l(u_i.u_j), l = 0 .. max_degree, of the directions of the points and
 * weights w 2^-exponent, in the difference form of docs/mathematics/numerics.md#legendre-sums. */
pspec_status ps_host_pairs(const pspec_pattern *pattern, int exponent, int32_t max_degree,
                           long double *sums, ps_error *error) PS_MUST_CHECK;

/* sum over i != j of w_i w_j |u_i - u_j|^(2 power), power > 0; equal points have distance 0. */
pspec_status ps_host_chords(const pspec_pattern *pattern, int exponent, double power,
                            long double *sum, ps_error *error) PS_MUST_CHECK;

#endif
