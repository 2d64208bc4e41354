/* The Phong lobe p = max(0, z)^n. */
#define PRECISION 64
#include "integrands/phong.h"

#include "integrands/lobes/lobe.h"

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

/* ---- as an integrand ----------------------------------------------------------------------- */

static void fill(ps_integrand *self) {
    const ps_brdf *const brdf = self->own;
    self->numbers[PHONG_EXPONENT] = brdf->exponent;
    self->numbers[PHONG_SCALE] = 1 / (PS_TWO_PI * norm(brdf));
}

/* z^n with an even n is continued evenly as it is: a polynomial. Others have a kink at the horizon.
 */
static double reach(const ps_integrand *self) {
    const double n = self->numbers[PHONG_EXPONENT];
    return ps_integrand_is_on_hemisphere(self) && fmod(n, 2) == 0 ? n : INFINITY;
}

PS_INTEGRAND_VALUES(phong_value)

static const ps_lobe lobe = {
    .create = create,
    .norm = norm,
    .energy = energy,
    .density = density,
    .spherical = spherical,
    .hemispherical = hemispherical,
    .morph = morph,
    .fill = fill,
};

const ps_integrand_kind ps_integrand_phong = {
    .name = "phong",
    .summary = "max(0, z)^n",
    .parameters = {{"n", "", "exponent, 0.001 to 1e6; must be given"}},
    PS_LOBE_ROW,
    .lobe = &lobe,
    .kernel = "phong",
    .values = values,
    .reach = reach,
};
