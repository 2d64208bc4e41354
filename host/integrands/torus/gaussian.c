/* A Gaussian of height 1, summed over its images or cut:
 * docs/mathematics/integrands.md#gaussians. */
#define PRECISION 64
#include "integrands/gaussian.h"

#include "base/memory.h"
#include "integrands/integrand_kind.h"

#include <complex.h>
#include <stdlib.h>
#include <string.h>

#define LEAST_SIGMA 1e-4
#define LARGEST_SIGMA 1.0 /* wider ones are constant to 1e-8, and need many images */
/* exp(-x^2/2) < 1e-17 from there on, which is nothing beside 1. */
#define REACH 8.85

static double sigma_of(const ps_integrand *self) {
    return sqrt(0.5 / self->numbers[GAUSSIAN_RATE]);
}

/* self->own is not NULL where it is cut; it points nowhere else than to self. */
static bool is_cut(const ps_integrand *self) {
    return self->own != NULL;
}

/* Images beyond the nearest, which is 1/2 away at most. */
static double num_images(double sigma) {
    const double beyond = ceil(REACH * sigma - 0.5);
    return beyond > 0 ? beyond : 0;
}

static pspec_status create(ps_integrand *self, const char *const *values, ps_error *error) {
    double sigma = 0;
    PS_TRY(
        ps_integrand_number(self, "sigma", values[0], LEAST_SIGMA, LARGEST_SIGMA, &sigma, error));
    PS_TRY(ps_integrand_vector(self, "centre", values[1], 0, 1, &self->numbers[GAUSSIAN_CENTRE],
                               error));
    if (strcmp(values[2], "yes") != 0 && strcmp(values[2], "no") != 0) {
        return ps_integrand_fail(self, "cut", values[2], "yes or no", error);
    }
    const bool cut = strcmp(values[2], "yes") == 0;
    self->own = cut ? self : NULL;
    self->numbers[GAUSSIAN_RATE] = 0.5 / (sigma * sigma);
    self->numbers[GAUSSIAN_IMAGES] = cut ? 0 : num_images(sigma);
    self->numbers[GAUSSIAN_RATIO] = exp(-2 * self->numbers[GAUSSIAN_RATE]);
    return PSPEC_OK;
}

/* ---- one axis ------------------------------------------------------------------------------ */

/* exp(z^2) erfc(z) for Re z > 0 by Laplace's continued fraction, from a number of terms that makes
 * the rest less than rounding for |z| >= 0.35, the least that is asked for. */
static double complex scaled_erfc(double complex z) {
    const int num_terms = 2000;
    double complex below = z;
    for (int n = num_terms; n > 0; n--) {
        below = z + n / 2.0 / below;
    }
    return 1 / (sqrt(PS_PI) * below);
}

/* int exp(-t^2/(2 sigma^2)) cos(2 pi k t) over the line, or from -1/2 to 1/2. Of the line what lies
 * beyond 1/2 on both sides is subtracted. */
static double axis_coefficient(double sigma, double k, bool cut) {
    const double width = sqrt(PS_TWO_PI) * sigma;
    const double line = width * exp(-2 * PS_PI * PS_PI * sigma * sigma * k * k);
    if (!cut) {
        return line;
    }
    const double edge = 0.5 / (sqrt(2) * sigma);
    if (k == 0) {
        return width * erf(edge);
    }
    const double complex z = edge - I * sqrt(2) * PS_PI * sigma * k;
    const double sign = fmod(fabs(k), 2) == 1 ? -1 : 1;
    return line - width * exp(-edge * edge) * sign * creal(scaled_erfc(z));
}

/* ---- all of it ----------------------------------------------------------------------------- */

static double integral(const ps_integrand *self) {
    return pow(axis_coefficient(sigma_of(self), 0, is_cut(self)), self->place.dimension);
}

/* int f(t) f(t + x) of one axis, f on the circle. */
static double axis_correlation(const ps_integrand *self, double x) {
    const double sigma = sigma_of(self);
    const double half_width = sqrt(PS_PI) * sigma;
    const double apart = fabs(x - rint(x));
    double sum = 0;
    if (!is_cut(self)) {
        const double reach = num_images(sqrt(2) * sigma);
        for (double n = -reach; n <= reach; n += 1) {
            sum += exp(-(apart + n) * (apart + n) / (4 * sigma * sigma));
        }
        return half_width * sum;
    }
    /* Two intervals of length 1 that are `apart`, or 1 - apart, from each other. */
    for (int i = 0; i < 2; i++) {
        const double shift = i == 0 ? apart : 1 - apart;
        sum += exp(-shift * shift / (4 * sigma * sigma)) * erf((1 - shift) / (2 * sigma));
    }
    return half_width * sum;
}

