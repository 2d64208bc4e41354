#include "engines/nufft_grid.h"

#include "base/round.h"
#include "engines/nufft_kernels.h"

#include <stdio.h>

/* ---- create ------------------------------------------------------------------------------ */

static pspec_status create_kernels(ps_nufft_grid *self, ps_precision precision, ps_error *error) {
    char options[64];
    snprintf(options, sizeof options, "-DPRECISION=%u -DLANES=%u",
             precision == PS_SINGLE ? 32u : 64u, self->layout->lanes);
    const struct {
        cl_kernel *kernel;
        const char *source, *name;
    } all[] = {{&self->spread, "nufft/grid.cl", "nufft_grid"},
               {&self->first, "nufft/first.cl", "nufft_first"},
               {&self->tile, "nufft/finish.cl", "nufft_finish_tile"},
               {&self->rows, "nufft/finish.cl", "nufft_finish_rows"},
               {&self->columns, "nufft/columns.cl", "nufft_columns"}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        PS_TRY(ps_kernel_create(self->device, all[i].kernel, all[i].source, all[i].name, options,
                                error));
    }
    return PSPEC_OK;
}

/* Cells of all axes but the first. */
static size_t num_columns(const ps_nufft_layout *layout) {
    return layout->grid_reals / layout->choice.axes[0].n;
}

static pspec_status create_buffers(ps_nufft_grid *self, ps_error *error) {
    const ps_nufft_layout *layout = self->layout;
    const size_t reals = layout->grid_reals * layout->real_bytes;
    const size_t vector_bytes = 2 * layout->lanes * layout->real_bytes;
    PS_TRY(ps_buffer_create(self->device, &self->high, reals, "the fine grid", error));
    PS_TRY(ps_buffer_create(self->device, &self->low, reals, "the fine grid", error));
    PS_TRY(ps_buffer_create(self->device, &self->tile_rows,
                            layout->num_tiles * num_columns(layout) * vector_bytes, "rows of tiles",
                            error));
    return ps_buffer_create(self->device, &self->transformed, layout->grid_cells * vector_bytes,
                            "transformed rows", error);
}

pspec_status ps_nufft_grid_create(ps_nufft_grid *out, const ps_nufft_layout *layout,
                                  const ps_nufft_plan *plans, ps_nufft_places *places,
                                  ps_precision precision, ps_device *device, ps_error *error) {
    *out = (ps_nufft_grid){.layout = layout, .plans = plans, .places = places, .device = device};
    PS_TRY(create_kernels(out, precision, error));
    return create_buffers(out, error);
}

void ps_nufft_grid_free(ps_nufft_grid *grid) {
    const cl_kernel kernels[] = {grid->spread, grid->first, grid->tile, grid->rows, grid->columns};
    for (size_t i = 0; i < sizeof kernels / sizeof kernels[0]; i++) {
        if (kernels[i] != NULL) {
            clReleaseKernel(kernels[i]);
        }
    }
    ps_buffer_release(&grid->high);
    ps_buffer_release(&grid->low);
    ps_buffer_release(&grid->tile_rows);
    ps_buffer_release(&grid->transformed);
    *grid = (ps_nufft_grid){0};
}

/* ---- add --------------------------------------------------------------------------------- */

pspec_status ps_nufft_grid_begin(ps_nufft_grid *grid, ps_error *error) {
    PS_TRY(ps_buffer_clear(grid->device, &grid->high, error));
    return ps_buffer_clear(grid->device, &grid->low, error);
}

/* Arguments of an axis, as kernels/nufft/grid.cl has them. */
#define GRID_AXIS(plan)                                                                            \
    PS_BUFFER((plan)->coefficients), PS_U32((plan)->axis.n), PS_U32((plan)->axis.window.width),    \
        PS_U32((plan)->degree), PS_U32((plan)->bins)

static pspec_status spread(ps_nufft_grid *self, size_t num_parts, size_t num_points,
                           ps_error *error) {
    const unsigned axes = self->layout->choice.num_axes;
    const ps_nufft_plan *block = &self->plans[axes - 2];
    const ps_nufft_plan *last = &self->plans[axes - 1];
    const ps_nufft_plan none = {.coefficients = block->coefficients,
                                .axis = {.n = 1, .window = {.width = 1}}};
    const ps_nufft_plan *outer = axes == 3 ? &self->plans[0] : &none;
    const size_t blocks = ps_divide_up(block->axis.n, PS_NUFFT_BLOCK_ROWS);
    const double flops =
        2.0 * (double)num_points * outer->axis.window.width * block->axis.window.width * last->bins;
    const ps_range range = ps_nufft_group_range(self->device, blocks * outer->axis.n, 1, flops);
    const size_t row_bytes = (last->axis.n + last->bins) * self->layout->real_bytes;
    return PS_LAUNCH(self->device, self->spread, &range, error, PS_BUFFER(self->places->places),
                     PS_BUFFER(self->places->sorted), PS_BUFFER(self->places->heights),
                     PS_BUFFER(self->places->starts), PS_U32(num_parts), PS_U32(axes),
                     GRID_AXIS(outer), GRID_AXIS(block), GRID_AXIS(last), PS_BUFFER(self->high),
                     PS_BUFFER(self->low), PS_LOCAL(PS_NUFFT_BLOCK_ROWS * row_bytes));
}

/* Points first .. of a pattern that fit into a chunk, as parts; how many parts. */
static size_t cut(const ps_nufft_layout *layout, const pspec_pattern *pattern, size_t first,
                  pspec_pattern *parts, size_t *num_points) {
    size_t num = 0;
    *num_points = 0;
    while (num < layout->parts && first < pattern->num_points) {
        const size_t rest = pattern->num_points - first;
        parts[num] = *pattern;
        parts[num].num_points = rest < layout->part_points ? rest : layout->part_points;
        parts[num].points = pattern->points + first * pattern->dimension;
        parts[num].weights = pattern->weights != NULL ? pattern->weights + first : NULL;
        first += parts[num].num_points;
        *num_points += parts[num++].num_points;
    }
    return num;
}

