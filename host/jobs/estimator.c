#include "jobs/estimator_private.h"

#include "base/memory.h"
#include "jobs/self_check.h"

#include <math.h>
#include <stdlib.h>

/* ---- create ------------------------------------------------------------------------------ */

static pspec_status create_accumulator(ps_estimator *self, ps_error *error) {
    const ps_estimator_options *options = &self->options;
    const ps_frequencies *set = options->problem.frequencies;
    const bool is_on_device = options->engine->needs_device && !options->engine->rows_on_host;
    const ps_accumulator_options accumulator = {
        .bins = &self->bins,
        .num_frequencies = set->num,
        .slots = self->slots,
        .stride = ps_engine_stride(options->engine, self->engine_state, set->num),
        .batch = self->batch,
        .expected = options->problem.num_realizations,
        .is_on_device = is_on_device,
        .precision = options->precision == PS_SINGLE && is_on_device ? PS_SINGLE : PS_DOUBLE,
        .lanes = is_on_device
                     ? ps_engine_lanes(ps_device_get_limits(self->device), options->precision)
                     : 1,
        .want_frequencies = options->want_frequencies,
        .mean_only = options->mean_only,
        .no_frequency_errors = options->no_frequency_errors,
        .weights = options->weights,
        .num_weighted = options->num_weighted,
        .forms_bins = options->forms_bins,
        .observer = {options->makes_rows ? ps_estimator_put_powers : NULL, self},
    };
    PS_TRY(ps_accumulator_create(&self->accumulator, &accumulator, self->device, error));
    return self->device != NULL ? ps_device_build(self->device, error) : PSPEC_OK;
}

/* Engine and accumulator, for half as many realizations as long as memory is refused to either. */
static pspec_status create_parts(ps_estimator *self, ps_error *error) {
    for (;;) {
        PS_TRY(ps_estimator_make_engine(self, error));
        ps_engine_slots(self->options.engine, self->engine_state,
                        self->options.problem.frequencies->num, self->slots);
        const pspec_status status = create_accumulator(self, error);
        if (status != PSPEC_ERROR_MEMORY || self->batch == 1) {
            return status;
        }
        ps_accumulator_destroy(self->accumulator); /* there is one where its kernels were refused */
        self->accumulator = NULL;
        ps_estimator_halve_batch(self);
    }
}

static pspec_status create_arrays(ps_estimator *self, ps_error *error) {
    const ps_frequencies *set = self->options.problem.frequencies;
    PS_TRY(ps_bins_create(&self->bins, set, error));
    PS_TRY(PS_NEW(&self->slots, set->num, "slots", error));
    PS_TRY(PS_NEW(&self->scales, self->batch, "scales", error));
    PS_TRY(PS_NEW(&self->units, self->batch, "units of powers", error));
    PS_TRY(PS_NEW(&self->exponents, self->batch, "exponents", error));
    PS_TRY(PS_NEW(&self->sums, self->batch, "sums of weights", error));
    const uint64_t expected = self->options.problem.num_realizations;
    PS_TRY(ps_running_sums_create(&self->total_sums, PS_NUM_TOTALS, expected, false, error));
    return self->options.want_c2 ? ps_pair_sums_create(&self->c2, set, self->batch, expected,
                                                       self->options.observer, error)
                                 : PSPEC_OK;
}

pspec_status ps_estimator_create(ps_estimator **out, const ps_estimator_options *options,
                                 ps_device *device, ps_error *error) {
    *out = NULL;
    ps_estimator *self = NULL;
    PS_TRY(PS_NEW(&self, 1, "an estimator", error));
    self->options = *options;
    self->device = device;
    self->batch = options->batch;
    self->segment = options->first;
    self->reference_points = options->normalization == PSPEC_NORMALIZATION_INTEGRAL
                                 ? (double)options->problem.num_points
                                 : 1;
    pspec_status status = create_arrays(self, error);
    if (status == PSPEC_OK) {
        status = create_parts(self, error);
    }
    if (status != PSPEC_OK) {
        ps_estimator_destroy(self);
        return status;
    }
    *out = self;
    return PSPEC_OK;
}

void ps_estimator_destroy(ps_estimator *estimator) {
    if (estimator == NULL) {
        return;
    }
    ps_engine_destroy(estimator->options.engine, estimator->engine_state);
    ps_accumulator_destroy(estimator->accumulator);
    ps_bins_free(&estimator->bins);
    free(estimator->slots);
    free(estimator->scales);
    free(estimator->units);
    free(estimator->exponents);
    free(estimator->sums);
    free(estimator->beginning);
    ps_pair_sums_free(&estimator->c2);
    ps_running_sums_free(&estimator->total_sums);
    ps_sum_nodes_free(&estimator->nodes);
    free(estimator);
}

