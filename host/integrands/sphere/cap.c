/* The indicator of a cap: docs/mathematics/integrands_sphere.md#caps. */
#define PRECISION 64
#include "integrands/cap.h"

#include "integrands/integrand_kind.h"

/* Numbers are those of the smaller of the cap and what it leaves, whose half-angle is t. */
static pspec_status create(ps_integrand *self, const char *const *values, ps_error *error) {
    double *const numbers = self->numbers;
    double angle = 0;
    PS_TRY(ps_integrand_number(self, "angle", values[0], 0, PS_PI, &angle, error));
    PS_TRY(ps_integrand_axis(self, values[1], &numbers[CAP_CENTRE], error));
    if (angle <= 0 || angle >= PS_PI) {
        return ps_integrand_fail(self, "angle", values[0],
                                 "the half-angle of a cap is above 0 and below pi", error);
    }
    const bool is_small = angle <= PS_PI / 2;
    if (ps_integrand_is_on_hemisphere(self) && !is_small) {
        return ps_integrand_fail(self, "angle", values[0],
                                 "a cap of the hemisphere has the half-angle pi/2 at most", error);
    }
    numbers[CAP_ANGLE] = is_small ? angle : PS_PI - angle;
    const double chord = 2 * sin(numbers[CAP_ANGLE] / 2);
    numbers[CAP_CHORD2] = chord * chord;
    numbers[CAP_INSIDE] = is_small ? 1 : 0;
    for (unsigned i = 0; i < 3 && !is_small; i++) {
        numbers[CAP_CENTRE + i] = -numbers[CAP_CENTRE + i];
    }
    return PSPEC_OK;
}

static bool is_complement(const ps_integrand *self) {
    return self->numbers[CAP_INSIDE] == 0;
}

/* 2 pi (1 - cos t) = pi chord^2, of the smaller cap. */
static double area(const ps_integrand *self) {
    return PS_PI * self->numbers[CAP_CHORD2];
}

static double integral(const ps_integrand *self) {
    return is_complement(self) ? PS_FOUR_PI - area(self) : area(self);
}

/* A - A^2/(4 pi) = pi sin^2 t; of the hemisphere 2A - A^2/pi = 2 A cos t. */
static double energy(const ps_integrand *self) {
    const double t = self->numbers[CAP_ANGLE];
    return ps_integrand_is_on_hemisphere(self) ? 2 * area(self) * cos(t) : PS_PI * sin(t) * sin(t);
}

/* F_l0 = sqrt(pi/(2l+1)) (P_{l-1} - P_{l+1}) of cos t, by differences D_l = P_l - P_{l-1}, with 1 -
 * cos t = chord^2/2. What a cap leaves has the opposite sign at l >= 1. */
static pspec_status zonal(const ps_integrand *self, size_t max_degree, double *out,
                          ps_error *error) {
    const double t = self->numbers[CAP_CHORD2] / 2;
    const double sign = is_complement(self) ? -1 : 1;
    double value = 1 - t;
    double step = -t;
    (void)error;
    out[0] = integral(self) / sqrt(PS_FOUR_PI);
    for (size_t l = 1; l <= max_degree; l++) {
        const double degree = (double)l;
        const double next = (degree * step - (2 * degree + 1) * (t * value)) / (degree + 1);
        out[l] = sign * -sqrt(PS_PI / (2 * degree + 1)) * (step + next);
        value += next;
        step = next;
    }
    ps_integrand_extend(self, max_degree, out);
    return PSPEC_OK;
}

/* The common area of two caps of half-angle t <= pi/2 whose centres are at the angle g: two sectors
 * of the angle 2 alpha, less four right-angled triangles of legs g/2 and h. */
static double overlap(double t, double chord2, ps_half_angle half) {
    const double ratio = half.sine / half.cosine / tan(t); /* cos alpha */
    if (!(ratio < 1)) {
        return 0;
    }
    const double sin_h = sin(t) * sqrt((1 - ratio) * (1 + ratio));
    const double cos_h = cos(t) / half.cosine;
    const double excess = 2 * atan(half.sine / (1 + half.cosine) * (sin_h / (1 + cos_h)));
    return 2 * acos(ratio) * chord2 - 4 * excess;
}

/* F = 1 - G, G the smaller cap: 4 pi - 2 (area of G) + C of G. The even extension of a cap on the
 * hemisphere is two caps. */
static double correlation(const ps_integrand *self, const double *x) {
    const double t = self->numbers[CAP_ANGLE];
    const double chord2 = self->numbers[CAP_CHORD2];
    const double common = overlap(t, chord2, ps_integrand_half_angle(x[0]));
    if (ps_integrand_is_on_hemisphere(self)) {
        return 2 * (common + overlap(t, chord2, ps_integrand_half_angle(-x[0])));
    }
    return is_complement(self) ? PS_FOUR_PI - 2 * area(self) + common : common;
}

PS_INTEGRAND_VALUES(cap_value)

const ps_integrand_kind ps_integrand_cap = {
    .name = "cap",
    .summary = "1 in a cap of the sphere or the hemisphere",
    .kernel = "cap",
    .domains = PS_INTEGRAND_ROUND,
    .parameters = {{"angle", "1.0471975511965976",
                    "half-angle in radians, above 0, below pi; of the hemisphere pi/2 at most"},
                   PS_INTEGRAND_AXIS},
    .create = create,
    .integral = integral,
    .energy = energy,
    .zonal = zonal,
    .has_axis = true,
    .values = values,
    .correlation = correlation,
};
