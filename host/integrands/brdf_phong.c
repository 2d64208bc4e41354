/* The Phong lobe p = max(0, z)^n. */
#include "integrands/brdf_kind.h"

#include <math.h>

static double norm(const ps_brdf *brdf) {
    return 1 / (brdf->exponent + 1);
}

static double energy(const ps_brdf *brdf) {
    const double n = brdf->exponent;
    return (n + 1) * (n + 1) / (PS_TWO_PI * (2 * n + 1));
}

static double density(const ps_brdf *brdf, double z) {
    return z > 0 ? pow(z, brdf->exponent) : 0;
}

/* G_l/G_0 from degree l - 2 on: products only, stable for every degree. */
static pspec_status spherical(const ps_brdf *brdf, size_t max_degree, double *b, ps_error *error) {
    (void)error;
    const double n = brdf->exponent;
    double last = 0;
    double value = 1;
    for (size_t l = 0; l <= max_degree; l++) {
        const double degree = (double)l;
        const double ratio = l == 1   ? (n + 1) / (n + 2)
                             : l == 0 ? 1
                                      : last * ((n - degree + 2) / (n + degree + 1));
        last = value;
        value = ratio;
        b[l] = ps_zonal_at_pole(l) * ratio;
    }
    return PSPEC_OK;
}

/* int_0^1 z^n P_l(2z-1) dz = (n/(n+2)) ((n-1)/(n+3)) .. / (n+1), l factors: 0 beyond a whole n. */
static pspec_status hemispherical(const ps_brdf *brdf, size_t max_degree, double *b,
                                  ps_error *error) {
    (void)error;
    const double n = brdf->exponent;
    double value = 1;
    for (size_t l = 0; l <= max_degree; l++) {
        const double degree = (double)l;
        value *= l > 0 ? (n - degree + 1) / (n + degree + 1) : 1;
        b[l] = sqrt(2.0) * ps_zonal_at_pole(l) * value;
    }
    return PSPEC_OK;
}

static ps_morph morph(const ps_brdf *brdf) {
    return (ps_morph){PS_MORPH_PHONG, brdf->exponent};
}

static pspec_status create(ps_brdf *brdf, const char *const *values, ps_error *error) {
    return ps_brdf_read_exponent(brdf, values[0], error);
}

const ps_brdf_kind ps_brdf_phong = {
    .name = "phong",
    .summary = PS_PHONG_SUMMARY,
    .parameters = {PS_EXPONENT_PARAMETER, {NULL, NULL, NULL}},
    .create = create,
    .norm = norm,
    .energy = energy,
    .density = density,
    .spherical = spherical,
    .hemispherical = hemispherical,
    .morph = morph,
};
