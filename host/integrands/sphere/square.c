/* (u.e)^2 = 1/3 + 2/3 P_2(u.e), even as it is: docs/mathematics/integrands_sphere.md#squares. */
#define PRECISION 64
#include "integrands/square.h"

#include "integrands/integrand_kind.h"

#include <string.h>

#define ENERGY (16 * PS_PI / 45) /* F_20^2 = (2/3)^2 4 pi/5 */

static pspec_status create(ps_integrand *self, const char *const *values, ps_error *error) {
    return ps_integrand_axis(self, values[0], &self->numbers[SQUARE_AXIS], error);
}

static double integral(const ps_integrand *self) {
    return (ps_integrand_is_on_hemisphere(self) ? PS_TWO_PI : PS_FOUR_PI) / 3;
}

static double energy(const ps_integrand *self) {
    (void)self;
    return ENERGY;
}

static pspec_status zonal(const ps_integrand *self, size_t max_degree, double *out,
                          ps_error *error) {
    (void)self, (void)error;
    memset(out, 0, (max_degree + 1) * sizeof *out);
    out[0] = sqrt(PS_FOUR_PI) / 3;
    if (max_degree >= 2) {
        out[2] = sqrt(ENERGY);
    }
    return PSPEC_OK;
}

/* F_00^2 + F_20^2 P_2(cos g) */
static double correlation(const ps_integrand *self, const double *x) {
    (void)self;
    return PS_FOUR_PI / 9 + ENERGY * (3 * x[0] * x[0] - 1) / 2;
}

static double reach(const ps_integrand *self) {
    (void)self;
    return 2;
}

PS_INTEGRAND_VALUES(square_value)

const ps_integrand_kind ps_integrand_square = {
    .name = "square",
    .summary = "the square of the cosine to an axis",
    .kernel = "square",
    .domains = PS_INTEGRAND_ROUND,
    .parameters = {PS_INTEGRAND_AXIS},
    .create = create,
    .integral = integral,
    .energy = energy,
    .zonal = zonal,
    .has_axis = true,
    .values = values,
    .correlation = correlation,
    .reach = reach,
};