static double correlation(const ps_integrand *self, const double *x) {
    double product = 1;
    for (unsigned i = 0; i < self->place.dimension; i++) {
        product *= axis_correlation(self, x[i]);
    }
    return product;
}

static double energy(const ps_integrand *self) {
    const double whole = integral(self);
    return pow(axis_correlation(self, 0), self->place.dimension) - whole * whole;
}

static int64_t largest_component(const int32_t *vectors, size_t num) {
    int64_t largest = 0;
    for (size_t i = 0; i < num; i++) {
        const int64_t k = vectors[i] < 0 ? -(int64_t)vectors[i] : vectors[i];
        largest = k > largest ? k : largest;
    }
    return largest;
}

/* Squares of one axis, by |k|; components are few, vectors many. */
static pspec_status powers(const ps_integrand *self, const int32_t *vectors, size_t num,
                           double *out, ps_error *error) {
    const unsigned dimension = self->place.dimension;
    const int64_t largest = largest_component(vectors, num * dimension);
    double *squares = NULL;
    PS_TRY(PS_NEW(&squares, (size_t)largest + 1, "coefficients of a Gaussian", error));
    for (int64_t k = 0; k <= largest; k++) {
        const double f = axis_coefficient(sigma_of(self), (double)k, is_cut(self));
        squares[k] = f * f;
    }
    for (size_t i = 0; i < num; i++) {
        double product = 1;
        for (unsigned axis = 0; axis < dimension; axis++) {
            const int64_t k = vectors[i * dimension + axis];
            product *= squares[k < 0 ? -k : k];
        }
        out[i] = product;
    }
    free(squares);
    return PSPEC_OK;
}

/* With g(k) = exp(-4 pi^2 sigma^2 k^2) of one axis and its sums S over all k and R beyond K, at
 * most d R S^(d-1) of S^d - 1 lies outside of the box. R is less than a geometric series. */
static double share_beyond(double rate, double largest, double others, unsigned dimension) {
    const double next = largest + 1;
    const double rest = 2 * exp(-rate * next * next) / -expm1(-rate * (2 * next + 1));
    const double all = expm1(dimension * log1p(others)); /* S = 1 + others */
    return dimension * rest * pow(1 + others, dimension - 1.0) / all;
}

/* The jumps of what is cut have a spectrum without an end. */
static double reach(const ps_integrand *self) {
    const double sigma = sigma_of(self);
    const double rate = 4 * PS_PI * PS_PI * sigma * sigma;
    double others = 0; /* 2 sum g(k) over k >= 1 */
    double term = 1;
    if (is_cut(self)) {
        return INFINITY;
    }
    for (double k = 1; term > PS_BEYOND_REACH * others; k += 1) {
        term = 2 * exp(-rate * k * k);
        others += term;
    }
    double largest = 1;
    while (share_beyond(rate, largest, others, self->place.dimension) > PS_BEYOND_REACH) {
        largest += 1;
    }
    return largest;
}

/* Of all of space: what the images add is in the sum over whole k alone. */
static double radial(const ps_integrand *self, double k) {
    const double rate = 4 * PS_PI * PS_PI * sigma_of(self) * sigma_of(self);
    const double whole = integral(self);
    return whole * whole * exp(-rate * k * k);
}

static double square(const ps_integrand *self) {
    return pow(sqrt(PS_PI) * sigma_of(self), self->place.dimension);
}

static bool is_isotropic(const ps_integrand *self) {
    return !is_cut(self);
}

static const char *note(const ps_integrand *self) {
    return is_cut(self) ? "cut at the distance 1/2 from its centre on every axis"
                        : "summed over its periodic images";
}

PS_INTEGRAND_VALUES(gaussian_value)

const ps_integrand_kind ps_integrand_gaussian = {
    .name = "gaussian",
    .aliases = "gauss",
    .summary = "exp(-|x - c|^2/(2 sigma^2)), summed over its periodic images",
    .kernel = "gaussian",
    .domains = PS_INTEGRAND_ON(PS_SAMPLES_TORUS),
    .least = 1,
    .most = PS_MAX_DIMENSION,
    .parameters = {{"sigma", "0.0625", "1e-4 to 1"},
                   {"centre", "0.5", "one number, or one for each axis, as 0.5x0.25"},
                   {"cut", "no", "yes: only the nearest image, with jumps half a period away"}},
    .create = create,
    .integral = integral,
    .energy = energy,
    .powers = powers,
    .values = values,
    .correlation = correlation,
    .is_isotropic = is_isotropic,
    .reach = reach,
    .radial = radial,
    .whole_square = square,
    .note = note,
};
