/* The engine: for some realizations at a time, sort points by cells of the fine grid, make their
 * windows and phases, spread and transform tiles into powers. docs/engines/torus_nufft.md. */
#include "engines/engine.h"

#include "base/memory.h"
#include "device/reals.h"
#include "engines/torus/nufft/choice.h"
#include "engines/torus/nufft/variant.h"

#include <math.h>
#include <stdlib.h>

/* ---- what the planner asks --------------------------------------------------------------- */

/* Why no layout is made for the problem; NULL: nothing speaks against it. */
static const char *refuse(const ps_problem *problem) {
    const ps_frequencies *set = problem->frequencies;
    if (set->kind == PS_FREQUENCIES_LIST) {
        return "full grids only, not lists of frequencies";
    }
    if (problem->harmonics != PS_NO_HARMONICS) {
        return "makes powers only, no coefficients S(k)";
    }
    if (set->dimension > 3) {
        return "up to three dimensions only";
    }
    return problem->num_points > UINT32_MAX ? "too many points for 32-bit places" : NULL;
}

static const char *refuse_layout(const ps_nufft_layout *layout, const ps_device_limits *limits) {
    if (layout->lanes == 0) {
        return "a row or a box of the fine grid does not fit into local memory";
    }
    if (layout->stride > UINT32_MAX) {
        return "too many frequencies for 32-bit slots";
    }
    const bool has_large_buffer =
        layout->largest_buffer > limits->max_allocation_bytes ||
        layout->largest_buffer_per_realization > limits->max_allocation_bytes;
    return has_large_buffer ? "needs a larger buffer than the device allows" : NULL;
}

static ps_work work_of(const ps_nufft_layout *layout, const ps_problem *problem,
                       ps_precision precision) {
    const ps_nufft_variant *const variant = layout->choice.variant;
    const double realizations =
        problem->num_realizations > 0 ? (double)problem->num_realizations : 1;
    return (ps_work){
        .transform_flops =
            realizations * ps_nufft_flops_of_layout(layout, precision, (double)problem->num_points),
        .launches = variant->count_launches(layout, (double)problem->num_points, realizations),
        .programs =
            variant->programs[layout->choice.num_axes > 1] + (layout->order.tile > 0 ? 1 : 0),
        .fixed_bytes = (double)layout->fixed_bytes,
        .host_bytes = (double)layout->host_bytes,
        .twin_bytes = 2.0 * (double)(layout->parts * layout->part_points *
                                     problem->frequencies->dimension * sizeof(uint64_t)),
        .bytes_per_realization = (double)layout->bytes_per_realization,
        .row_bytes = (double)(layout->stride * layout->real_bytes),
        .largest_buffer_per_realization = (double)layout->largest_buffer_per_realization,
        .takes_blocks = variant->launcher->spread != NULL};
}

static ps_survey survey(const ps_problem *problem, const ps_device_limits *limits,
                        ps_precision precision) {
    ps_survey result = {.why_not = refuse(problem)};
    const bool has_device = ps_engine_on_device(limits, precision, &result.why_not);
    if (!has_device || result.why_not != NULL) {
        return result;
    }
    const ps_nufft_layout layout = ps_nufft_layout_make(problem, limits, precision);
    result.why_not = refuse_layout(&layout, limits);
    if (result.why_not == NULL) {
        result.work = work_of(&layout, problem, precision);
        result.error =
            ps_nufft_error(&layout.choice, problem, precision, ps_expected_power(problem));
    }
    return result;
}

static double error_of_state(const void *state, double mean_power, double weight_share) {
    const ps_nufft_state *self = state;
    (void)weight_share;
    return ps_nufft_error(&self->layout.choice, &self->problem, self->precision, mean_power);
}

/* ---- create and destroy ------------------------------------------------------------------ */

static void destroy(void *state) {
    ps_nufft_state *self = state;
    PS_BUFFERS_RELEASE(&self->means, &self->scales, &self->power);
    for (unsigned i = 0; i < PS_NUFFT_MAX_AXES; i++) {
        ps_nufft_plan_free(&self->plans[i]);
    }
    if (self->own != NULL) {
        self->launcher->free(self->own);
    }
    ps_nufft_places_free(&self->places);
    free(self->own);
    free(self->means_of_parts);
}

static pspec_status create_buffers(ps_nufft_state *self, size_t rows, ps_error *error) {
    const ps_nufft_layout *layout = &self->layout;
    const ps_wanted_buffer wanted[] = {
        {&self->means, layout->parts * layout->real_bytes, "means"},
        {&self->scales, rows * layout->real_bytes, "scales"},
        {&self->power, rows * layout->stride * layout->real_bytes, "powers of a batch"}};
    PS_TRY(PS_BUFFERS_CREATE(self->device, wanted, error));
    return ps_buffer_clear(self->device, &self->power, error);
}

