/* Powers of realizations whose points are sorted into cells: tiles of frequencies of axis 0 are
 * summed directly, those of the other axes by spreading and transforms (kernels/nufft/tile.cl,
 * rows.cl, columns.cl).
 */
#include "base/memory.h"
#include "base/round.h"
#include "device/reals.h"
#include "engines/torus/nufft/local.h"
#include "engines/torus/nufft/variant.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>

/* ---- frequency 0 of axis 0 ----------------------------------------------------------------- */

/* Of realizations in tiles: its rows are real numbers (kernels/nufft/line.h), whose transforms
 * become powers, several realizations at a time (kernels/nufft/lines.cl). */
typedef struct lines {
    const ps_nufft_layout *layout;
    const ps_nufft_plan *plans; /* of the axes */
    ps_device *device;
    ps_kernel *powers;         /* where one axis has a transform, */
    ps_kernel *rows, *columns; /* where two have */
    ps_buffer lines; /* [realization][row][n], which kernels/nufft/tile.cl and rows.cl fill */
    ps_buffer grid;  /* between the two transforms */
} lines;

/* A kernel of the program of all. */
static pspec_status get_kernel(const ps_nufft_layout *layout, ps_device *device, ps_kernel **out,
                               const char *name, ps_error *error) {
    const unsigned num_axes = layout->choice.num_axes;
    const ps_defines defines = ps_nufft_defines(layout, num_axes + 1); /* axis 0 has none */
    return ps_kernel_get(device, out, layout->choice.variant->program[num_axes > 1], name,
                         defines.text, error);
}

static pspec_status create_line_kernels(lines *self, ps_error *error) {
    ps_device *const device = self->device;
    if (self->layout->choice.num_axes == 1) {
        return get_kernel(self->layout, device, &self->powers, "nufft_line_powers", error);
    }
    PS_TRY(get_kernel(self->layout, device, &self->rows, "nufft_line_rows", error));
    return get_kernel(self->layout, device, &self->columns, "nufft_line_columns", error);
}

/* Room for the lines of a batch; kernels that fill them have an argument for them in any case. */
static pspec_status create_lines(lines *out, const ps_nufft_layout *layout, size_t batch,
                                 const ps_nufft_plan *plans, ps_device *device, ps_error *error) {
    *out = (lines){.layout = layout, .plans = plans, .device = device};
    const bool has_line = layout->choice.has_line;
    const size_t rows = has_line ? batch * layout->line.cells : 1;
    PS_TRY(ps_buffer_create(device, &out->lines, rows * layout->real_bytes, "rows of frequency 0",
                            error));
    if (!has_line) {
        return PSPEC_OK;
    }
    PS_TRY(create_line_kernels(out, error));
    const size_t groups = ps_divide_up(batch, layout->lanes);
    const size_t grid = layout->choice.num_axes == 1 ? 1 : groups * layout->line.grid_reals;
    return ps_buffer_create(device, &out->grid, grid * layout->real_bytes,
                            "transformed rows of frequency 0", error);
}

static void free_lines(lines *self) {
    ps_buffer_release(&self->lines);
    ps_buffer_release(&self->grid);
    *self = (lines){0};
}

/* A work-group for each transform. */
static ps_range range_of(const lines *self, size_t num_groups, const ps_nufft_axis *axis) {
    const double transforms = (double)num_groups * self->layout->lanes;
    return ps_nufft_group_range(self->device, num_groups, 1, transforms * ps_fft_flops(axis->n));
}

static line_numbers numbers_of(const lines *self, const ps_nufft_plan *plan,
                               size_t num_realizations, const ps_nufft_target *target) {
    return (line_numbers){.stride = self->layout->stride,
                          .first_power = self->layout->first_line_power,
                          .transform = ps_nufft_transform_numbers(plan),
                          .first_row = (uint32_t)target->realization,
                          .num_realizations = (uint32_t)num_realizations};
}

/* Local memory of a transform. */
static size_t transform_bytes(const lines *self, const ps_nufft_axis *axis) {
    return (size_t)axis->n * 2 * self->layout->lanes * self->layout->real_bytes;
}

