#include "trials/trials.h"

#include "base/memory.h"
#include "math/neumaier.h"
#include "math/pi.h"
#include "trials/ways.h"

#include <math.h>
#include <stdlib.h>

struct ps_trials {
    const ps_integrand *integrand;
    ps_trials_options options;
    ps_device_trials *device; /* NULL: on the host */
};

bool ps_trials_fit_device(const ps_integrand *integrand, ps_precision precision,
                          const ps_device *device) {
    return device != NULL && ps_integrand_kernel(integrand, precision == PS_DOUBLE) != NULL &&
           integrand->num_bytes <= ps_device_get_limits(device)->max_allocation_bytes &&
           (precision == PS_SINGLE ||
            (precision == PS_DOUBLE && ps_device_get_limits(device)->has_fp64));
}

pspec_status ps_trials_create(ps_trials **out, const ps_integrand *integrand,
                              const ps_trials_options *options, ps_device *device,
                              ps_error *error) {
    ps_trials *self = NULL;
    *out = NULL;
    if (options->batch == 0 || options->most_points == 0 || options->num_trials == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "trials of %zu sets at a time, %zu points, %zu times each: none may be 0",
                       options->batch, options->most_points, options->num_trials);
    }
    PS_TRY(PS_NEW(&self, 1, "trials", error));
    self->integrand = integrand;
    self->options = *options;
    if (ps_trials_fit_device(integrand, options->precision, device)) {
        const pspec_status status =
            ps_device_trials_create(&self->device, integrand, options, device, error);
        if (status != PSPEC_OK) {
            ps_trials_destroy(self);
            return status;
        }
    }
    *out = self;
    return PSPEC_OK;
}

void ps_trials_destroy(ps_trials *trials) {
    if (trials != NULL) {
        ps_device_trials_destroy(trials->device);
    }
    free(trials);
}

bool ps_trials_is_on_device(const ps_trials *trials) {
    return trials->device != NULL;
}

double ps_trials_bytes(const ps_integrand *integrand, const ps_trials_options *options,
                       const ps_device *device) {
    return (double)ps_integrand_table_bytes(integrand) +
           (ps_trials_fit_device(integrand, options->precision, device)
                ? ps_device_trials_bytes(integrand, options, device)
                : 0);
}

/* ---- run ------------------------------------------------------------------------------------- */

static pspec_status check_pattern(const ps_trials *self, const pspec_pattern *pattern, size_t index,
                                  ps_error *error) {
    if (pattern->dimension != self->integrand->place.dimension) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "set %zu has %u numbers per point, and its integrand %u", index + 1,
                       pattern->dimension, self->integrand->place.dimension);
    }
    if (pattern->num_points == 0 || pattern->num_points > self->options.most_points) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "set %zu has %zu points, and its trials were made for 1 to %zu", index + 1,
                       pattern->num_points, self->options.most_points);
    }
    return PSPEC_OK;
}

/* The volume of the domain over W. */
static pspec_status scale_of(const ps_trials *self, const pspec_pattern *pattern, size_t index,
                             double *scale, ps_error *error) {
    static const double volumes[] = {[PS_SAMPLES_TORUS] = 1,
                                     [PS_SAMPLES_SPHERE] = PS_FOUR_PI,
                                     [PS_SAMPLES_HEMISPHERE] = PS_TWO_PI};
    ps_neumaier total = {0, 0};
    double sum = (double)pattern->num_points;
    if (pattern->weights != NULL) {
        for (size_t j = 0; j < pattern->num_points; j++) {
            ps_neumaier_add(&total, pattern->weights[j]);
        }
        sum = ps_neumaier_value(&total);
    }
    if (sum == 0 || !isfinite(sum)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "set %zu has weights whose sum is %g, and an estimate is divided by it",
                       index + 1, sum);
    }
    *scale = volumes[self->integrand->place.where] / sum;
    return PSPEC_OK;
}

static pspec_status find_sums(ps_trials *self, const ps_batch *batch, const double *moves,
                              double *sums, ps_error *error) {
    const size_t num_trials = self->options.num_trials;
    const size_t numbers = num_trials * ps_trials_move_numbers(self->integrand);
    if (self->device == NULL) {
        ps_host_trials_sums(self->integrand, batch->patterns, batch->num_patterns, num_trials,
                            moves, sums);
        const ps_error *const failure = ps_integrand_failure(self->integrand);
        return failure == NULL || failure->status == PSPEC_OK
                   ? PSPEC_OK
                   : ps_fail(error, failure->status, "%s", failure->message);
    }
    for (size_t done = 0; done < batch->num_patterns; done += self->options.batch) {
        const ps_batch part = ps_batch_part(batch, done, self->options.batch);
        PS_TRY(ps_device_trials_sums(self->device, &part,
                                     moves != NULL ? moves + done * numbers : NULL,
                                     sums + done * num_trials, error));
    }
    return PSPEC_OK;
}

pspec_status ps_trials_run(ps_trials *trials, const ps_batch *batch, const double *moves,
                           double *estimates, ps_error *error) {
    const size_t num_trials = trials->options.num_trials;
    for (size_t i = 0; i < batch->num_patterns; i++) {
        PS_TRY(check_pattern(trials, &batch->patterns[i], i, error));
    }
    PS_TRY(find_sums(trials, batch, moves, estimates, error));
    for (size_t i = 0; i < batch->num_patterns; i++) {
        double scale = 0;
        PS_TRY(scale_of(trials, &batch->patterns[i], i, &scale, error));
        for (size_t t = 0; t < num_trials; t++) {
            estimates[i * num_trials + t] *= scale;
        }
    }
    return PSPEC_OK;
}
