/* host_direct: the referee. Direct sums in long double on the host, phases exact, no device; and
 * the referees of degrees and of pairs. */
#ifndef PS_ENGINES_HOST_HOST_DIRECT_H
#define PS_ENGINES_HOST_HOST_DIRECT_H

#include "engines/engine.h"

/* S(k) = sum w exp(-2 pi i k.x) of one pattern and one frequency. */
void ps_host_sum(const pspec_pattern *pattern, const int32_t *k, long double *re, long double *im);

/* |S|^2 of frequency i of the set, or Q(l) of its degree i, of one pattern with weights w
 * 2^-exponent. */
pspec_status ps_host_power(const pspec_pattern *pattern, const ps_frequencies *set, size_t i,
                           int exponent, long double *power, ps_error *error) PS_MUST_CHECK;

/* The referee on the sphere: spherical-harmonic coefficients of one degree in long double. */

/* Room and constants for one degree; any number of patterns. */
typedef struct ps_host_degree {
    int32_t degree;
    long double *up, *down; /* [degree + 1] of the recurrence over orders */
    long double *values;    /* [degree + 1] Lambda_lm of a point */
    long double (*sums)[2]; /* [degree + 1] c_lm, m >= 0: real and imaginary parts */
} ps_host_degree;

pspec_status ps_host_degree_create(ps_host_degree *out, int32_t degree,
                                   ps_error *error) PS_MUST_CHECK;
void ps_host_degree_free(ps_host_degree *self);

/* sums[m] = c_lm = sum w Y_lm(u) of one pattern
 * (docs/mathematics/sphere.md#coefficients-and-power). */
void ps_host_degree_sum(ps_host_degree *self, const pspec_pattern *pattern);

/* Q(l) = (4 pi / (2l + 1)) sum_m |c_lm|^2 of what was summed last. */
long double ps_host_degree_power(const ps_host_degree *self);

/* The referee of pair sums: Legendre sums over pairs in long double. host_degree has the same sums
 * from coefficients, by formulas that share no step; it takes L times longer at high degrees of few
 * points. */

/* sums[l] = sum_ij w_i w_j P_l(u_i.u_j), l = 0 .. max_degree, of the directions of the points and
 * weights w 2^-exponent, in the difference form of docs/mathematics/numerics.md#legendre-sums. */
pspec_status ps_host_pairs(const pspec_pattern *pattern, int exponent, int32_t max_degree,
                           long double *sums, ps_error *error) PS_MUST_CHECK;

/* sum over i != j of w_i w_j |u_i - u_j|^(2 power), power > 0; equal points have distance 0. */
pspec_status ps_host_chords(const pspec_pattern *pattern, double power, long double *sum,
                            ps_error *error) PS_MUST_CHECK;

#endif