static pspec_status make_line_powers(lines *self, size_t num_realizations,
                                     const ps_nufft_target *target, ps_error *error) {
    const ps_nufft_plan *plan = &self->plans[0];
    const size_t groups = ps_divide_up(num_realizations, self->layout->lanes);
    const ps_range range = range_of(self, groups, &plan->axis);
    const line_numbers numbers = numbers_of(self, plan, num_realizations, target);
    return PS_LAUNCH(self->device, self->powers, &range, error, PS_STRUCT(numbers),
                     PS_BUFFER(self->lines), PS_FFT_TABLES(plan->fft), PS_BUFFER(plan->gains),
                     PS_BUFFER(*target->scales), PS_BUFFER(*target->power),
                     PS_LOCAL(transform_bytes(self, &plan->axis)));
}

static pspec_status make_line_rows(lines *self, size_t num_realizations,
                                   const ps_nufft_target *target, ps_error *error) {
    const ps_nufft_plan *along = &self->plans[1];
    const uint32_t num_rows = self->plans[0].axis.n;
    const size_t groups = ps_divide_up(num_realizations, self->layout->lanes);
    const ps_range range = range_of(self, groups * num_rows, &along->axis);
    const line_numbers numbers = numbers_of(self, along, num_realizations, target);
    return PS_LAUNCH(self->device, self->rows, &range, error, PS_STRUCT(numbers),
                     PS_BUFFER(self->lines), PS_FFT_TABLES(along->fft), PS_BUFFER(self->grid),
                     PS_U32(num_rows), PS_LOCAL(transform_bytes(self, &along->axis)));
}

static pspec_status make_line_columns(lines *self, size_t num_realizations,
                                      const ps_nufft_target *target, ps_error *error) {
    const ps_nufft_plan *across = &self->plans[0];
    const ps_nufft_plan *along = &self->plans[1];
    const uint32_t last_K = (uint32_t)along->axis.max_frequency;
    const size_t groups = ps_divide_up(num_realizations, self->layout->lanes);
    const ps_range range = range_of(self, groups * (last_K + 1), &across->axis);
    const line_numbers numbers = numbers_of(self, across, num_realizations, target);
    return PS_LAUNCH(self->device, self->columns, &range, error, PS_STRUCT(numbers),
                     PS_BUFFER(self->grid), PS_FFT_TABLES(across->fft), PS_BUFFER(across->gains),
                     PS_BUFFER(along->gains), PS_BUFFER(*target->scales), PS_BUFFER(*target->power),
                     PS_U32(last_K), PS_LOCAL(transform_bytes(self, &across->axis)));
}

/* The realizations of a batch, whose lines are all there, into rows from target->realization on. */
static pspec_status run_lines(lines *self, size_t num_realizations, const ps_nufft_target *target,
                              ps_error *error) {
    if (!self->layout->choice.has_line) {
        return PSPEC_OK;
    }
    if (self->layout->choice.num_axes == 1) {
        return make_line_powers(self, num_realizations, target, error);
    }
    PS_TRY(make_line_rows(self, num_realizations, target, error));
    return make_line_columns(self, num_realizations, target, error);
}

/* ---- tiles --------------------------------------------------------------------------------- */

typedef struct tiles {
    ps_kernel *tile, *rows, *columns;
    ps_buffer pattern; /* how frequency 0 turns from cell to cell of the first axis */
    ps_buffer grid;    /* transformed rows, in three dimensions */
    lines lines;
} tiles;

static tiles *of(const ps_nufft_state *self) {
    return self->own;
}

/* ---- create ------------------------------------------------------------------------------ */

static pspec_status create_kernels(ps_nufft_state *self, ps_error *error) {
    tiles *const own = of(self);
    if (self->layout.choice.num_axes == 1) {
        return get_kernel(&self->layout, self->device, &own->tile, "nufft_tile", error);
    }
    PS_TRY(get_kernel(&self->layout, self->device, &own->rows, "nufft_rows", error));
    return get_kernel(&self->layout, self->device, &own->columns, "nufft_columns", error);
}

/* How frequency 0 turns from cell to cell of the first axis: by -K turns around it where that axis
 * makes frequencies of axis 0 (its frequency -K is that one), not at all otherwise. */
