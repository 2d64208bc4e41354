/* A single wave: the estimate of its integral is the real part of S(k)/W, turned by the phase. */
#define PRECISION 64
#include "integrands/wave.h"

#include "integrands/integrand_kind.h"

#define LARGEST_COMPONENT 268435456.0 /* 2^28, that of frequencies */

static pspec_status create(ps_integrand *self, const char *const *values, ps_error *error) {
    double *const k = &self->numbers[WAVE_VECTOR];
    bool is_zero = true;
    PS_TRY(
        ps_integrand_vector(self, "k", values[0], -LARGEST_COMPONENT, LARGEST_COMPONENT, k, error));
    for (unsigned i = 0; i < self->place.dimension; i++) {
        if (k[i] != rint(k[i])) {
            return ps_integrand_fail(self, "k", values[0], "a wave of the torus has whole numbers",
                                     error);
        }
        is_zero = is_zero && k[i] == 0;
    }
    if (is_zero) {
        return ps_integrand_fail(self, "k", values[0], "0 is no wave (constant is one)", error);
    }
    return ps_integrand_number(self, "phase", values[1], -1, 1, &self->numbers[WAVE_PHASE], error);
}

static double integral(const ps_integrand *self) {
    (void)self;
    return 0;
}

static double energy(const ps_integrand *self) {
    (void)self;
    return 0.5;
}

/* f = 1/2 exp(+-2 pi i phase) at k and -k. */
static pspec_status powers(const ps_integrand *self, const int32_t *vectors, size_t num,
                           double *out, ps_error *error) {
    const unsigned dimension = self->place.dimension;
    const double quarter = 0.25;
    (void)error;
    for (size_t i = 0; i < num; i++) {
        bool is_same = true;
        bool is_opposite = true;
        for (unsigned axis = 0; axis < dimension; axis++) {
            const double k = self->numbers[WAVE_VECTOR + axis];
            is_same = is_same && vectors[i * dimension + axis] == k;
            is_opposite = is_opposite && vectors[i * dimension + axis] == -k;
        }
        out[i] = is_same || is_opposite ? quarter : 0;
    }
    return PSPEC_OK;
}

/* cos(2 pi k.x)/2 */
static double correlation(const ps_integrand *self, const double *x) {
    double turns = 0;
    for (unsigned i = 0; i < self->place.dimension; i++) {
        const double k = self->numbers[WAVE_VECTOR + i];
        const double product = k * x[i];
        turns += (product - rint(product)) + fma(k, x[i], -product);
    }
    return cos(PS_TWO_PI * turns) / 2;
}

/* All of it is at k. */
static double reach(const ps_integrand *self) {
    double largest = 0;
    for (unsigned i = 0; i < self->place.dimension; i++) {
        largest = fmax(largest, fabs(self->numbers[WAVE_VECTOR + i]));
    }
    return largest;
}

PS_INTEGRAND_VALUES(wave_value)

const ps_integrand_kind ps_integrand_wave = {
    .name = "wave",
    .aliases = "cosine",
    .summary = "cos(2 pi (k.x + phase))",
    .kernel = "wave",
    .domains = PS_INTEGRAND_ON(PS_SAMPLES_TORUS),
    .least = 1,
    .most = PS_MAX_DIMENSION,
    .parameters = {{"k", "1", "whole numbers, one for each axis, as 3x1, or one for all"},
                   {"phase", "0", "in turns, -1 to 1"}},
    .create = create,
    .integral = integral,
    .energy = energy,
    .powers = powers,
    .values = values,
    .correlation = correlation,
    .reach = reach,
};
