/* What integrands about an axis of the sphere share. */
#include "integrands/integrand_kind.h"

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

void ps_integrand_zonal_powers(const ps_integrand *integrand, size_t max_degree, double *f) {
    const bool is_extended = ps_integrand_is_on_hemisphere(integrand);
    for (size_t l = 0; l <= max_degree; l++) {
        const double factor = !is_extended ? 1 : l % 2 == 0 ? 4 : 0;
        f[l] *= factor * f[l];
    }
}

ps_half_angle ps_integrand_half_angle(double x) {
    const double cosine = fmin(fmax(x, -1), 1);
    return (ps_half_angle){sqrt((1 - cosine) / 2), sqrt((1 + cosine) / 2)};
}
