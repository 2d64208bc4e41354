/* The same everywhere: any points integrate it exactly. */
#define PRECISION 64
#include "integrands/constant.h"

#include "integrands/integrand_kind.h"

#include <string.h>

#define LARGEST_VALUE 1e100 /* its square is a number */

static pspec_status create(ps_integrand *self, const char *const *values, ps_error *error) {
    return ps_integrand_number(self, "value", values[0], -LARGEST_VALUE, LARGEST_VALUE,
                               &self->numbers[CONSTANT_VALUE], error);
}

static double integral(const ps_integrand *self) {
    static const double areas[] = {[PS_SAMPLES_TORUS] = 1,
                                   [PS_SAMPLES_SPHERE] = PS_FOUR_PI,
                                   [PS_SAMPLES_HEMISPHERE] = PS_TWO_PI};
    return self->numbers[CONSTANT_VALUE] * areas[self->place.where];
}

static double energy(const ps_integrand *self) {
    (void)self;
    return 0;
}

static pspec_status powers(const ps_integrand *self, const int32_t *vectors, size_t num,
                           double *out, ps_error *error) {
    (void)self, (void)vectors, (void)error;
    memset(out, 0, num * sizeof *out);
    return PSPEC_OK;
}

/* F_00 = 2 sqrt(pi) F, also of the even extension of the hemisphere. */
static pspec_status zonal(const ps_integrand *self, size_t max_degree, double *out,
                          ps_error *error) {
    (void)error;
    memset(out, 0, (max_degree + 1) * sizeof *out);
    out[0] = sqrt(PS_FOUR_PI) * self->numbers[CONSTANT_VALUE];
    return PSPEC_OK;
}

/* A(x) on the torus; (4 pi)(F^2) on the sphere. */
static double correlation(const ps_integrand *self, const double *x) {
    const double value = self->numbers[CONSTANT_VALUE];
    (void)x;
    return value * value * (self->place.where == PS_SAMPLES_TORUS ? 1 : PS_FOUR_PI);
}

static bool is_isotropic(const ps_integrand *self) {
    (void)self;
    return true;
}

/* There is nothing but the mean. */
static double reach(const ps_integrand *self) {
    (void)self;
    return 0;
}

PS_INTEGRAND_VALUES(constant_value)

const ps_integrand_kind ps_integrand_constant = {
    .name = "constant",
    .summary = "the same everywhere; its variance is 0",
    .kernel = "constant",
    .domains = PS_INTEGRAND_ON(PS_SAMPLES_TORUS) | PS_INTEGRAND_ON(PS_SAMPLES_SPHERE) |
               PS_INTEGRAND_ON(PS_SAMPLES_HEMISPHERE),
    .least = 1,
    .most = PS_MAX_DIMENSION,
    .parameters = {{"value", "1", "any number"}},
    .create = create,
    .integral = integral,
    .energy = energy,
    .powers = powers,
    .zonal = zonal,
    .values = values,
    .correlation = correlation,
    .is_isotropic = is_isotropic,
    .reach = reach,
};
