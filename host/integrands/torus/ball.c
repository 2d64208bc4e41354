/* The indicator of a ball: docs/mathematics/integrands.md#balls. */
#define PRECISION 64
#include "integrands/ball.h"

#include "integrands/integrand_kind.h"
#include "math/gsl/special.h"

#define LARGEST_RADIUS 0.5 /* larger balls overlap their images */

static pspec_status create(ps_integrand *self, const char *const *values, ps_error *error) {
    PS_TRY(ps_integrand_number(self, "radius", values[0], 0, LARGEST_RADIUS,
                               &self->numbers[BALL_RADIUS], error));
    if (self->numbers[BALL_RADIUS] <= 0) {
        return ps_integrand_fail(self, "radius", values[0], "a ball has a radius above 0", error);
    }
    return ps_integrand_vector(self, "centre", values[1], 0, 1, &self->numbers[BALL_CENTRE], error);
}

/* pi^(d/2) r^d / Gamma(d/2 + 1): V_d = V_{d-2} 2 pi r^2 / d. */
static double volume(unsigned dimension, double radius) {
    double product = dimension % 2 == 0 ? 1 : 2 * radius;
    for (unsigned d = dimension % 2 + 2; d <= dimension; d += 2) {
        product *= PS_TWO_PI * radius * radius / d;
    }
    return product;
}

static double integral(const ps_integrand *self) {
    return volume(self->place.dimension, self->numbers[BALL_RADIUS]);
}

static double energy(const ps_integrand *self) {
    const double part = integral(self);
    return part * (1 - part);
}

/* |f_k|^2 = (r/|k|)^d J_{d/2}(2 pi r |k|)^2. */
static double radial(const ps_integrand *self, double k) {
    const unsigned dimension = self->place.dimension;
    const double radius = self->numbers[BALL_RADIUS];
    if (k == 0) {
        return integral(self) * integral(self);
    }
    const double bessel = ps_bessel_half(dimension, PS_TWO_PI * radius * k);
    return pow(radius / k, dimension) * bessel * bessel;
}

static pspec_status powers(const ps_integrand *self, const int32_t *vectors, size_t num,
                           double *out, ps_error *error) {
    const unsigned dimension = self->place.dimension;
    (void)error;
    for (size_t i = 0; i < num; i++) {
        out[i] = radial(self, ps_integrand_norm(vectors + i * dimension, dimension));
    }
    return PSPEC_OK;
}

/* The common volume of two balls whose centres are q apart, in units of the volume of one, t =
 * q/(2 r). */
static double overlap(unsigned dimension, double t) {
    enum { CUBE = 3 };
    switch (dimension) {
    case 1:
        return 1 - t;
    case 2:
        return 2 / PS_PI * (acos(t) - t * sqrt((1 - t) * (1 + t)));
    case CUBE:
        return (1 - t) * (1 - t) * (2 + t) / 2;
    default:
        return ps_beta_regularised((dimension + 1) / 2.0, 0.5, (1 - t) * (1 + t));
    }
}

typedef struct overlaps {
    unsigned dimension;
    double radius, sum;
} overlaps;

static void add_overlap(void *payload, const double *image) {
    overlaps *const self = payload;
    double norm2 = 0;
    for (unsigned i = 0; i < self->dimension; i++) {
        norm2 += image[i] * image[i];
    }
    const double t = sqrt(norm2) / (2 * self->radius);
    self->sum += t < 1 ? overlap(self->dimension, t) : 0;
}

static double correlation(const ps_integrand *self, const double *x) {
    overlaps all = {self->place.dimension, self->numbers[BALL_RADIUS], 0};
    ps_integrand_images(x, all.dimension, add_overlap, &all);
    return all.sum * integral(self);
}

static bool is_isotropic(const ps_integrand *self) {
    (void)self;
    return true;
}

PS_INTEGRAND_VALUES(ball_value)

const ps_integrand_kind ps_integrand_ball = {
    .name = "disk",
    .aliases = "ball interval",
    .summary = "1 inside of a disk or ball of the torus",
    .kernel = "ball",
    .domains = PS_INTEGRAND_ON(PS_SAMPLES_TORUS),
    .least = 1,
    .most = PS_MAX_DIMENSION,
    .parameters = {{"radius", "0.25", "above 0, at most 1/2"},
                   {"centre", "0.5", "one number, or one for each axis, as 0.5x0.25"}},
    .create = create,
    .integral = integral,
    .energy = energy,
    .powers = powers,
    .values = values,
    .correlation = correlation,
    .is_isotropic = is_isotropic,
    .radial = radial,
    .whole_square = integral,
};
