/* What the worst-case error of a shading integral needs that does not depend on points: the
 * representer kappa of f -> int f phat in the Sobolev space H^s
 * (docs/mathematics/quadrature.md#representer),
 *
 *     kappa(u) = int K(u,v) phat(v) dS(v) = sum_l a_l b_l Y_l0(u),    kappa_0 = sum_l a_l b_l^2
 */
#ifndef PS_RULES_REPRESENTER_H
#define PS_RULES_REPRESENTER_H

#include "integrands/lobes/brdf.h"

#include <stddef.h>

typedef struct ps_representer {
    double smoothness, constant; /* s, c = K(u,u) */
    size_t max_degree;           /* L: of the arrays and of the series of kappa */
    double *a, *b;               /* [L + 2], [L + 1] */
    double *series;              /* [L + 2]: a_l b_l Y_l0(pole), 0 beyond L */
    double *factors;             /* [L + 2][2]: of the recurrence, l/(l+1) and (2l+1)/(l+1) */
    size_t num_terms; /* of the series of kappa; L + 1, or less where terms are left out */
    /* no odd term but that of degree 1: num_terms even ones, in series and factors of their own */
    bool only_even;
    double first;          /* that of degree 1, for only_even */
    double energy;         /* sum of all b_l^2 */
    double kappa_0, d_0;   /* D_0 = c - kappa_0 */
    double kappa_0_error;  /* a bound on the error of both, rounding aside */
    double kappa_bound;    /* rigorous, on the truncation error of kappa(u) anywhere */
    double kappa_estimate; /* what that error is at most, as measured; a few hundred times less */
} ps_representer;

/* Degrees of a representer: the accuracy of kappa that is asked for decides, up to the limit. */
enum { PS_MOST_REPRESENTER_DEGREE = 20000 };
/* What kappa and kappa_0 are made to when nothing else is asked. */
#define PS_REPRESENTER_TOLERANCE 1e-13

/* Makes *out for s in (1,2) with as many degrees as kappa needs for an error of about tolerance,
 * and at least min_degree. Freed by ps_representer_destroy, also after an error. */
pspec_status ps_representer_create(ps_representer *out, const ps_brdf *brdf, double smoothness,
                                   double tolerance, size_t min_degree,
                                   ps_error *error) PS_MUST_CHECK;
/* Leaves terms out of kappa that cannot matter: odd ones where all above degree 1 are 0, and those
 * behind the last, all together at most `error` (the decay of a smooth lobe). kappa_0 and
 * coefficients stay. */
void ps_representer_skip(ps_representer *representer, double error);
void ps_representer_destroy(ps_representer *representer);

/* PSPEC_ERROR_INVALID_ARGUMENT unless max_degree <= representer->max_degree. */
pspec_status ps_representer_check(const ps_representer *representer, size_t max_degree,
                                  ps_error *error) PS_MUST_CHECK;

/* kappa[j] of unit vectors [num][3]; in several threads where that pays, the same bits in any
 * case. */
void ps_representer_kappa(const ps_representer *representer, size_t num, const double *points,
                          double *kappa);

/* The rest of sum a_l b_l^2 beyond max_degree <= L, and how far off it may be: beyond the arrays it
 * is between 0 and a_{L+1} (energy - sum_{l<=L} b_l^2), where that difference is not mere
 * rounding. */
double ps_representer_rest(const ps_representer *representer, size_t max_degree,
                           double *half_width);

#endif
