/* The Gaussian lobe p = e^{n(z-1)} of glossy surfaces, cut at the horizon or not
 * (docs/mathematics/quadrature.md#lobes). */
#define PRECISION 64
#include "integrands/glossy.h"

#include "base/memory.h"
#include "integrands/lobes/lobe.h"

#include <stdlib.h>
#include <string.h>

/* The cut changes coefficients by e^-n: above this more than the paper's figures show. */
static const double CUT_MATTERS = 1e-3;

static double range(const ps_brdf *brdf) {
    return brdf->is_whole_sphere ? 2 : 1;
}

static double norm(const ps_brdf *brdf) {
    return -expm1(-brdf->exponent * range(brdf)) / brdf->exponent;
}

/* n (1 + e^-n)/(4 pi (1 - e^-n)), or (n/4 pi) coth n. */
static double energy(const ps_brdf *brdf) {
    const double n = brdf->exponent;
    const double x = n * range(brdf);
    return n / PS_FOUR_PI * (1 + exp(-x)) / -expm1(-x);
}

static double density(const ps_brdf *brdf, double z) {
    return z < 0 && !brdf->is_whole_sphere ? 0 : exp(brdf->exponent * (z - 1));
}

/* lambda_l(n) = I_{l+1/2}(n)/I_{1/2}(n), l <= max_degree, from the continued fraction of the
 * ratios, downward; relative error 2e-15. */
static void fill_lambda(double n, size_t max_degree, double *lambda) {
    const size_t start =
        max_degree + 40 + (size_t)(6 * sqrt(n)); /* measured: no last place changes beyond */
    const double nu = (double)start + 1.5;
    double ratio = n / (nu - 0.5 + sqrt((nu + 0.5) * (nu + 0.5) + n * n));
    for (size_t l = start; l >= 1; l--) {
        ratio = 1 / ((2 * (double)l + 1) / n + ratio);
        if (l <= max_degree) {
            lambda[l] = ratio;
        }
    }
    lambda[0] = 1;
    for (size_t l = 1; l <= max_degree; l++) {
        lambda[l] *= lambda[l - 1];
    }
}

/* G_0 .. G_X of the cut lobe: the three-term recurrence is unstable both ways, so it is solved as a
 * boundary value problem, by elimination without pivoting (pivots are sums of positive numbers).
 * pivots: [X + 1]. */
static void solve_cut(double n, size_t last, double *g, double *pivots) {
    double legendre = 1; /* P_{l-1}(0) for odd l */
    g[0] = -expm1(-n) / n;
    pivots[0] = 0;
    for (size_t l = 1; l <= last; l++) {
        double right = 0;
        if (l % 2 == 1) {
            const double next = -legendre * (double)l / (double)(l + 1); /* P_{l+1}(0) */
            right = exp(-n) * (legendre - next);
            legendre = next;
        }
        const double factor = l > 1 ? n / pivots[l - 1] : 0;
        pivots[l] = 2 * (double)l + 1 + factor * n;
        g[l] = right + (l > 1 ? factor * g[l - 1] : n * g[0]);
    }
    for (size_t l = last; l >= 1; l--) {
        g[l] = (g[l] - (l < last ? n * g[l + 1] : 0)) / pivots[l];
    }
}

static pspec_status fill_cut(double n, size_t max_degree, double *b, ps_error *error) {
    const size_t last = max_degree + 60 + (size_t)(9 * sqrt(n)); /* measured, as above */
    double *g = NULL;
    PS_TRY(PS_NEW(&g, 2 * (last + 1), "coefficients", error));
    solve_cut(n, last, g, g + last + 1);
    for (size_t l = 0; l <= max_degree; l++) {
        b[l] = ps_zonal_at_pole(l) * (g[l] / g[0]);
    }
    free(g);
    return PSPEC_OK;
}

