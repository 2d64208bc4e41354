/* The Gaussian lobe e^{n(z-1)}, z the cosine to an axis, not divided by its integral:
 * docs/mathematics/integrands_sphere.md#lobes. */
#define PRECISION 64
#include "integrands/lobe.h"

#include "integrands/lobes/lobe.h"

static pspec_status create(ps_integrand *self, const char *const *values, ps_error *error) {
    double exponent = 0;
    ps_brdf *glossy = NULL;
    PS_TRY(
        ps_integrand_number(self, "n", values[0], PS_LEAST_LOBE, PS_MOST_LOBE, &exponent, error));
    PS_TRY(ps_integrand_axis(self, values[1], &self->numbers[LOBE_AXIS], error));
    const char *const of_glossy[] = {values[0],
                                     ps_integrand_is_on_hemisphere(self) ? "horizon" : "none"};
    PS_TRY(ps_brdf_make(&glossy, &ps_integrand_glossy, of_glossy, error));
    self->own = glossy;
    self->numbers[LOBE_RATE] = exponent / 2;
    return PSPEC_OK;
}

static void destroy(ps_integrand *self) {
    ps_brdf_destroy(self->own);
}

static double integral(const ps_integrand *self) {
    return PS_TWO_PI * ps_brdf_norm(self->own);
}

/* (pi/n) (1 - e^-4n) - (pi/n^2) (1 - e^-2n)^2 on the sphere; the same of n/2 on the hemisphere. */
static double energy(const ps_integrand *self) {
    const ps_brdf *const glossy = self->own;
    const double n = ps_integrand_is_on_hemisphere(self) ? glossy->exponent / 2 : glossy->exponent;
    return PS_PI / n * -expm1(-2 * n) * ps_integrand_lobe_spread(n);
}

static pspec_status zonal(const ps_integrand *self, size_t max_degree, double *out,
                          ps_error *error) {
    const double whole = integral(self);
    PS_TRY(ps_brdf_spherical(self->own, max_degree, out, error));
    for (size_t l = 0; l <= max_degree; l++) {
        out[l] *= whole;
    }
    ps_integrand_extend(self, max_degree, out);
    return PSPEC_OK;
}

/* The part that a horizon cuts off is less than rounding where e^-2n is. */
static double reach(const ps_integrand *self) {
    const ps_brdf *const glossy = self->own;
    const bool is_whole = !ps_integrand_is_on_hemisphere(self) || glossy->exponent >= PS_UNCUT_LOBE;
    return is_whole ? ps_integrand_lobe_reach(glossy->exponent) : INFINITY;
}

static double correlation(const ps_integrand *self, const double *x) {
    const ps_brdf *const glossy = self->own;
    return ps_integrand_is_on_hemisphere(self)
               ? NAN
               : ps_integrand_lobe_correlation(glossy->exponent, x[0]);
}

static const char *note(const ps_integrand *self) {
    return ps_integrand_is_on_hemisphere(self) ? "cut at the horizon" : NULL;
}

PS_INTEGRAND_VALUES(lobe_value)

const ps_integrand_kind ps_integrand_lobe = {
    .name = "lobe",
    .summary = "e^{n(z-1)}, z the cosine to an axis; 1 at its top",
    .kernel = "lobe",
    .domains = PS_INTEGRAND_ROUND,
    .parameters = {{"n", "30", "exponent, 0.001 to 1e6"}, PS_INTEGRAND_AXIS},
    .create = create,
    .destroy = destroy,
    .integral = integral,
    .energy = energy,
    .zonal = zonal,
    .has_axis = true,
    .values = values,
    .correlation = correlation,
    .reach = reach,
    .note = note,
};