size_t ps_estimator_batch(const ps_estimator *estimator) {
    return estimator->batch;
}

uint64_t ps_estimator_num_realizations(const ps_estimator *estimator) {
    return estimator->totals.num_realizations;
}

static size_t count_beginning(const ps_device_sets *sets) {
    const uint64_t all = ps_device_sets_points(sets);
    return all < PS_SELF_CHECK_POINTS ? (size_t)all : PS_SELF_CHECK_POINTS;
}

pspec_status ps_estimator_use_sets(ps_estimator *estimator, ps_device_sets *sets, ps_error *error) {
    const size_t num = count_beginning(sets);
    estimator->sets = sets;
    return estimator->options.self_check
               ? PS_NEW(&estimator->beginning, num * ps_device_sets_dimension(sets), "points",
                        error)
               : PSPEC_OK;
}

/* ---- add --------------------------------------------------------------------------------- */

/* Checks a pattern that will be realization number `realization`, counted from 0. */
static pspec_status check(const ps_estimator *self, const pspec_pattern *pattern,
                          uint64_t realization, ps_pattern_sums *sums, ps_error *error) {
    const ps_estimator_options *options = &self->options;
    return ps_pattern_check(pattern, options->problem.frequencies, options->normalization,
                            realization, sums, error);
}

/* Nothing but the coordinates could be wrong, and the engine sees them anyway. (Bins relative to a
 * number of points want all sets to have it.) */
static bool may_leave_checks(const ps_estimator *self, const pspec_pattern *patterns,
                             size_t num_patterns) {
    const unsigned dimension = self->options.problem.frequencies->dimension;
    const bool is_relative = self->options.problem.frequencies->bins.kind == PS_BINS_RELATIVE;
    bool is_plain = self->options.engine->checks_points && !is_relative;
    for (size_t r = 0; r < num_patterns; r++) {
        is_plain = is_plain && patterns[r].dimension == dimension && patterns[r].num_points > 0 &&
                   patterns[r].points != NULL && patterns[r].weights == NULL;
    }
    return is_plain;
}

static pspec_status check_all(const ps_estimator *self, const pspec_pattern *patterns,
                              size_t num_patterns, ps_error *error) {
    pspec_status status = PSPEC_OK;
    for (size_t r = 0; r < num_patterns && status == PSPEC_OK; r++) {
        ps_pattern_sums sums = {0};
        status = check(self, &patterns[r], ps_estimator_position(self) + r, &sums, error);
    }
    return status;
}

/* What sums of weights are where all weights are 1. */
static ps_pattern_sums plain_sums(const pspec_pattern *pattern) {
    const double num = (double)pattern->num_points;
    return (ps_pattern_sums){
        .is_plain = true, .weight_sum = num, .weight_square_sum = num, .weight_size_sum = num};
}

/* The device makes the points of a batch. */
static bool are_made(const ps_estimator *self, const pspec_pattern *patterns) {
    return self->sets != NULL && patterns[0].points == NULL;
}

/* What a pattern must be, beside its points where others see to them. */
static pspec_status check_one(const ps_estimator *self, const pspec_pattern *patterns, size_t r,
                              ps_pattern_sums *sums, ps_error *error) {
    const uint64_t realization = ps_estimator_position(self) + r;
    return are_made(self, patterns)
               ? ps_pattern_check_size(self->options.problem.frequencies, patterns[r].num_points,
                                       realization, error)
               : check(self, &patterns[r], realization, sums, error);
}

/* Scales of the patterns of a batch, and the largest number of points. */
static pspec_status prepare(ps_estimator *self, const pspec_pattern *patterns, size_t num_patterns,
                            uint64_t *longest, ps_error *error) {
    *longest = 0;
    self->leaves_checks = may_leave_checks(self, patterns, num_patterns);
    for (size_t r = 0; r < num_patterns; r++) {
        ps_pattern_sums sums = plain_sums(&patterns[r]);
        if (!self->leaves_checks) {
            PS_TRY(check_one(self, patterns, r, &sums, error));
        }
        ps_estimator_set_sums(self, r, patterns[r].num_points, &sums);
        *longest = patterns[r].num_points > *longest ? patterns[r].num_points : *longest;
    }
    return PSPEC_OK;
}

