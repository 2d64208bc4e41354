/* What an estimator has found. */
#include "device/kind.h"
#include "engines/error_units.h"
#include "jobs/estimator_private.h"
#include "math/larger.h"

#include <math.h>

/* In the engine's units; of an engine that is still to be made again, what is planned for such
 * powers. */
static double own_error(const ps_estimator *self, double mean_power, double share) {
    const ps_engine *engine = self->options.engine;
    if (self->engine_state != NULL) {
        return engine->error_of_state(self->engine_state, mean_power, share);
    }
    const ps_device_limits *limits = ps_device_get_limits(self->device);
    ps_problem own = ps_engine_problem(engine, &self->options.problem); /* as it was planned */
    own.weight_share = share;
    own.expected_power = mean_power;
    return engine->survey(&own, limits, self->options.precision).error;
}

static double error_for_share(const ps_estimator *self, double mean_power, double share) {
    ps_problem problem = self->options.problem;
    problem.weight_share = share;
    return ps_engine_error_in(self->options.engine, &problem, own_error(self, mean_power, share));
}

/* The error of the engine for sets of that mean power (ps_survey.error), in the units of the
 * problem's tolerance. */
static double error_at(const ps_estimator *self, double mean_power) {
    return error_for_share(self, mean_power, self->accuracy.largest_share);
}

double ps_estimator_error_of(const ps_estimator *self, double mean_power,
                             const ps_pattern_sums *sums) {
    const double size = sums->weight_size_sum;
    return error_for_share(self, mean_power, sums->weight_square_sum / (size * size));
}

static pspec_status require_realizations(const ps_estimator *self, ps_error *error) {
    return self->totals.num_realizations > 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT, "there are no point sets to take a spectrum of");
}

ps_pattern_totals ps_estimator_totals(const ps_estimator *self) {
    const ps_running_sums *const sums = &self->total_sums;
    const ps_sums weights = ps_running_sums_get(sums, PS_TOTAL_WEIGHTS);
    ps_pattern_totals totals = self->totals;
    totals.points = ps_running_sums_get(sums, PS_TOTAL_POINTS);
    totals.sample_sizes = ps_running_sums_get(sums, PS_TOTAL_SAMPLE_SIZES);
    totals.sum_weights = weights.sum + weights.sum_low;
    return totals;
}

/* From the units of rows to those of the result. */
static double find_factor(const ps_estimator *self) {
    const ps_pattern_totals totals = ps_estimator_totals(self);
    return ps_spectrum_factor(self->options.normalization, &totals, self->reference_points);
}

pspec_status ps_estimator_spectrum(ps_estimator *estimator, ps_spectrum *out, ps_error *error) {
    PS_TRY(require_realizations(estimator, error));
    PS_TRY(ps_estimator_settle(estimator, error));
    const ps_pattern_totals totals = ps_estimator_totals(estimator);
    return ps_spectrum_create(out, estimator->options.problem.frequencies, &estimator->bins,
                              estimator->accumulator, find_factor(estimator), &totals,
                              estimator->options.want_frequencies, error);
}

static void bring_to_units(const ps_estimator *self, ps_mean *means, size_t num) {
    const double factor = find_factor(self);
    for (size_t i = 0; i < num; i++) {
        means[i].mean *= factor;
        means[i].standard_error *= factor;
    }
}

pspec_status ps_estimator_bin_means(ps_estimator *estimator, ps_mean *means, ps_error *error) {
    PS_TRY(require_realizations(estimator, error));
    PS_TRY(ps_estimator_settle(estimator, error));
    PS_TRY(ps_accumulator_bins(estimator->accumulator, means, error));
    bring_to_units(estimator, means, estimator->bins.num);
    return PSPEC_OK;
}

pspec_status ps_estimator_weighted(ps_estimator *estimator, ps_mean *means, ps_error *error) {
    PS_TRY(require_realizations(estimator, error));
    PS_TRY(ps_estimator_settle(estimator, error));
    ps_accumulator_weighted(estimator->accumulator, means);
    bring_to_units(estimator, means, estimator->options.num_weighted);
    return PSPEC_OK;
}

const ps_block_sums *ps_estimator_weighted_blocks(const ps_estimator *estimator) {
    return ps_accumulator_weighted_blocks(estimator->accumulator);
}

/* From what errors of ranges are put together. */
static void find_amplitude_error(const ps_estimator *self, ps_spectrum_sums *out) {
    out->largest_share = self->accuracy.largest_share;
    out->largest_power = ps_accumulator_largest(self->accumulator);
    if (self->options.problem.measure == PS_OF_PAIR_SUMS && !self->options.engine->sums_pairs) {
        out->amplitude_error = own_error(self, out->largest_power, out->largest_share);
    }
}