pspec_status ps_nufft_grid_add(ps_nufft_grid *grid, const ps_batch *batch, ps_error *error) {
    pspec_pattern parts[PS_NUFFT_MOST_PARTS];
    int exponents[PS_NUFFT_MOST_PARTS];
    size_t num_points = 0;
    for (size_t i = 0; i < PS_NUFFT_MOST_PARTS; i++) {
        exponents[i] = batch->exponents != NULL ? batch->exponents[0] : 0;
    }
    for (size_t first = 0; first < batch->patterns[0].num_points; first += num_points) {
        ps_batch chunk = *batch;
        chunk.patterns = parts;
        chunk.exponents = exponents;
        chunk.num_patterns = cut(grid->layout, &batch->patterns[0], first, parts, &num_points);
        PS_TRY(ps_batch_go_on(batch, error));
        PS_TRY(ps_nufft_places_make(grid->places, &chunk, error));
        PS_TRY(spread(grid, chunk.num_patterns, num_points, error));
    }
    return PSPEC_OK;
}

/* ---- finish ------------------------------------------------------------------------------ */

static size_t cells_bytes(const ps_nufft_grid *self, const ps_nufft_plan *plan) {
    return plan->axis.n * 2 * (size_t)self->layout->lanes * self->layout->real_bytes;
}

/* Work-groups that each transform one row of lanes along an axis. */
static ps_range transform_range(const ps_nufft_grid *self, const ps_nufft_plan *plan,
                                size_t num_groups) {
    return ps_nufft_group_range(self->device, num_groups, 1,
                                (double)num_groups * self->layout->lanes *
                                    ps_fft_flops(plan->axis.n));
}

static pspec_status transform_first(ps_nufft_grid *self, const ps_buffer *means, ps_error *error) {
    const ps_nufft_plan *plan = &self->plans[0];
    const size_t columns = num_columns(self->layout);
    const ps_range range = transform_range(self, plan, columns / (2 * self->layout->lanes));
    return PS_LAUNCH(self->device, self->first, &range, error, PS_BUFFER(self->high),
                     PS_BUFFER(self->low), PS_BUFFER(*means), PS_U64(columns),
                     PS_BUFFER(plan->fft.radices), PS_BUFFER(plan->fft.twiddles),
                     PS_BUFFER(plan->fft.position), PS_BUFFER(plan->gains), PS_U32(plan->axis.n),
                     PS_U32(plan->axis.max_frequency), PS_U32(self->layout->num_tiles),
                     PS_BUFFER(self->tile_rows), PS_LOCAL(cells_bytes(self, plan)));
}

static pspec_status finish_tiles(ps_nufft_grid *self, const ps_nufft_target *target,
                                 ps_error *error) {
    const ps_nufft_plan *plan = &self->plans[1];
    const ps_range range = transform_range(self, plan, self->layout->num_tiles);
    return PS_LAUNCH(
        self->device, self->tile, &range, error, PS_BUFFER(self->tile_rows),
        PS_BUFFER(plan->fft.radices), PS_BUFFER(plan->fft.twiddles), PS_BUFFER(plan->fft.position),
        PS_BUFFER(plan->gains), PS_BUFFER(*target->scales), PS_BUFFER(*target->power),
        PS_U32(target->realization), PS_U64(self->layout->stride), PS_U32(plan->axis.n),
        PS_U32(plan->axis.max_frequency), PS_LOCAL(cells_bytes(self, plan)));
}

static pspec_status finish_rows(ps_nufft_grid *self, const ps_nufft_target *target,
                                ps_error *error) {
    const ps_nufft_plan *across = &self->plans[1];
    const ps_nufft_plan *along = &self->plans[2];
    const size_t num_tiles = self->layout->num_tiles;
    const size_t kept = 2 * (size_t)along->axis.max_frequency + 1;
    const ps_range rows = transform_range(self, along, num_tiles * across->axis.n);
    const ps_range columns = transform_range(self, across, num_tiles * kept);
    PS_TRY(PS_LAUNCH(self->device, self->rows, &rows, error, PS_BUFFER(self->tile_rows),
                     PS_BUFFER(along->fft.radices), PS_BUFFER(along->fft.twiddles),
                     PS_BUFFER(along->fft.position), PS_BUFFER(self->transformed),
                     PS_U32(across->axis.n), PS_U32(along->axis.n),
                     PS_U32(along->axis.max_frequency), PS_LOCAL(cells_bytes(self, along))));
    return PS_LAUNCH(self->device, self->columns, &columns, error, PS_BUFFER(self->transformed),
                     PS_BUFFER(across->fft.radices), PS_BUFFER(across->fft.twiddles),
                     PS_BUFFER(across->fft.position), PS_BUFFER(across->gains),
                     PS_BUFFER(along->gains), PS_BUFFER(*target->scales), PS_BUFFER(*target->power),
                     PS_U32(target->realization), PS_U64(self->layout->stride),
                     PS_U32(across->axis.n), PS_U32(across->axis.max_frequency),
                     PS_U32(along->axis.max_frequency), PS_LOCAL(cells_bytes(self, across)));
}

pspec_status ps_nufft_grid_finish(ps_nufft_grid *grid, const ps_buffer *means,
                                  const ps_nufft_target *target, ps_error *error) {
    PS_TRY(transform_first(grid, means, error));
    return grid->layout->choice.num_axes == 2 ? finish_tiles(grid, target, error)
                                              : finish_rows(grid, target, error);
}