ps_batch ps_estimator_make_batch(const ps_estimator *self, const pspec_pattern *patterns,
                                 size_t num_patterns) {
    return (ps_batch){.num_patterns = num_patterns,
                      .patterns = patterns,
                      .scales = self->scales,
                      .exponents = self->exponents,
                      .sets = are_made(self, patterns) ? self->sets : NULL,
                      .realization = ps_estimator_position(self),
                      .should_stop = self->options.should_stop,
                      .payload = self->options.payload};
}

/* What a sum of all weights is rounded by, in units of sqrt(V); 0 on the torus, where frequency 0
 * is kept out of the others, and in extended precision. */
static double sum_rounding(const ps_estimator *self) {
    const ps_pattern_sums *sums = &self->sums[0];
    const ps_precision precision = self->options.precision;
    const bool on_sphere = self->options.problem.frequencies->kind == PS_FREQUENCIES_DEGREES;
    const double roundoff = precision == PS_SINGLE ? 0x1p-24 : precision == PS_DOUBLE ? 0x1p-53 : 0;
    return on_sphere ? roundoff * sums->weight_size_sum / sqrt(sums->weight_square_sum) : 0;
}

static pspec_status compare_with_referee(ps_estimator *self, const ps_rows *rows,
                                         const pspec_pattern *pattern, ps_error *error) {
    const ps_problem *problem = &self->options.problem;
    const ps_self_check_input input = {
        .rows = rows,
        .slots = self->slots,
        .frequencies = problem->frequencies,
        .pattern = pattern,
        .exponent = self->exponents[0],
        .scale = self->scales[0],
        .weight_square_sum = self->sums[0].weight_square_sum,
        .size_square = problem->measure == PS_OF_PAIR_SUMS
                           ? self->sums[0].weight_size_sum * self->sums[0].weight_size_sum
                           : 0,
        .engine_error = ps_estimator_error_of(self, 1, &self->sums[0]),
        .sum_rounding = problem->measure == PS_OF_PAIR_SUMS ? 0 : sum_rounding(self),
    };
    return ps_self_check(&input, self->device, &self->accuracy.self_check, error);
}

pspec_status ps_estimator_check_beginning(ps_estimator *self, const pspec_pattern *beginning,
                                          ps_error *error) {
    pspec_pattern pattern = *beginning;
    ps_rows rows = {0};
    const double scale = self->scales[0];
    const ps_pattern_sums sums = self->sums[0];
    pattern.num_points =
        pattern.num_points < PS_SELF_CHECK_POINTS ? pattern.num_points : PS_SELF_CHECK_POINTS;
    if (ps_pattern_check(&pattern, self->options.problem.frequencies, PSPEC_NORMALIZATION_EFFECTIVE,
                         0, &self->sums[0], NULL) != PSPEC_OK) {
        self->sums[0] = sums; /* these weights are all 0: nothing to compare */
        return PSPEC_OK;
    }
    self->exponents[0] = self->sums[0].exponent;
    self->scales[0] = 1 / self->sums[0].weight_square_sum;
    const ps_batch batch = ps_estimator_make_batch(self, &pattern, 1);
    pspec_status status = self->options.engine->run(self->engine_state, &batch, &rows, error);
    if (status == PSPEC_OK) {
        status = ps_rows_wait(&rows, error);
    }
    if (status == PSPEC_OK) {
        status = compare_with_referee(self, &rows, &pattern, error);
    }
    self->scales[0] = scale;
    self->sums[0] = sums;
    self->exponents[0] = sums.exponent;
    return status;
}

/* Runs the engine on one batch that fits; makes a smaller engine when memory is refused (drivers
 * may allocate no sooner than at the first use). */
static pspec_status run_batch(ps_estimator *self, const pspec_pattern *patterns,
                              size_t *num_patterns, ps_rows *rows, ps_error *error) {
    for (;;) {
        *num_patterns = *num_patterns < self->batch ? *num_patterns : self->batch;
        const ps_batch batch = ps_estimator_make_batch(self, patterns, *num_patterns);
        const bool has_coefficients = self->options.coefficients != NULL && *num_patterns == 1;
        const pspec_status status =
            has_coefficients ? ps_estimator_run_with_coefficients(self, &batch, rows, error)
                             : self->options.engine->run(self->engine_state, &batch, rows, error);
        if (status == PSPEC_ERROR_INPUT && self->leaves_checks) {
            PS_TRY(check_all(self, patterns, *num_patterns, error)); /* says which point it is */
        }
        if (status != PSPEC_ERROR_MEMORY || self->batch == 1) {
            return status;
        }
        ps_estimator_halve_batch(self);
        PS_TRY(ps_estimator_make_engine(self, error));
    }
}

