/* The diffuse lobe p = max(0, z): a matt surface. */
#define PRECISION 64
#include "integrands/diffuse.h"

#include "integrands/lobes/lobe.h"

static double norm(const ps_brdf *brdf) {
    (void)brdf;
    return 0.5;
}

static double energy(const ps_brdf *brdf) {
    (void)brdf;
    return 2 / (3 * PS_PI);
}

static double density(const ps_brdf *brdf, double z) {
    (void)brdf;
    return fmax(z, 0);
}

/* Odd degrees above 1 are 0; g = binom(l, l/2)/2^l of even ones by its recurrence, which cannot
 * overflow. */
static pspec_status spherical(const ps_brdf *brdf, size_t max_degree, double *b, ps_error *error) {
    (void)brdf, (void)error;
    double g = 0.5; /* of l = 2 */
    for (size_t l = 0; l <= max_degree; l++) {
        const double degree = (double)l;
        b[l] = l == 0 ? ps_zonal_at_pole(0) : l == 1 ? 1 / sqrt(3 * PS_PI) : 0;
        if (l >= 2 && l % 2 == 0) {
            const double size = sqrt((2 * degree + 1) / PS_PI) * g / ((degree - 1) * (degree + 2));
            b[l] = l % 4 == 0 ? -size : size;
            g *= (degree + 1) / (degree + 2);
        }
    }
    return PSPEC_OK;
}

/* z = (1 + (2z - 1))/2: two degrees are all. */
static pspec_status hemispherical(const ps_brdf *brdf, size_t max_degree, double *b,
                                  ps_error *error) {
    (void)brdf, (void)error;
    for (size_t l = 0; l <= max_degree; l++) {
        b[l] = l == 0 ? 1 / sqrt(PS_TWO_PI) : l == 1 ? 1 / sqrt(6 * PS_PI) : 0;
    }
    return PSPEC_OK;
}

/* (sqrt(pi)/2) Gamma((q+1)/2)/Gamma(q/2+1) = int_0^{pi/2} sin^q */
static double wallis(double q) {
    return sqrt(PS_PI) / 2 * tgamma((q + 1) / 2) / tgamma(q / 2 + 1);
}

static double mean_distance(const ps_brdf *brdf, double s) {
    (void)brdf;
    const double low = wallis(2 * s);
    const double high = wallis(2 * s + 2);
    return 4 / (3 * PS_PI) * exp2(2 * s - 1) *
           (4 * (low - high) + 2 / s * low - 4 / (s + 1) * high);
}

static ps_morph morph(const ps_brdf *brdf) {
    (void)brdf;
    return (ps_morph){PS_MORPH_DIFFUSE, 0};
}

/* ---- as an integrand ----------------------------------------------------------------------- */

/* C(g) = 2/(3 pi^2) (sin g + (pi - g) cos g) of max(0, z)/pi. */
static double common(double x) {
    const ps_half_angle half = ps_integrand_half_angle(x);
    const double rest = 2 * atan2(half.cosine, half.sine); /* pi - g */
    return 2 / (3 * PS_PI * PS_PI) * (2 * half.sine * half.cosine + rest * x);
}

static double correlation(const ps_integrand *self, const double *x) {
    return ps_integrand_is_on_hemisphere(self) ? 2 * (common(x[0]) + common(-x[0])) : common(x[0]);
}

PS_INTEGRAND_VALUES(diffuse_value)

static const ps_lobe lobe = {
    .norm = norm,
    .energy = energy,
    .density = density,
    .spherical = spherical,
    .hemispherical = hemispherical,
    .mean_distance = mean_distance,
    .morph = morph,
};

const ps_integrand_kind ps_integrand_diffuse = {
    .name = "diffuse",
    .summary = "max(0, z), z the cosine to the axis",
    PS_LOBE_ROW,
    .lobe = &lobe,
    .kernel = "diffuse",
    .values = values,
    .correlation = correlation,
};
