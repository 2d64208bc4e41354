#include "engines/torus/nufft/tiles/lines.h"

#include "base/round.h"

/* ---- create ------------------------------------------------------------------------------ */

static pspec_status create_kernels(ps_nufft_lines *self, ps_error *error) {
    static const char file[] = "nufft/lines.cl";
    const ps_defines defines = ps_defines_of(self->layout->real_bytes, self->layout->lanes);
    if (self->layout->choice.num_axes == 1) {
        return ps_kernel_get(self->device, &self->powers, file, "nufft_line_powers", defines.text,
                             error);
    }
    PS_TRY(ps_kernel_get(self->device, &self->rows, file, "nufft_line_rows", defines.text, error));
    return ps_kernel_get(self->device, &self->columns, file, "nufft_line_columns", defines.text,
                         error);
}

/* Kernels that fill lines have an argument for them in any case. */
pspec_status ps_nufft_lines_create(ps_nufft_lines *out, const ps_nufft_layout *layout, size_t batch,
                                   const ps_nufft_plan *plans, ps_device *device, ps_error *error) {
    *out = (ps_nufft_lines){.layout = layout, .plans = plans, .device = device};
    const bool has_line = layout->choice.has_line;
    const size_t lines = has_line ? batch * layout->line.cells : 1;
    PS_TRY(ps_buffer_create(device, &out->lines, lines * layout->real_bytes, "rows of frequency 0",
                            error));
    if (!has_line) {
        return PSPEC_OK;
    }
    PS_TRY(create_kernels(out, error));
    const size_t groups = ps_divide_up(batch, layout->lanes);
    const size_t grid = layout->choice.num_axes == 1 ? 1 : groups * layout->line.grid_reals;
    return ps_buffer_create(device, &out->grid, grid * layout->real_bytes,
                            "transformed rows of frequency 0", error);
}

void ps_nufft_lines_free(ps_nufft_lines *lines) {
    ps_buffer_release(&lines->lines);
    ps_buffer_release(&lines->grid);
    *lines = (ps_nufft_lines){0};
}

/* ---- run --------------------------------------------------------------------------------- */

/* A work-group for each transform. */
static ps_range range_of(const ps_nufft_lines *self, size_t num_groups, const ps_nufft_axis *axis) {
    const double transforms = (double)num_groups * self->layout->lanes;
    return ps_nufft_group_range(self->device, num_groups, 1, transforms * ps_fft_flops(axis->n));
}

static line_numbers numbers_of(const ps_nufft_lines *self, const ps_nufft_plan *plan,
                               size_t num_realizations, const ps_nufft_target *target) {
    return (line_numbers){.stride = self->layout->stride,
                          .first_power = self->layout->first_line_power,
                          .transform = ps_nufft_transform_numbers(plan),
                          .first_row = (uint32_t)target->realization,
                          .num_realizations = (uint32_t)num_realizations};
}

/* Local memory of a transform. */
static size_t row_bytes(const ps_nufft_lines *self, const ps_nufft_axis *axis) {
    return (size_t)axis->n * 2 * self->layout->lanes * self->layout->real_bytes;
}

/* The transform of an axis, as kernels/nufft/lines.cl has it. */
#define LINE_TRANSFORM(plan)                                                                       \
    PS_BUFFER((plan)->fft.radices), PS_BUFFER((plan)->fft.twiddles), PS_BUFFER((plan)->fft.position)

static pspec_status make_powers(ps_nufft_lines *self, size_t num_realizations,
                                const ps_nufft_target *target, ps_error *error) {
    const ps_nufft_plan *plan = &self->plans[0];
    const size_t groups = ps_divide_up(num_realizations, self->layout->lanes);
    const ps_range range = range_of(self, groups, &plan->axis);
    const line_numbers numbers = numbers_of(self, plan, num_realizations, target);
    return PS_LAUNCH(self->device, self->powers, &range, error, PS_STRUCT(numbers),
                     PS_BUFFER(self->lines), LINE_TRANSFORM(plan), PS_BUFFER(plan->gains),
                     PS_BUFFER(*target->scales), PS_BUFFER(*target->power),
                     PS_LOCAL(row_bytes(self, &plan->axis)));
}

static pspec_status make_rows(ps_nufft_lines *self, size_t num_realizations,
                              const ps_nufft_target *target, ps_error *error) {
    const ps_nufft_plan *along = &self->plans[1];
    const uint32_t num_rows = self->plans[0].axis.n;
    const size_t groups = ps_divide_up(num_realizations, self->layout->lanes);
    const ps_range range = range_of(self, groups * num_rows, &along->axis);
    const line_numbers numbers = numbers_of(self, along, num_realizations, target);
    return PS_LAUNCH(self->device, self->rows, &range, error, PS_STRUCT(numbers),
                     PS_BUFFER(self->lines), LINE_TRANSFORM(along), PS_BUFFER(self->grid),
                     PS_U32(num_rows), PS_LOCAL(row_bytes(self, &along->axis)));
}

static pspec_status make_columns(ps_nufft_lines *self, size_t num_realizations,
                                 const ps_nufft_target *target, ps_error *error) {
    const ps_nufft_plan *across = &self->plans[0];
    const ps_nufft_plan *along = &self->plans[1];
    const uint32_t last_K = (uint32_t)along->axis.max_frequency;
    const size_t groups = ps_divide_up(num_realizations, self->layout->lanes);
    const ps_range range = range_of(self, groups * (last_K + 1), &across->axis);
    const line_numbers numbers = numbers_of(self, across, num_realizations, target);
    return PS_LAUNCH(self->device, self->columns, &range, error, PS_STRUCT(numbers),
                     PS_BUFFER(self->grid), LINE_TRANSFORM(across), PS_BUFFER(across->gains),
                     PS_BUFFER(along->gains), PS_BUFFER(*target->scales), PS_BUFFER(*target->power),
                     PS_U32(last_K), PS_LOCAL(row_bytes(self, &across->axis)));
}

pspec_status ps_nufft_lines_run(ps_nufft_lines *lines, size_t num_realizations,
                                const ps_nufft_target *target, ps_error *error) {
    if (!lines->layout->choice.has_line) {
        return PSPEC_OK;
    }
    if (lines->layout->choice.num_axes == 1) {
        return make_powers(lines, num_realizations, target, error);
    }
    PS_TRY(make_rows(lines, num_realizations, target, error));
    return make_columns(lines, num_realizations, target, error);
}
