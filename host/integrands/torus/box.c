/* The indicator of a box with its sides along the axes: docs/mathematics/integrands.md#boxes. */
#define PRECISION 64
#include "integrands/box.h"

#include "integrands/integrand_kind.h"

static pspec_status create(ps_integrand *self, const char *const *values, ps_error *error) {
    double *const sides = &self->numbers[BOX_SIDES];
    PS_TRY(ps_integrand_vector(self, "sides", values[0], 0, 1, sides, error));
    for (unsigned i = 0; i < self->place.dimension; i++) {
        if (sides[i] <= 0) {
            return ps_integrand_fail(self, "sides", values[0], "sides are above 0", error);
        }
    }
    return ps_integrand_vector(self, "centre", values[1], 0, 1, &self->numbers[BOX_CENTRE], error);
}

static double integral(const ps_integrand *self) {
    double product = 1;
    for (unsigned i = 0; i < self->place.dimension; i++) {
        product *= self->numbers[BOX_SIDES + i];
    }
    return product;
}

static double energy(const ps_integrand *self) {
    const double part = integral(self);
    return part * (1 - part);
}

/* sin(pi k s)/(pi k), the angle reduced while it is exact. */
static double factor(double k, double side) {
    if (k == 0) {
        return side;
    }
    const double turns = k * side;
    const double rest = fma(k, side, -turns); /* what the product lost */
    return sin(PS_PI * (fmod(turns, 2) + rest)) / (PS_PI * k);
}

static pspec_status powers(const ps_integrand *self, const int32_t *vectors, size_t num,
                           double *out, ps_error *error) {
    const unsigned dimension = self->place.dimension;
    (void)error;
    for (size_t i = 0; i < num; i++) {
        double product = 1;
        for (unsigned axis = 0; axis < dimension; axis++) {
            product *= factor(vectors[i * dimension + axis], self->numbers[BOX_SIDES + axis]);
        }
        out[i] = product * product;
    }
    return PSPEC_OK;
}

/* On every axis the common length of two intervals of the circle. */
static double correlation(const ps_integrand *self, const double *x) {
    double product = 1;
    for (unsigned i = 0; i < self->place.dimension; i++) {
        const double side = self->numbers[BOX_SIDES + i];
        const double apart = fabs(x[i] - rint(x[i]));
        product *= fmax(side - apart, 0) + fmax(side - (1 - apart), 0);
    }
    return product;
}

PS_INTEGRAND_VALUES(box_value)

const ps_integrand_kind ps_integrand_box = {
    .name = "box",
    .summary = "1 inside of a box with its sides along the axes",
    .kernel = "box",
    .domains = PS_INTEGRAND_ON(PS_SAMPLES_TORUS),
    .least = 1,
    .most = PS_MAX_DIMENSION,
    .parameters = {{"sides", "0.5", "above 0, at most 1; one number, or one for each axis"},
                   {"centre", "0.5", "one number, or one for each axis, as 0.5x0.25"}},
    .create = create,
    .integral = integral,
    .energy = energy,
    .powers = powers,
    .values = values,
    .correlation = correlation,
};
