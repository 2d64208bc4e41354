/* What integrands about an axis of the sphere share. */
#include "base/memory.h"
#include "integrands/integrand_kind.h"
#include "math/gsl/special.h"

#include <stdlib.h>

#define LARGEST_COMPONENT 1e6 /* of an axis, whose length does not matter */

bool ps_integrand_is_on_hemisphere(const ps_integrand *integrand) {
    return integrand->place.where == PS_SAMPLES_HEMISPHERE;
}

pspec_status ps_integrand_axis(const ps_integrand *integrand, const char *text, double *axis,
                               ps_error *error) {
    PS_TRY(ps_integrand_vector(integrand, "axis", text, -LARGEST_COMPONENT, LARGEST_COMPONENT, axis,
                               error));
    const double largest = fmax(fmax(fabs(axis[0]), fabs(axis[1])), fabs(axis[2]));
    if (largest == 0) {
        return ps_integrand_fail(integrand, "axis", text, "0 is no direction", error);
    }
    double norm2 = 0;
    for (unsigned i = 0; i < 3; i++) {
        axis[i] /= largest; /* squares of tiny components are numbers then */
        norm2 += axis[i] * axis[i];
    }
    for (unsigned i = 0; i < 3; i++) {
        axis[i] /= sqrt(norm2);
    }
    if (ps_integrand_is_on_hemisphere(integrand) &&
        !(axis[0] == 0 && axis[1] == 0 && axis[2] > 0)) {
        return ps_integrand_fail(integrand, "axis", text,
                                 "integrands of the hemisphere have the axis z, 0x0x1", error);
    }
    return PSPEC_OK;
}

void ps_integrand_extend(const ps_integrand *integrand, size_t max_degree, double *f) {
    for (size_t l = 0; ps_integrand_is_on_hemisphere(integrand) && l <= max_degree; l++) {
        f[l] *= l % 2 == 0 ? 2 : 0;
    }
}

pspec_status ps_integrand_zonal_degrees(const ps_integrand *integrand, size_t max_degree,
                                        double *powers, ps_error *error) {
    PS_TRY(integrand->kind->zonal(integrand, max_degree, powers, error));
    for (size_t l = 0; l <= max_degree; l++) {
        powers[l] *= powers[l];
    }
    return PSPEC_OK;
}

/* F_lm = sqrt(4 pi/(2l+1)) F_l0 conj(Y_lm(axis)); q: the functions of Legendre at the axis. */
static void turn(const double *axis, size_t max_degree, const double *f, const double *q,
                 double *out) {
    const double azimuth = atan2(-axis[1], -axis[0]); /* Condon and Shortley's (-1)^m is in it */
    for (size_t m = 0; m <= max_degree; m++) {
        const double re = cos((double)m * azimuth);
        const double im = -sin((double)m * azimuth);
        for (size_t l = m; l <= max_degree; l++, out += 2) {
            const double factor =
                sqrt(PS_FOUR_PI / (2 * (double)l + 1)) * f[l] * q[ps_legendre_place(l, m)];
            out[0] = factor * re;
            out[1] = factor * im;
        }
    }
}

pspec_status ps_integrand_zonal_coefficients(const ps_integrand *integrand, size_t max_degree,
                                             double *out, ps_error *error) {
    static const double z[] = {0, 0, 1};
    const double *const axis = integrand->kind->has_axis ? integrand->numbers : z;
    double *f = NULL;
    PS_TRY(PS_NEW(&f, max_degree + 1 + ps_legendre_room(max_degree), "harmonics", error));
    const pspec_status status = integrand->kind->zonal(integrand, max_degree, f, error);
    if (status == PSPEC_OK) {
        double *const q = f + max_degree + 1;
        ps_legendre_functions(max_degree, fmin(fmax(axis[2], -1), 1), q);
        turn(axis, max_degree, f, q, out);
    }
    free(f);
    return status;
}

ps_half_angle ps_integrand_half_angle(double x) {
    const double cosine = fmin(fmax(x, -1), 1);
    return (ps_half_angle){sqrt((1 - cosine) / 2), sqrt((1 + cosine) / 2)};
}

/* ---- e^{n(z-1)} ---------------------------------------------------------------------------- */

/* Without the subtraction where it would lose digits. */
double ps_integrand_lobe_spread(double n) {
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
    const double energy =
        quarter * ps_integrand_lobe_spread(n) * n / -expm1(-2 * n); /* over F_00^2 */
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
