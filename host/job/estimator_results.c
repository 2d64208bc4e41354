/* What an estimator has found. */
#include "job/estimator_private.h"

double ps_estimator_error_at(const ps_estimator *self, double mean_power) {
    if (self->engine_state != NULL && self->options.engine->error_of_state != NULL) {
        return self->options.engine->error_of_state(self->engine_state, mean_power);
    }
    const ps_device_limits *limits =
        self->device != NULL ? ps_device_get_limits(self->device) : NULL;
    return self->options.engine->error(&self->options.problem, limits, self->options.precision,
                                       mean_power);
}

static pspec_status require_realizations(const ps_estimator *self, ps_error *error) {
    return self->totals.num_realizations > 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT, "there are no point sets to take a spectrum of");
}

pspec_status ps_estimator_spectrum(ps_estimator *estimator, ps_spectrum *out, ps_error *error) {
    const ps_pattern_totals *totals = &estimator->totals;
    PS_TRY(require_realizations(estimator, error));
    const double mean_points = totals->sum_points / (double)totals->num_realizations;
    const double factor = estimator->options.normalization == PSPEC_NORMALIZATION_POWER
                              ? mean_points / estimator->reference_points
                              : 1;
    return ps_spectrum_create(out, estimator->options.problem.frequencies, &estimator->bins,
                              estimator->accumulator, factor, totals,
                              estimator->options.want_frequencies, error);
}

pspec_status ps_estimator_sums(ps_estimator *estimator, ps_spectrum_sums *out, ps_error *error) {
    const ps_estimator_options *options = &estimator->options;
    PS_TRY(require_realizations(estimator, error));
    PS_TRY(ps_spectrum_sums_create(out, options->problem.frequencies, estimator->bins.num, error));
    out->exact_shells = options->exact_shells;
    out->normalization = options->normalization;
    out->reference_points =
        options->normalization == PSPEC_NORMALIZATION_POWER ? estimator->reference_points : 1;
    out->totals = estimator->totals;
    out->error = ps_estimator_accuracy(estimator).error;
    const pspec_status status =
        ps_accumulator_sums(estimator->accumulator, out->bins, out->powers, error);
    if (status != PSPEC_OK) {
        ps_spectrum_sums_free(out);
    }
    return status;
}

const ps_bins *ps_estimator_bins(const ps_estimator *estimator) {
    return &estimator->bins;
}

ps_accuracy ps_estimator_accuracy(const ps_estimator *estimator) {
    ps_accuracy accuracy = estimator->accuracy;
    accuracy.error = ps_estimator_error_at(estimator, accuracy.largest_mean_power);
    return accuracy;
}

void ps_estimator_describe(const ps_estimator *estimator, ps_text *text) {
    if (estimator->engine_state != NULL) {
        estimator->options.engine->describe(estimator->engine_state, text);
    }
}