static pspec_status create_parts(ps_nufft_state *self, const ps_problem *problem, ps_error *error) {
    const ps_nufft_choice *choice = &self->layout.choice;
    const ps_nufft_launcher *const launcher = self->launcher;
    PS_TRY(PS_NEW(&self->means_of_parts, self->layout.parts, "means", error));
    for (unsigned i = 0; i < choice->num_axes; i++) {
        PS_TRY(ps_nufft_plan_create(&self->plans[i], &choice->axes[i], launcher->has_transforms,
                                    problem->tolerance, self->precision, self->device, error));
    }
    PS_TRY(create_buffers(self, self->batch, error));
    if (launcher->sorts) {
        PS_TRY(ps_nufft_places_create(&self->places, &self->layout, problem->frequencies->dimension,
                                      self->precision, self->device, error));
    }
    PS_TRY(ps_allocate(&self->own, 1, launcher->own_bytes, "an engine", error));
    return launcher->create(self, error);
}

static pspec_status create(void *state, const ps_problem *problem, ps_precision precision,
                           size_t batch, ps_device *device, ps_error *error) {
    ps_nufft_state *const self = state;
    self->device = device;
    self->problem = *problem;
    self->precision = precision;
    self->batch = batch;
    self->layout = ps_nufft_layout_make(problem, ps_device_get_limits(device), precision);
    ps_nufft_layout_shrink(&self->layout, batch);
    self->launcher = self->layout.choice.variant->launcher;
    return create_parts(self, problem, error);
}

static void get_slots(const void *state, uint32_t *slots) {
    const ps_nufft_state *self = state;
    const ps_frequencies *set = self->problem.frequencies;
    for (size_t i = 0; i < set->num; i++) {
        slots[i] = self->layout.choice.variant->slot(
            &self->layout, set->vectors + i * set->dimension, set->dimension);
    }
}

static size_t get_stride(const void *state) {
    return ((const ps_nufft_state *)state)->layout.stride;
}

/* ---- means of cells ---------------------------------------------------------------------- */

/* A sum of weights, and more of them. */
static double add_weights(double sum, const pspec_pattern *pattern, int exponent) {
    if (pattern->weights == NULL) {
        return sum + (double)pattern->num_points;
    }
    for (size_t j = 0; j < pattern->num_points; j++) {
        sum += ldexp(pattern->weights[j], -exponent);
    }
    return sum;
}

/* What frequency 0 leaves in a cell, to be taken off: it then does not round into the others. */
static double mean_of_cells(const ps_nufft_state *self, double weight_sum) {
    const ps_nufft_choice *choice = &self->layout.choice;
    double mean = weight_sum;
    for (unsigned i = 0; i < choice->num_axes; i++) {
        const ps_nufft_axis *axis = &choice->axes[i];
        const double q = i == 0 && choice->stride != 0 ? axis->max_frequency : 0;
        mean *= ps_nufft_window_transform(&axis->window, q / axis->n) / axis->n;
    }
    return mean;
}

static int exponent_of(const ps_batch *batch, size_t pattern) {
    return batch->exponents != NULL ? batch->exponents[pattern] : 0;
}

static pspec_status upload_means(ps_nufft_state *self, const ps_batch *some, ps_error *error) {
    for (size_t r = 0; r < some->num_patterns; r++) {
        self->means_of_parts[r] =
            mean_of_cells(self, add_weights(0, &some->patterns[r], exponent_of(some, r)));
    }
    return ps_reals_write(self->device, &self->means, self->precision, self->means_of_parts,
                          some->num_patterns, error);
}

/* ---- run --------------------------------------------------------------------------------- */

static ps_rows show_rows(const ps_nufft_state *self, size_t num_rows) {
    return (ps_rows){.num_rows = num_rows,
                     .stride = self->layout.stride,
                     .precision = self->precision,
                     .device = self->power};
}

static size_t stream_unit(const void *state) {
    const ps_nufft_state *self = state;
    return self->launcher->spread != NULL ? self->layout.parts * self->layout.part_points : 0;
}

static pspec_status begin_blocks(void *state, ps_error *error) {
    ps_nufft_state *self = state;
    self->sum_of_blocks = 0;
    return self->launcher->begin(self, error);
}

/* Points *first .. of a block, which *first moves behind. */
static pspec_status add_chunk(ps_nufft_state *self, const ps_batch *block, size_t *first,
                              ps_error *error) {
    const pspec_pattern *const whole = &block->patterns[0];
    pspec_pattern parts[PS_NUFFT_MOST_PARTS];
    int exponents[PS_NUFFT_MOST_PARTS];
    size_t num = 0;
    ps_batch chunk = *block;
    chunk.patterns = parts;
    chunk.exponents = exponents;
    chunk.is_one_set = true;
    chunk.first_point += *first;
    for (; num < self->layout.parts && *first < whole->num_points; num++) {
        parts[num] = ps_pattern_part(whole, *first, self->layout.part_points);
        exponents[num] = exponent_of(block, 0);
        *first += parts[num].num_points;
    }
    chunk.num_patterns = num;
    PS_TRY(ps_batch_go_on(block, error));
    PS_TRY(ps_nufft_places_upload(&self->places, &chunk, error));
    PS_TRY(ps_nufft_places_sort(&self->places, num, error));
    return self->launcher->spread(self, num, error);
}

