/* The Gaussian lobe e^{n(z-1)}, z the cosine to an axis, not divided by its integral:
 * docs/mathematics/integrands_sphere.md#lobes. */
#define PRECISION 64
#include "integrands/lobe.h"

#include "integrands/brdf_kind.h"
#include "integrands/integrand_kind.h"

#include <stdio.h>

static pspec_status create(ps_integrand *self, const char *const *values, ps_error *error) {
    char text[PS_GRAMMAR_WORD];
    double exponent = 0;
    ps_brdf *glossy = NULL;
    PS_TRY(
        ps_integrand_number(self, "n", values[0], PS_LEAST_LOBE, PS_MOST_LOBE, &exponent, error));
    PS_TRY(ps_integrand_axis(self, values[1], &self->numbers[LOBE_AXIS], error));
    snprintf(text, sizeof text, "%.17g", exponent);
    const char *const of_glossy[] = {text,
                                     ps_integrand_is_on_hemisphere(self) ? "horizon" : "none"};
    PS_TRY(ps_brdf_make(&glossy, &ps_brdf_glossy, of_glossy, error));
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

/* cosh n - sinh(n)/n, times 2 e^-n; without the subtraction where it would lose digits. */
static double spread(double n) {
    const double few = 1;
    const int num_terms = 12; /* of the series for n < 1: the next is 1e-26 */
    if (n >= few) {
        return 1 + exp(-2 * n) + expm1(-2 * n) / n;
    }
    double term = 1; /* n^2k/(2k+1)! */
    double sum = 0;
    for (int k = 1; k <= num_terms; k++) {
        term *= n * n / (2 * k * (2 * k + 1));
        sum += 2 * k * term;
    }
    return 2 * exp(-n) * sum;
}

/* (pi/n) (1 - e^-4n) - (pi/n^2) (1 - e^-2n)^2 on the sphere; the same of n/2 on the hemisphere. */
static double energy(const ps_integrand *self) {
    const ps_brdf *const glossy = self->own;
    const double n = ps_integrand_is_on_hemisphere(self) ? glossy->exponent / 2 : glossy->exponent;
    return PS_PI / n * -expm1(-2 * n) * spread(n);
}

static pspec_status degrees(const ps_integrand *self, size_t max_degree, double *out,
                            ps_error *error) {
    const double whole = integral(self);
    PS_TRY(ps_brdf_spherical(self->own, max_degree, out, error));
    for (size_t l = 0; l <= max_degree; l++) {
        out[l] *= whole;
    }
    ps_integrand_zonal_powers(self, max_degree, out);
    return PSPEC_OK;
}

/* With q = |u + v| = 2 cos(g/2), the mean of e^{n (Ru + Rv).e} over rotations is sinh(nq)/(nq). */
double ps_integrand_lobe_correlation(double n, double x) {
    const ps_half_angle half = ps_integrand_half_angle(x);
    const double y = 4 * n * half.cosine;                               /* 2 n q */
    const double below = 2 * half.sine * half.sine / (1 + half.cosine); /* 2 - q */
    return PS_FOUR_PI * exp(-n * below) * (y > 0 ? -expm1(-y) / y : 1);
}

/* F_l0^2 = (2l+1) F_00^2 lambda_l^2, lambda_{l+1}/lambda_l = I_{nu+1}(n)/I_nu(n) at nu = l + 1/2,
 * which is at most n/(nu + 1/2 + sqrt((nu + 1/2)^2 + n^2)) (Amos 1974). From there on terms fall
 * faster than a geometric series. Even degrees alone have more than a quarter of the energy. */
double ps_integrand_lobe_reach(double n) {
    const double quarter = 0.25;
    const double energy = quarter * spread(n) * n / -expm1(-2 * n); /* over F_00^2 */
    double term = 1;                                                /* at least (2l+1) lambda_l^2 */
    double rest = INFINITY;
    double l = 0;
    while (rest > PS_BEYOND_REACH * energy) {
        const double ratio = n / (l + 1 + hypot(l + 1, n));
        const double factor = (2 * l + 3) / (2 * l + 1) * ratio * ratio;
        term *= factor;
        rest = factor < 1 ? term / (1 - factor) : INFINITY; /* factors fall: the next is smaller */
        l += 1;
    }
    return l - 1; /* rest is of l and all beyond */
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
    .degrees = degrees,
    .values = values,
    .correlation = correlation,
    .reach = reach,
    .note = note,
};