static pspec_status spherical(const ps_brdf *brdf, size_t max_degree, double *b, ps_error *error) {
    if (!brdf->is_whole_sphere && brdf->exponent < PS_UNCUT_LOBE) {
        return fill_cut(brdf->exponent, max_degree, b, error);
    }
    fill_lambda(brdf->exponent, max_degree, b);
    for (size_t l = 0; l <= max_degree; l++) {
        b[l] *= ps_zonal_at_pole(l);
    }
    return PSPEC_OK;
}

static pspec_status hemispherical(const ps_brdf *brdf, size_t max_degree, double *b,
                                  ps_error *error) {
    (void)error;
    fill_lambda(brdf->exponent / 2, max_degree, b);
    for (size_t l = 0; l <= max_degree; l++) {
        b[l] *= sqrt(2.0) * ps_zonal_at_pole(l);
    }
    return PSPEC_OK;
}

static bool is_below(const ps_brdf *brdf) {
    return brdf->is_whole_sphere;
}

static ps_morph morph(const ps_brdf *brdf) {
    return (ps_morph){brdf->is_whole_sphere ? PS_MORPH_GLOSSY_SPHERE : PS_MORPH_GLOSSY,
                      brdf->exponent};
}

static const char *note(const ps_brdf *brdf) {
    if (exp(-brdf->exponent) < CUT_MATTERS) {
        return NULL;
    }
    return brdf->is_whole_sphere
               ? "the lobe is so wide that a part of it is below the horizon; cut=horizon cuts it "
                 "there"
               : "the lobe is so wide that its cut at the horizon matters; cut=none keeps the part "
                 "below";
}

static pspec_status create(ps_brdf *brdf, const char *const *values, ps_error *error) {
    const bool is_cut = strcmp(values[1], "horizon") == 0;
    if (!is_cut && strcmp(values[1], "none") != 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "BRDF glossy: cut=%s is not one of horizon, none", values[1]);
    }
    brdf->is_whole_sphere = !is_cut;
    return ps_brdf_read_exponent(brdf, values[0], error);
}

/* ---- as an integrand ----------------------------------------------------------------------- */

static void fill(ps_integrand *self) {
    const double nowhere = -2; /* below every z */
    const ps_brdf *const brdf = self->own;
    double *const numbers = self->numbers;
    numbers[LOBE_AXIS + 2] = 1;
    numbers[LOBE_RATE] = brdf->exponent / 2;
    numbers[GLOSSY_SCALE] = 1 / (PS_TWO_PI * norm(brdf));
    numbers[GLOSSY_LEAST] = brdf->is_whole_sphere ? nowhere : 0;
}

static double correlation(const ps_integrand *self, const double *x) {
    const ps_brdf *const brdf = self->own;
    const double scale = self->numbers[GLOSSY_SCALE];
    return brdf->is_whole_sphere
               ? scale * scale * ps_integrand_lobe_correlation(brdf->exponent, x[0])
               : NAN;
}

static double reach(const ps_integrand *self) {
    const ps_brdf *const brdf = self->own;
    const bool is_whole = brdf->is_whole_sphere || brdf->exponent >= PS_UNCUT_LOBE;
    return is_whole ? ps_integrand_lobe_reach(brdf->exponent) : INFINITY;
}

PS_INTEGRAND_VALUES(glossy_value)

static const ps_lobe lobe = {
    .create = create,
    .norm = norm,
    .energy = energy,
    .density = density,
    .spherical = spherical,
    .hemispherical = hemispherical,
    .is_below = is_below,
    .morph = morph,
    .note = note,
    .fill = fill,
};

const ps_integrand_kind ps_integrand_glossy = {
    .name = "glossy",
    .summary = "e^{n(z-1)}, a Gaussian lobe",
    .parameters = {{"n", "", "exponent, 0.001 to 1e6; must be given"},
                   {"cut", "horizon",
                    "horizon|none: 0 below the horizon, or the lobe on the whole sphere"}},
    PS_LOBE_ROW,
    .lobe = &lobe,
    .kernel = "glossy",
    .values = values,
    .correlation = correlation,
    .reach = reach,
};