static pspec_status add_block(void *state, const ps_batch *block, ps_error *error) {
    ps_nufft_state *self = state;
    self->sum_of_blocks =
        add_weights(self->sum_of_blocks, &block->patterns[0], exponent_of(block, 0));
    for (size_t first = 0; first < block->patterns[0].num_points;) {
        PS_TRY(add_chunk(self, block, &first, error));
    }
    return PSPEC_OK;
}

static pspec_status finish_blocks(ps_nufft_state *self, const ps_nufft_target *target,
                                  ps_error *error) {
    const double mean = mean_of_cells(self, self->sum_of_blocks);
    PS_TRY(ps_reals_write(self->device, &self->means, self->precision, &mean, 1, error));
    return self->launcher->run(self, 1, target, error);
}

static pspec_status finish_stream(void *state, double scale, ps_rows *rows, ps_error *error) {
    ps_nufft_state *self = state;
    const ps_nufft_target target = {&self->power, &self->scales, 0};
    PS_TRY(ps_reals_write(self->device, &self->scales, self->precision, &scale, 1, error));
    *rows = show_rows(self, 1);
    return finish_blocks(self, &target, error);
}

static const ps_engine_stream stream = {
    .unit = stream_unit, .begin = begin_blocks, .add = add_block, .finish = finish_stream};

/* Points go first: what is written after them waits for the launch before. */
static pspec_status upload(ps_nufft_state *self, const ps_batch *some, ps_error *error) {
    PS_TRY(self->launcher->upload != NULL ? self->launcher->upload(self, some, error)
                                          : ps_nufft_places_upload(&self->places, some, error));
    PS_TRY(upload_means(self, some, error));
    return self->launcher->sorts ? ps_nufft_places_sort(&self->places, some->num_patterns, error)
                                 : PSPEC_OK;
}

static pspec_status run_some(ps_nufft_state *self, const ps_batch *some,
                             const ps_nufft_target *target, ps_error *error) {
    if (self->launcher->spread != NULL) {
        PS_TRY(begin_blocks(self, error));
        PS_TRY(add_block(self, some, error));
        return finish_blocks(self, target, error);
    }
    PS_TRY(upload(self, some, error));
    return self->launcher->run(self, some->num_patterns, target, error);
}

static pspec_status run(void *state, const ps_batch *batch, ps_rows *rows, ps_error *error) {
    ps_nufft_state *self = state;
    PS_TRY(ps_reals_write(self->device, &self->scales, self->precision, batch->scales,
                          batch->num_patterns, error));
    const size_t at_once = self->launcher->spread != NULL ? 1 : self->layout.parts;
    for (size_t row = 0; row < batch->num_patterns; row += at_once) {
        const ps_batch some = ps_batch_part(batch, row, at_once);
        PS_TRY(ps_batch_go_on(batch, error));
        const ps_nufft_target target = {&self->power, &self->scales, row};
        PS_TRY(run_some(self, &some, &target, error));
    }
    if (self->launcher->finish != NULL) {
        const ps_nufft_target target = {&self->power, &self->scales, 0};
        PS_TRY(self->launcher->finish(self, batch->num_patterns, &target, error));
    }
    *rows = show_rows(self, batch->num_patterns);
    return PSPEC_OK;
}

static void describe(const void *state, ps_text *text) {
    const ps_nufft_state *self = state;
    const ps_nufft_choice *choice = &self->layout.choice;
    ps_text_append(text, "(torus_nufft precision=%s lanes=%u tiles=%lu",
                   ps_precision_name(self->precision), self->layout.lanes,
                   (unsigned long)self->layout.num_tiles);
    for (unsigned i = 0; i < choice->num_axes; i++) {
        const ps_nufft_axis *axis = &choice->axes[i];
        ps_text_append(text, " grid=%lu sigma=%.3g width=%u degree=%u", (unsigned long)axis->n,
                       axis->n / (2.0 * axis->max_frequency), axis->window.width,
                       self->plans[i].degree);
    }
    choice->variant->describe(&self->layout, text);
    ps_text_append(text, " at_once=%zu)", self->layout.parts);
}

const ps_engine ps_torus_nufft = {
    .name = "torus_nufft",
    .domains = PS_ON_TORUS,
    .needs_device = true,
    .has_precision = {true, true, false},
    .takes_sets = true,
    .checks_points = true,
    .survey = survey,
    .error_of_state = error_of_state,
    .state_bytes = sizeof(ps_nufft_state),
    .create = create,
    .get_slots = get_slots,
    .get_stride = get_stride,
    .run = run,
    .stream = &stream,
    .describe = describe,
    .destroy = destroy,
};