/* Memory is taken before anything is added, so that what is pending is not lost where it is
 * refused. */
pspec_status ps_estimator_take(ps_estimator *self, const ps_rows *rows,
                               const pspec_pattern *patterns, size_t num_patterns,
                               ps_error *error) {
    const uint64_t count = self->totals.num_realizations + num_patterns;
    PS_TRY(ps_accumulator_reserve(self->accumulator, count, error));
    PS_TRY(ps_running_sums_reserve(&self->total_sums, count, error));
    PS_TRY(ps_running_sums_reserve(&self->c2.sums, count, error));
    PS_TRY(ps_estimator_add_pending(self, error));
    for (size_t r = 0; r < num_patterns; r++) { /* the error formula needs effective powers */
        self->units[r] = self->scales[r] * self->sums[r].weight_square_sum;
    }
    if (self->options.want_c2) {
        const ps_batch batch = ps_estimator_make_batch(self, patterns, num_patterns);
        ps_pair_sums_begin(&self->c2, &batch);
    }
    self->pending = *rows;
    if (rows->late == NULL || self->options.observer.tell != NULL) {
        PS_TRY(ps_estimator_add_pending(self, error));
    }
    ps_estimator_count_patterns(self, patterns, num_patterns);
    return PSPEC_OK;
}

/* The first batch of a job is compared with the referee once it has run. Of a large pattern only
 * the beginning is compared, and before the pattern runs. */
static bool is_check_due(const ps_estimator *self, const pspec_pattern *patterns, bool is_large) {
    return self->options.self_check && !self->accuracy.was_checked &&
           (patterns[0].num_points > PS_SELF_CHECK_POINTS) == is_large;
}

/* Compares what is due of a batch: before it runs, when rows is NULL, and after it. */
static pspec_status check_itself(ps_estimator *self, const pspec_pattern *patterns, ps_rows *rows,
                                 ps_error *error) {
    if (!is_check_due(self, patterns, rows == NULL)) {
        return PSPEC_OK;
    }
    pspec_pattern first = patterns[0];
    if (are_made(self, patterns)) {
        PS_TRY(ps_device_sets_beginning(self->sets, ps_estimator_position(self),
                                        count_beginning(self->sets), self->beginning, error));
        first.points = self->beginning;
    }
    PS_TRY(rows != NULL ? ps_rows_wait(rows, error) : PSPEC_OK);
    PS_TRY(rows == NULL ? ps_estimator_check_beginning(self, &first, error)
                        : compare_with_referee(self, rows, &first, error));
    self->accuracy.was_checked = true;
    return PSPEC_OK;
}

pspec_status ps_estimator_add(ps_estimator *estimator, const pspec_pattern *patterns,
                              size_t num_patterns, ps_error *error) {
    for (size_t done = 0; done < num_patterns;) {
        const pspec_pattern *const next = patterns + done;
        const size_t rest = num_patterns - done;
        const uint64_t left = ps_estimator_segment_left(estimator);
        size_t taken = rest < estimator->batch ? rest : estimator->batch;
        uint64_t longest = 0;
        ps_rows rows = {0};
        taken = taken < left ? taken : (size_t)left;
        PS_TRY(prepare(estimator, next, taken, &longest, error));
        PS_TRY(ps_estimator_get_ready(estimator, longest, error));
        PS_TRY(check_itself(estimator, next, NULL, error));
        PS_TRY(run_batch(estimator, next, &taken, &rows, error));
        PS_TRY(check_itself(estimator, next, &rows, error));
        const pspec_status status = ps_estimator_take(estimator, &rows, next, taken, error);
        if (status == PSPEC_ERROR_MEMORY && estimator->batch > 1) { /* they were not added */
            ps_estimator_halve_batch(estimator);
            PS_TRY(ps_estimator_make_engine(estimator, error));
            continue;
        }
        PS_TRY(status);
        PS_TRY(ps_estimator_end_segment(estimator, error));
        done += taken;
    }
    return PSPEC_OK;
}

void ps_estimator_reset(ps_estimator *estimator) {
    estimator->pending = (ps_rows){0};
    estimator->totals = (ps_pattern_totals){0};
    estimator->num_elsewhere = 0;
    estimator->accuracy = (ps_accuracy){0};
    if (estimator->options.want_c2) {
        ps_pair_sums_reset(&estimator->c2);
    }
    estimator->total_sums.count = 0;
    ps_estimator_restart_segments(estimator);
    ps_accumulator_reset(estimator->accumulator);
}