static pspec_status create_pattern(ps_nufft_state *self, ps_error *error) {
    const ps_nufft_choice *choice = &self->layout.choice;
    const uint32_t n = choice->axes[0].n;
    const uint64_t turns = choice->stride != 0 ? (uint64_t)choice->axes[0].max_frequency : 0;
    double *pattern = NULL;
    PS_TRY(PS_NEW(&pattern, 2 * (size_t)n, "a pattern", error));
    for (uint32_t m = 0; m < n; m++) {
        const double angle = PS_TWO_PI * (double)(turns * m % n) / n;
        pattern[2 * m] = cos(angle);
        pattern[2 * m + 1] = -sin(angle);
    }
    const pspec_status status = ps_reals_upload(self->device, &of(self)->pattern, self->precision,
                                                pattern, 2 * (size_t)n, "a pattern", error);
    free(pattern);
    return status;
}

static pspec_status create(ps_nufft_state *self, ps_error *error) {
    const ps_nufft_layout *layout = &self->layout;
    const size_t vector_bytes = 2 * layout->lanes * layout->real_bytes;
    PS_TRY(create_kernels(self, error));
    PS_TRY(create_pattern(self, error));
    PS_TRY(create_lines(&of(self)->lines, layout, self->batch, self->plans, self->device, error));
    return ps_buffer_create(self->device, &of(self)->grid,
                            layout->parts * layout->grid_cells * vector_bytes, "transformed rows",
                            error);
}

static void free_own(void *own) {
    tiles *const self = own;
    free_lines(&self->lines);
    ps_buffer_release(&self->pattern);
    ps_buffer_release(&self->grid);
}

/* ---- run --------------------------------------------------------------------------------- */

static ps_range group_range(const ps_nufft_state *self, size_t num_groups, size_t num_realizations,
                            const ps_nufft_axis *axis, size_t rows_of_group) {
    const double transforms =
        (double)(num_groups * num_realizations * rows_of_group) * self->layout.lanes;
    return ps_nufft_group_range(self->device, num_groups, num_realizations,
                                transforms * ps_fft_flops(axis->n));
}

static size_t row_bytes(const ps_nufft_state *self, const ps_nufft_axis *axis) {
    return ps_nufft_row_cells(axis) * 2 * self->layout.lanes * self->layout.real_bytes;
}

/* A launch takes no local memory of no bytes. */
static size_t line_bytes(const ps_nufft_state *self) {
    const size_t reals = self->layout.choice.has_line ? self->layout.line.spread_reals : 1;
    return reals * self->layout.real_bytes;
}

/* Local memory of a work-group, as kernels/nufft/spread.h has it. */
#define LOCAL_ARGUMENTS(self, axis)                                                                \
    PS_LOCAL((self)->layout.group *row_bytes(self, axis)), PS_LOCAL(line_bytes(self)),             \
        PS_LOCAL(ps_nufft_chunk_reals(&(self)->layout) * (self)->layout.real_bytes),               \
        PS_LOCAL(PS_NUFFT_CHUNK * sizeof(uint64_t)), PS_LOCAL(PS_NUFFT_CHUNK * sizeof(uint32_t))

static size_t num_groups(const ps_nufft_state *self) {
    return ps_divide_up(self->layout.num_tiles, self->layout.group);
}

static pspec_status make_tiles(ps_nufft_state *self, size_t num_realizations,
                               const ps_nufft_target *target, ps_error *error) {
    const ps_nufft_plan *plan = &self->plans[0];
    const ps_nufft_places *places = &self->places;
    const ps_range range =
        group_range(self, num_groups(self), num_realizations, &plan->axis, self->layout.group);
    const tile_numbers numbers = {.stride = self->layout.stride,
                                  .along = ps_nufft_axis_numbers(plan),
                                  .first_row = (uint32_t)target->realization,
                                  .base = (uint32_t)ps_nufft_base(&self->layout.choice),
                                  .num_tiles = self->layout.num_tiles,
                                  .group = (uint32_t)self->layout.group,
                                  .dimension = places->dimension,
                                  .K = (uint32_t)plan->axis.max_frequency};
    return PS_LAUNCH(
        self->device, of(self)->tile, &range, error, PS_STRUCT(numbers), PS_BUFFER(places->places),
        PS_BUFFER(places->sorted), PS_BUFFER(places->heights), PS_BUFFER(plan->coefficients),
        PS_FFT_TABLES(plan->fft), PS_BUFFER(plan->gains), PS_BUFFER(self->means),
        PS_BUFFER(of(self)->pattern), PS_BUFFER(*target->scales), PS_BUFFER(*target->power),
        PS_BUFFER(of(self)->lines.lines), LOCAL_ARGUMENTS(self, &plan->axis));
}

