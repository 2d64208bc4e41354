/* The error of an engine for the points of a case, in the units of its formula (engines/engine.h).
 *
 * Powers show | |S| - |S_ref| |, the part of dS along S. Rounding errors have no preferred
 * direction, so sqrt(2) times its root mean square stands for |dS|. On the sphere coefficients show
 * all of it, and powers must not be worse.
 */
#include "verify/stress_sample.h"

#include "base/memory.h"
#include "engines/error_units.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>

typedef struct measurement {
    const ps_stress_sample *sample;
    const ps_engine *engine;
    ps_precision precision;
    ps_device *device;
    ps_problem problem, own; /* as asked, and in the engine's units */
    void *state;
    double *powers;       /* [frequencies]: |S|^2 or Q(l) with weights w 2^-exponent */
    double *coefficients; /* of the sphere: with weights as they are */
} measurement;

/* ---- running ------------------------------------------------------------------------------- */

static pspec_status run_engine(measurement *self, ps_error *error) {
    const ps_stress_sample *sample = self->sample;
    const double scale = 1;
    const ps_batch batch = {.num_patterns = 1,
                            .patterns = &sample->pattern,
                            .scales = &scale,
                            .exponents = &sample->sums.exponent};
    PS_TRY(ps_engine_powers(self->engine, self->state, &batch, sample->frequencies.num,
                            self->device, self->powers, error));
    return self->coefficients != NULL
               ? self->engine->coefficients(self->state, &batch, NULL, self->coefficients, error)
               : PSPEC_OK;
}

static pspec_status prepare(measurement *self, ps_error *error) {
    const ps_stress_sample *sample = self->sample;
    PS_TRY(PS_NEW(&self->powers, sample->frequencies.num, "powers", error));
    if (sample->what->kind == PS_STRESS_SPHERE && self->engine->coefficients != NULL) {
        PS_TRY(PS_NEW(&self->coefficients, ps_num_coefficients(sample->frequencies.max_frequency),
                      "coefficients", error));
    }
    return ps_engine_create(self->engine, &self->state, &self->own, self->precision, 1,
                            self->device, error);
}

/* ---- comparing ----------------------------------------------------------------------------- */

/* In sqrt(V), mean over the modes that were checked; on the sphere sqrt(V / (4 pi)) is one of
 * c_lm. */
static double amplitude_error(const measurement *self) {
    const ps_stress_sample *sample = self->sample;
    const bool has_phases = self->coefficients != NULL;
    double sum = 0;
    double num = 0;
    for (size_t i = 0; i < sample->num_checked; i++) {
        const size_t at = sample->checked[i];
        const double modes = ps_stress_modes(sample, at);
        const double off = sqrt(self->powers[at]) - (double)sample->truth[i];
        sum += modes * off * off;
        num += modes;
    }
    return sqrt((has_phases ? 1 : 2) * sum / num / sample->sums.weight_square_sum);
}

static double coefficient_error(const measurement *self) {
    const ps_stress_sample *sample = self->sample;
    const size_t last = (size_t)sample->frequencies.max_frequency;
    const long double(*truth)[2] = (const long double(*)[2])sample->harmonics;
    long double sum = 0;
    double num = 0;
    for (size_t i = 0; i < sample->num_checked; i++) {
        const size_t l = (size_t)sample->frequencies.vectors[sample->checked[i]];
        for (size_t m = 0; m <= l; m++) {
            const double *c = self->coefficients + m * (2 * last + 1 - m) + 2 * l;
            const long double re = ldexpl(c[0], -sample->sums.exponent) - truth[m][0];
            const long double im = ldexpl(c[1], -sample->sums.exponent) - truth[m][1];
            sum += (m > 0 ? 2 : 1) * (re * re + im * im);
        }
        truth += l + 1;
        num += 2.0 * (double)l + 1;
    }
    return sqrt(PS_FOUR_PI * (double)sum / num / sample->sums.weight_square_sum);
}

static double pairs_error(const measurement *self) {
    const ps_stress_sample *sample = self->sample;
    const double size = sample->sums.weight_size_sum;
    double worst = 0;
    for (size_t i = 0; i < sample->num_checked; i++) {
        const double off =
            fabs((double)(self->powers[sample->checked[i]] - sample->truth[i])) / (size * size);
        worst = off > worst || isnan(off) ? off : worst;
    }
    return worst;
}

/* The mean is the referee's where it has looked at everything, else the engine's own. */
static double mean_power(const measurement *self) {
    const ps_stress_sample *sample = self->sample;
    double sum = 0;
    double num = 0;
    if (sample->mean_power > 0) {
        return sample->mean_power;
    }
    for (size_t i = 0; i < sample->frequencies.num; i++) {
        const double modes = ps_stress_modes(sample, i);
        sum += modes * self->powers[i];
        num += modes;
    }
    return sum / num / sample->sums.weight_square_sum;
}

static double bound_of(const measurement *self) {
    const double power = mean_power(self);
    const double own = self->engine->error_of_state(self->state, power, self->own.weight_share);
    return ps_engine_error_in(self->engine, &self->problem, own);
}

pspec_status ps_stress_measure(const ps_stress_sample *sample, const ps_problem *problem,
                               const ps_engine *engine, ps_precision precision, ps_device *device,
                               double *found, double *bound, ps_error *error) {
    measurement self = {.sample = sample,
                        .engine = engine,
                        .precision = precision,
                        .device = device,
                        .problem = *problem};
    self.own = ps_engine_problem(engine, &self.problem);
    pspec_status status = prepare(&self, error);
    if (status == PSPEC_OK) {
        status = run_engine(&self, error);
    }
    if (status == PSPEC_OK) {
        *found =
            sample->what->kind == PS_STRESS_PAIRS ? pairs_error(&self) : amplitude_error(&self);
        if (self.coefficients != NULL) {
            const double other = coefficient_error(&self);
            *found = isnan(*found) || other <= *found ? *found : other; /* nan stays */
        }
        *bound = bound_of(&self);
    }
    ps_engine_destroy(engine, self.state);
    free(self.powers);
    free(self.coefficients);
    return status;
}
