/* Lobes of reflection p(z) around an axis, z the cosine to it, as weights of shading integrals:
 * their zonal coefficients in spherical and hemispherical harmonics
 * (docs/mathematics/quadrature.md#lobes). Each is an integrand, too (integrands/lobes/lobe.h).
 *
 *     phat = p/(2 pi r_s),  r_s = int p dz,   b_l = int phat Y_l0 dS,   b_0 = 1/(2 sqrt pi) for all of them
 */
#ifndef PS_INTEGRANDS_LOBES_BRDF_H
#define PS_INTEGRANDS_LOBES_BRDF_H

#include "base/status.h"
#include "math/morph.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct ps_brdf ps_brdf;

/* Parses "NAME[:key=value,...]"; *out is freed by ps_brdf_destroy. Exponents n <= 0, files that
 * hold no lobe and the like are errors with a sentence. */
pspec_status ps_brdf_parse(ps_brdf **out, const char *text, ps_error *error) PS_MUST_CHECK;
void ps_brdf_destroy(ps_brdf *brdf); /* NULL is allowed */

/* r_s, and int phat^2 dS = sum b_l^2 = sum b~_l^2. */
double ps_brdf_norm(const ps_brdf *brdf);
double ps_brdf_energy(const ps_brdf *brdf);
/* phat(z) in 1/sr. */
double ps_brdf_density(const ps_brdf *brdf, double z);

/* b_0 .. b_max_degree. Relative error 3e-12, or absolute 1e-17 for glossy lobes with n >= 40. */
pspec_status ps_brdf_spherical(const ps_brdf *brdf, size_t max_degree, double *b,
                               ps_error *error) PS_MUST_CHECK;
/* b~_0 .. b~_max_degree, of hemispherical harmonics sqrt((2l+1)/(2 pi)) P_l(2z-1). Lobes that go
 * below the horizon are refused. */
pspec_status ps_brdf_hemispherical(const ps_brdf *brdf, size_t max_degree, double *b,
                                   ps_error *error) PS_MUST_CHECK;

bool ps_brdf_is_below_horizon(const ps_brdf *brdf);
/* True, and D_0, where it is known in closed form. */
bool ps_brdf_mean_distance(const ps_brdf *brdf, double smoothness, double *d_0);
/* How points of equal areas of the hemisphere get the density of the lobe; PS_MORPH_NONE where that
 * is not known. */
ps_morph ps_brdf_morph(const ps_brdf *brdf);
/* NULL when there is nothing to say. Static storage. */
const char *ps_brdf_note(const ps_brdf *brdf);

#endif