static pspec_status find_sums(ps_estimator *self, ps_spectrum_sums *out, ps_error *error) {
    if (self->options.is_range) {
        find_amplitude_error(self, out);
        PS_TRY(ps_estimator_nodes(self, &out->nodes, error));
        ps_spectrum_sums_flatten(out);
        return PSPEC_OK;
    }
    out->totals = ps_estimator_totals(self);
    for (size_t i = 0; out->c2 != NULL && i < out->frequencies.num; i++) {
        out->c2[i] = ps_running_sums_get(&self->c2.sums, i);
    }
    return ps_accumulator_sums(self->accumulator, out->bins, out->powers, error);
}

pspec_status ps_estimator_sums(ps_estimator *estimator, ps_spectrum_sums *out, ps_error *error) {
    const ps_estimator_options *options = &estimator->options;
    PS_TRY(require_realizations(estimator, error));
    PS_TRY(ps_estimator_settle(estimator, error));
    PS_TRY(ps_spectrum_sums_create(out, options->problem.frequencies, estimator->bins.num,
                                   options->want_frequencies, options->want_c2, error));
    const ps_accuracy accuracy = ps_estimator_accuracy(estimator);
    out->normalization = options->normalization;
    out->reference_points = estimator->reference_points;
    out->totals = estimator->totals;
    out->error = accuracy.error;
    out->self_check = accuracy.was_checked ? accuracy.self_check : NAN;
    out->length_error = accuracy.length_error;
    const pspec_status status = find_sums(estimator, out, error);
    if (status != PSPEC_OK) {
        ps_spectrum_sums_free(out);
    }
    return status;
}

void ps_estimator_c2(const ps_estimator *estimator, ps_mean *means) {
    ps_pair_sums_finish(&estimator->c2, means);
}

const ps_bins *ps_estimator_bins(const ps_estimator *estimator) {
    return &estimator->bins;
}

pspec_status ps_estimator_settle(ps_estimator *estimator, ps_error *error) {
    PS_TRY(ps_estimator_add_pending(estimator, error));
    return ps_accumulator_settle(estimator->accumulator, error);
}

ps_accuracy ps_estimator_accuracy(const ps_estimator *estimator) {
    ps_accuracy accuracy = estimator->accuracy;
    accuracy.largest_mean_power =
        ps_larger(ps_accumulator_largest(estimator->accumulator), accuracy.largest_mean_power);
    accuracy.error =
        ps_larger(error_at(estimator, accuracy.largest_mean_power), accuracy.error); /* of others */
    accuracy.largest_points = estimator->totals.largest_points;
    return accuracy;
}

/* The error is that of engines which may be others (--mixed). */
enum { LARGEST_POWER, LARGEST_SHARE, LARGEST_LENGTH_ERROR, LARGEST_POINTS, LARGEST_ERROR };

pspec_status ps_estimator_measure(ps_estimator *estimator, double numbers[PS_NUM_MEASURED],
                                  ps_error *error) {
    PS_TRY(ps_estimator_settle(estimator, error));
    const ps_accuracy accuracy = ps_estimator_accuracy(estimator);
    numbers[LARGEST_POWER] = accuracy.largest_mean_power;
    numbers[LARGEST_SHARE] = accuracy.largest_share;
    numbers[LARGEST_LENGTH_ERROR] = accuracy.length_error;
    numbers[LARGEST_POINTS] = (double)accuracy.largest_points;
    numbers[LARGEST_ERROR] = accuracy.error;
    return PSPEC_OK;
}

void ps_estimator_take_measured(ps_estimator *estimator, const double numbers[PS_NUM_MEASURED]) {
    ps_accuracy *const own = &estimator->accuracy;
    ps_pattern_totals *const totals = &estimator->totals;
    own->largest_mean_power = ps_larger(own->largest_mean_power, numbers[LARGEST_POWER]);
    own->error = ps_larger(own->error, numbers[LARGEST_ERROR]);
    own->largest_share = fmax(own->largest_share, numbers[LARGEST_SHARE]);
    own->length_error = fmax(own->length_error, numbers[LARGEST_LENGTH_ERROR]);
    if (numbers[LARGEST_POINTS] > (double)totals->largest_points) {
        totals->largest_points = (size_t)numbers[LARGEST_POINTS];
    }
}

void ps_estimator_describe(const ps_estimator *estimator, ps_text *text) {
    const ps_engine *const engine = estimator->options.engine;
    if (estimator->engine_state == NULL) {
        return;
    }
    engine->describe(estimator->engine_state, text);
    if (engine->needs_device) {
        const ps_device_kind kind = ps_device_kind_of(ps_device_get_limits(estimator->device));
        ps_text_append(text, "%s%s", kind.probed[0] != '\0' ? " on " : "", kind.probed);
    }
}
