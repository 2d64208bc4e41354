/* The engine: for some realizations at a time, sort points by cells of the fine grid, make their
 * windows and phases, spread and transform tiles into powers. docs/engines/torus_nufft.md. */
#include "engines/torus/nufft/torus_nufft.h"

#include "base/memory.h"
#include "device/reals.h"
#include "engines/nufft/choose.h"
#include "engines/nufft/cost.h"
#include "engines/nufft/error.h"
#include "engines/nufft/grid_axis.h"
#include "engines/torus/nufft/slots.h"
#include "engines/torus/nufft/variants.h"

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
        return "a row of the fine grid does not fit into local memory";
    }
    if (layout->stride > UINT32_MAX) {
        return "too many frequencies for 32-bit slots";
    }
    const bool has_large_buffer =
        layout->largest_buffer > limits->max_allocation_bytes ||
        layout->largest_buffer_per_realization > limits->max_allocation_bytes;
    return has_large_buffer ? "needs a larger buffer than the device allows" : NULL;
}

/* A transform each. */
static double kernels_of_line(const ps_nufft_choice *choice) {
    return choice->has_line ? choice->num_axes : 0;
}

static ps_work work_of(const ps_nufft_layout *layout, const ps_problem *problem,
                       ps_precision precision) {
    const ps_nufft_variant *const way = &ps_nufft_variants[ps_nufft_way_of(&layout->choice)];
    const double realizations =
        problem->num_realizations > 0 ? (double)problem->num_realizations : 1;
    return (ps_work){
        .transform_flops =
            realizations * ps_nufft_flops(&layout->choice, precision, (double)problem->num_points),
        .launches = way->count_launches(layout, (double)problem->num_points, realizations),
        .kernels = way->kernels[layout->choice.num_axes > 1] + kernels_of_line(&layout->choice),
        .fixed_bytes = (double)layout->fixed_bytes,
        .host_bytes = (double)layout->host_bytes,
        .bytes_per_realization = (double)layout->bytes_per_realization,
        .row_bytes = (double)(layout->stride * layout->real_bytes),
        .largest_buffer_per_realization = (double)layout->largest_buffer_per_realization,
        .takes_blocks = way->takes_one};
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
    if (self == NULL) {
        return;
    }
    ps_buffer_release(&self->means);
    ps_buffer_release(&self->scales);
    ps_buffer_release(&self->power);
    for (unsigned i = 0; i < PS_NUFFT_MAX_AXES; i++) {
        ps_nufft_plan_free(&self->plans[i]);
    }
    self->variant->free(self);
    free(self->means_of_parts);
    free(self);
}

static pspec_status create_buffers(ps_nufft_state *self, size_t rows, ps_error *error) {
    const ps_nufft_layout *layout = &self->layout;
    PS_TRY(ps_buffer_create(self->device, &self->means, layout->parts * layout->real_bytes, "means",
                            error));
    PS_TRY(
        ps_buffer_create(self->device, &self->scales, rows * layout->real_bytes, "scales", error));
    PS_TRY(ps_buffer_create(self->device, &self->power, rows * layout->stride * layout->real_bytes,
                            "powers of a batch", error));
    return ps_buffer_clear(self->device, &self->power, error);
}

static pspec_status create_parts(ps_nufft_state *self, const ps_problem *problem, ps_error *error) {
    const ps_nufft_choice *choice = &self->layout.choice;
    PS_TRY(PS_NEW(&self->means_of_parts, self->layout.parts, "means", error));
    for (unsigned i = 0; i < choice->num_axes; i++) {
        PS_TRY(ps_nufft_plan_create(&self->plans[i], &choice->axes[i],
                                    self->variant->has_transforms, problem->tolerance,
                                    self->precision, self->device, error));
    }
    PS_TRY(create_buffers(self, self->batch, error));
    return self->variant->create(self, error);
}

