/* Lobes of reflection p(z) around an axis, z the cosine to it, as weights of shading integrals:
 * their zonal coefficients in spherical and hemispherical harmonics
 * (docs/mathematics/quadrature.md#lobes). One file per lobe, one table.
 *
 *     phat = p/(2 pi r_s),  r_s = int p dz,   b_l = int phat Y_l0 dS,   b_0 = 1/(2 sqrt pi) for all of them
 */
#ifndef PS_INTEGRANDS_BRDF_H
#define PS_INTEGRANDS_BRDF_H

#include "base/grammar.h"
#include "math/morph.h"

#include <stdbool.h>

enum { PS_MAX_BRDF_PARAMETERS = 2 };

typedef struct ps_brdf ps_brdf;

/* What the lobes of one name have in common. Members may be NULL where it says so. */
typedef struct ps_brdf_kind {
    const char *name;
    const char *summary; /* one line, for help */
    /* ended by key NULL; default "": must be given */
    ps_parameter parameters[PS_MAX_BRDF_PARAMETERS + 1];
    /* Reads values[i] of parameters[i] and checks them. NULL: nothing to read. */
    pspec_status (*create)(ps_brdf *, const char *const *values, ps_error *);
    double (*norm)(const ps_brdf *);              /* r_s */
    double (*energy)(const ps_brdf *);            /* sum b_l^2 = int phat^2 dS */
    double (*density)(const ps_brdf *, double z); /* p(z) */
    /* b_0 .. b_L; and b~_0 .. b~_L, NULL where the lobe goes below the horizon. */
    pspec_status (*spherical)(const ps_brdf *, size_t max_degree, double *b, ps_error *);
    pspec_status (*hemispherical)(const ps_brdf *, size_t max_degree, double *b, ps_error *);
    bool (*is_below)(const ps_brdf *); /* has it a part below the horizon? NULL: never */
    /* D_0 = int int |u-v|^(2s-2) phat phat in closed form. NULL: not known. */
    double (*mean_distance)(const ps_brdf *, double smoothness);
    ps_morph (*morph)(const ps_brdf *);   /* that gives points its density; NULL: none known */
    const char *(*note)(const ps_brdf *); /* what a result should say of it, or NULL; may be NULL */
} ps_brdf_kind;

/* All lobes, ended by NULL. */
extern const ps_brdf_kind *const ps_brdf_kinds[];

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
