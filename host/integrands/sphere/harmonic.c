/* The real harmonic Y_l0 about an axis: docs/mathematics/integrands_sphere.md#harmonics. */
#define PRECISION 64
#include "integrands/harmonic.h"

#include "base/text.h"
#include "integrands/integrand_kind.h"

#include <string.h>

static pspec_status create(ps_integrand *self, const char *const *values, ps_error *error) {
    const uint64_t most_degree = 1000; /* the values take as many steps as that */
    uint64_t degree = 0;
    PS_TRY(
        ps_parse_count(values[0], "degree of integrand harmonic", 1, most_degree, &degree, error));
    if (ps_integrand_is_on_hemisphere(self) && degree % 2 != 0) {
        return ps_integrand_fail(self, "degree", values[0],
                                 "on the hemisphere, whose integrands are continued evenly, "
                                 "harmonics have an even degree",
                                 error);
    }
    self->numbers[HARMONIC_DEGREE] = (double)degree;
    self->numbers[HARMONIC_SCALE] = sqrt((2 * (double)degree + 1) / PS_FOUR_PI);
    self->numbers[HARMONIC_PARITY] = degree % 2 == 0 ? 1 : -1;
    return ps_integrand_axis(self, values[1], &self->numbers[HARMONIC_AXIS], error);
}

/* 0 also over the hemisphere, where l is even. */
static double integral(const ps_integrand *self) {
    (void)self;
    return 0;
}

static double energy(const ps_integrand *self) {
    (void)self;
    return 1;
}

static pspec_status zonal(const ps_integrand *self, size_t max_degree, double *out,
                          ps_error *error) {
    const size_t degree = (size_t)self->numbers[HARMONIC_DEGREE];
    (void)error;
    memset(out, 0, (max_degree + 1) * sizeof *out);
    if (degree <= max_degree) {
        out[degree] = 1;
    }
    return PSPEC_OK;
}

/* P_l(cos g) */
static double correlation(const ps_integrand *self, const double *x) {
    const double sign = x[0] < 0 ? self->numbers[HARMONIC_PARITY] : 1;
    const double t = fmax(1 - fabs(x[0]), 0);
    return sign * harmonic_legendre(t, self->numbers[HARMONIC_DEGREE]);
}

static double reach(const ps_integrand *self) {
    return self->numbers[HARMONIC_DEGREE];
}

PS_INTEGRAND_VALUES(harmonic_value)

const ps_integrand_kind ps_integrand_harmonic = {
    .name = "harmonic",
    .summary = "the harmonic Y_l0 about an axis",
    .kernel = "harmonic",
    .domains = PS_INTEGRAND_ROUND,
    .parameters = {{"degree", "4", "l, 1 to 1000; of the hemisphere even"}, PS_INTEGRAND_AXIS},
    .create = create,
    .integral = integral,
    .energy = energy,
    .zonal = zonal,
    .has_axis = true,
    .values = values,
    .correlation = correlation,
    .reach = reach,
};
