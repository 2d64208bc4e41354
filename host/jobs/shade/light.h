/* Light that shading integrals are taken of: a function F of the sphere by its coefficients, and
 * its integrals with a lobe about any direction r (docs/mathematics/quadrature.md#shading):
 *
 *     I(r) = int F(u) phat(u.r) dS = sum_lm b_l sqrt(4 pi/(2l+1)) F_lm Y_lm(r)
 */
#ifndef PS_JOBS_SHADE_LIGHT_H
#define PS_JOBS_SHADE_LIGHT_H

#include "integrands/lobes/brdf.h"
#include "integrands/integrand.h"

typedef struct ps_sphere_series ps_sphere_series; /* integrands/files/series.h */

typedef struct ps_light {
    ps_integrand *integrand; /* of those that were made */
    ps_made_integrands own;  /* where no others are shared */
    size_t max_degree;
    double *powers;            /* [max_degree + 1]: sum_m |F_lm|^2/(2l+1) */
    ps_sphere_series *shading; /* I(r) up to max_degree */
    double shading_bound;      /* what is beyond is no larger anywhere: rigorous */
} ps_light;

/* Of an integrand of the sphere whose coefficients are known: all of them, or up to degree 256.
 * Others are PSPEC_ERROR_INVALID_ARGUMENT. made: integrands that questions share, and the text
 * outlives these; NULL: none. *out is freed by ps_light_free, also after an error. */
pspec_status ps_light_make(ps_light *out, const char *integrand, ps_made_integrands *made,
                           const ps_brdf *brdf, ps_error *error) PS_MUST_CHECK;
void ps_light_free(ps_light *light);

/* I(r) */
double ps_light_shading(const ps_light *light, const double *r);
/* sum_lm |F_lm|^2 beyond a degree, which is at most the largest. */
double ps_light_beyond(const ps_light *light, size_t max_degree);

#endif