static pspec_status make_rows(ps_nufft_state *self, size_t num_realizations,
                              const ps_nufft_target *target, ps_error *error) {
    const ps_nufft_plan *across = &self->plans[0];
    const ps_nufft_plan *along = &self->plans[1];
    const ps_nufft_places *places = &self->places;
    const ps_range range = group_range(self, num_groups(self) * across->axis.n, num_realizations,
                                       &along->axis, self->layout.group);
    const rows_numbers numbers = {.across = ps_nufft_axis_numbers(across),
                                  .along = ps_nufft_axis_numbers(along),
                                  .base = (uint32_t)ps_nufft_base(&self->layout.choice),
                                  .num_tiles = self->layout.num_tiles,
                                  .group = (uint32_t)self->layout.group,
                                  .K = (uint32_t)along->axis.max_frequency,
                                  .first_row = (uint32_t)target->realization};
    return PS_LAUNCH(self->device, of(self)->rows, &range, error, PS_STRUCT(numbers),
                     PS_BUFFER(places->places), PS_BUFFER(places->sorted),
                     PS_BUFFER(places->heights), PS_BUFFER(places->starts),
                     PS_BUFFER(across->coefficients), PS_BUFFER(along->coefficients),
                     PS_FFT_TABLES(along->fft), PS_BUFFER(self->means), PS_BUFFER(of(self)->grid),
                     PS_BUFFER(of(self)->lines.lines), LOCAL_ARGUMENTS(self, &along->axis));
}

static pspec_status make_columns(ps_nufft_state *self, size_t num_realizations,
                                 const ps_nufft_target *target, ps_error *error) {
    const ps_nufft_plan *across = &self->plans[0];
    const ps_nufft_plan *along = &self->plans[1];
    const size_t kept = 2 * (size_t)along->axis.max_frequency + 1;
    const ps_range range =
        group_range(self, self->layout.num_tiles * kept, num_realizations, &across->axis, 1);
    const powers_numbers numbers = {.stride = self->layout.stride,
                                    .transform = ps_nufft_transform_numbers(across),
                                    .first_row = (uint32_t)target->realization,
                                    .column_K = (uint32_t)along->axis.max_frequency};
    return PS_LAUNCH(self->device, of(self)->columns, &range, error, PS_STRUCT(numbers),
                     PS_BUFFER(of(self)->grid), PS_FFT_TABLES(across->fft),
                     PS_BUFFER(across->gains), PS_BUFFER(along->gains), PS_BUFFER(*target->scales),
                     PS_BUFFER(*target->power), PS_LOCAL(row_bytes(self, &across->axis)));
}

static pspec_status run(ps_nufft_state *self, size_t num_realizations,
                        const ps_nufft_target *target, ps_error *error) {
    if (self->layout.choice.num_axes == 1) {
        return make_tiles(self, num_realizations, target, error);
    }
    PS_TRY(make_rows(self, num_realizations, target, error));
    return make_columns(self, num_realizations, target, error);
}

/* What realizations of a batch have in common: frequency 0 of axis 0, where it is a line. */
static pspec_status finish(ps_nufft_state *self, size_t num_realizations,
                           const ps_nufft_target *target, ps_error *error) {
    return run_lines(&of(self)->lines, num_realizations, target, error);
}

const ps_nufft_launcher ps_nufft_tiles_launcher = {.has_transforms = true,
                                                   .sorts = true,
                                                   .own_bytes = sizeof(tiles),
                                                   .create = create,
                                                   .free = free_own,
                                                   .run = run,
                                                   .finish = finish};