static pspec_status create(void **state, const ps_problem *problem, ps_precision precision,
                           size_t batch, ps_device *device, ps_error *error) {
    *state = NULL;
    ps_nufft_state *self = NULL;
    PS_TRY(PS_NEW(&self, 1, "an engine", error));
    self->device = device;
    self->problem = *problem;
    self->precision = precision;
    self->batch = batch;
    self->layout = ps_nufft_layout_make(problem, ps_device_get_limits(device), precision);
    ps_nufft_layout_shrink(&self->layout, batch);
    self->variant = &ps_nufft_variants[ps_nufft_way_of(&self->layout.choice)];
    const pspec_status status = create_parts(self, problem, error);
    if (status != PSPEC_OK) {
        destroy(self);
        return status;
    }
    *state = self;
    return PSPEC_OK;
}

static void get_slots(const void *state, uint32_t *slots) {
    const ps_nufft_state *self = state;
    const ps_frequencies *set = self->problem.frequencies;
    for (size_t i = 0; i < set->num; i++) {
        slots[i] = ps_nufft_slot(&self->layout, set->vectors + i * set->dimension, set->dimension);
    }
}

static size_t get_stride(const void *state) {
    return ((const ps_nufft_state *)state)->layout.stride;
}

/* ---- run --------------------------------------------------------------------------------- */

static size_t stream_unit(const void *state) {
    const ps_nufft_state *self = state;
    return self->variant->takes_one ? self->layout.parts * self->layout.part_points : 0;
}

static ps_rows show_rows(const ps_nufft_state *self, size_t num_rows) {
    return (ps_rows){.num_rows = num_rows,
                     .stride = self->layout.stride,
                     .precision = self->precision,
                     .device = self->power};
}

static pspec_status finish_large(void *state, double scale, ps_rows *rows, ps_error *error) {
    ps_nufft_state *self = state;
    const ps_nufft_target target = {&self->power, &self->scales, 0};
    PS_TRY(ps_reals_write(self->device, &self->scales, self->precision, &scale, 1, error));
    *rows = show_rows(self, 1);
    return ps_nufft_large_end(self, &target, error);
}

static pspec_status begin_large(void *state, ps_error *error) {
    (void)error;
    ps_nufft_large_begin(state);
    return PSPEC_OK;
}

static pspec_status add_large(void *state, const ps_batch *block, ps_error *error) {
    return ps_nufft_large_add(state, block, error);
}

static const ps_engine_stream stream = {
    .unit = stream_unit, .begin = begin_large, .add = add_large, .finish = finish_large};

static pspec_status run(void *state, const ps_batch *batch, ps_rows *rows, ps_error *error) {
    ps_nufft_state *self = state;
    PS_TRY(ps_reals_write(self->device, &self->scales, self->precision, batch->scales,
                          batch->num_patterns, error));
    const size_t at_once = self->variant->takes_one ? 1 : self->layout.parts;
    for (size_t row = 0; row < batch->num_patterns; row += at_once) {
        const size_t rest = batch->num_patterns - row;
        ps_batch some = *batch;
        some.num_patterns = rest < at_once ? rest : at_once;
        some.patterns += row;
        some.exponents = batch->exponents != NULL ? batch->exponents + row : NULL;
        PS_TRY(ps_batch_go_on(batch, error));
        const ps_nufft_target target = {&self->power, &self->scales, row};
        PS_TRY(self->variant->run(self, &some, &target, error));
    }
    if (self->variant->finish != NULL) {
        const ps_nufft_target target = {&self->power, &self->scales, 0};
        PS_TRY(self->variant->finish(self, batch->num_patterns, &target, error));
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
    self->variant->describe(self, text);
    ps_text_append(text, " at_once=%zu)", self->layout.parts);
}

const ps_engine ps_torus_nufft = {
    .name = "torus_nufft",
    .summary =
        "fast transforms of points spread on a grid, on the device; grids in 1 to 3 dimensions",
    .domains = PS_ON_TORUS,
    .needs_device = true,
    .has_precision = {true, true, false},
    .checks_points = true,
    .survey = survey,
    .error_of_state = error_of_state,
    .create = create,
    .get_slots = get_slots,
    .get_stride = get_stride,
    .run = run,
    .stream = &stream,
    .describe = describe,
    .destroy = destroy,
};
