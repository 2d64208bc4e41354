/* The worst-case error of a quadrature rule for a shading integral over the unit ball of the
 * Sobolev space H^s, in its kernel form and in its spectral form
 * (docs/mathematics/quadrature.md#worst-case-error, docs/mathematics/quadrature.md#spectral-form):
 *
 *     E^2 = c (W-1)^2 - sum_ij w_i w_j |u_i-u_j|^(2s-2) + 2 sum_j w_j D(u_j) - D_0                              (Q2)
 *     E^2 = sum_l a_l (d_l^2 + C_l^2),   d_l = b_l - c_l0,   C_l^2 = 2 sum_{m=1..l} |c_lm|^2
 */
#ifndef PS_RULES_WORST_CASE_ERROR_H
#define PS_RULES_WORST_CASE_ERROR_H

#include "base/watch.h"
#include "rules/representer.h"

/* Unit vectors [num_points][3] and their weights; weights NULL: 1/N each. Borrowed. */
typedef struct ps_rule {
    size_t num_points;
    const double *points, *weights;
} ps_rule;

/* W = sum w, sum |w| and V = sum w^2; 1, 1 and 1/N for equal weights. */
typedef struct ps_weight_sums {
    double sum, size, square;
} ps_weight_sums;

ps_weight_sums ps_rule_weight_sums(const ps_rule *rule);

typedef struct ps_kernel_error {
    double squared;  /* E^2; where it is below its bound, rounding may make it negative */
    double bound;    /* on the error of E^2: rounding and the representer's estimate */
    double distance; /* sum_ij w_i w_j |u_i-u_j|^(2s-2) */
    double kappa;    /* sum_j w_j kappa(u_j) */
} ps_kernel_error;

/* sum_ij w_i w_j |u_i-u_j|^(2s-2), compensated, over fixed blocks that are merged in a fixed order:
 * the same bits on any number of threads. O(N^2) up to PS_DISTANCE_MOST_WHOLE points, then O(N) by
 * rules/distance_split.h, but for points most of which are in one place. watch: told how far it is;
 * NULL: nobody. */
pspec_status ps_rule_distance(const ps_rule *rule, double smoothness, const ps_watch *watch,
                              double *sum, ps_error *error) PS_MUST_CHECK;

/* (Q2). kappa: of the points, [num_points], and distance: the sum of ps_rule_distance; NULL to have
 * it made here. */
pspec_status ps_kernel_error_of(const ps_representer *representer, const ps_rule *rule,
                                const double *kappa, const double *distance, const ps_watch *watch,
                                ps_kernel_error *out, ps_error *error) PS_MUST_CHECK;

/* One degree of the spectral form. */
typedef struct ps_degree_error {
    double b, d2, c2, a, e2;
} ps_degree_error;

/* E^2 in its parts up to degree L, and what is beyond. */
typedef struct ps_spectral_error {
    double zonal, anisotropic; /* E_Z^2 and E_A^2: sums over l <= L */
    /* What independent points of the lobe's density have beyond L in the mean: V (tau_L - r_L) +
     * (1-W)^2 r_L, where r_L is the rest of sum a_l b_l^2; for their c_lm have the mean W b_l and
     * the variance V ((2l+1)/(4 pi) - b_l^2), summed over m. */
    double tail_model;
    double tail_bound; /* rigorous: ((sum|w|) sqrt(tau_L) + sqrt(r_L))^2 */
} ps_spectral_error;

/* c_l0 and C_l^2 for l = 0 .. max_degree (c2[0] is ignored: C_0 = 0); degrees [max_degree + 1] or
 * NULL. More degrees than the representer has are an error. */
pspec_status ps_spectral_error_of(const ps_representer *representer, size_t max_degree,
                                  const double *c_l0, const double *c2,
                                  const ps_weight_sums *weights, ps_degree_error *degrees,
                                  ps_spectral_error *out, ps_error *error) PS_MUST_CHECK;

#endif
