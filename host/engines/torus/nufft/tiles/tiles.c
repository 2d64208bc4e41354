/* Powers of realizations whose points are sorted into cells: tiles of frequencies of axis 0 are
 * summed directly, those of the other axes by spreading and transforms (kernels/nufft/tile.cl,
 * rows.cl, columns.cl).
 */
#include "base/memory.h"
#include "base/round.h"
#include "device/reals.h"
#include "engines/nufft/kernels.h"
#include "engines/torus/nufft/local.h"
#include "engines/torus/nufft/tiles/lines.h"
#include "engines/torus/nufft/variant.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>

typedef struct tiles {
    ps_kernel *tile, *rows, *columns;
    ps_buffer pattern; /* how frequency 0 turns from cell to cell of the first axis */
    ps_buffer grid;    /* transformed rows, in three dimensions */
    ps_nufft_lines lines;
} tiles;

static tiles *of(const ps_nufft_state *self) {
    return self->own;
}

/* ---- create ------------------------------------------------------------------------------ */

static pspec_status create_kernels(ps_nufft_state *self, ps_error *error) {
    ps_defines defines = ps_defines_of(self->layout.real_bytes, self->layout.lanes);
    ps_defines_add(&defines, "-DLINE=%u", self->layout.choice.has_line);
    if (self->layout.choice.num_axes == 1) {
        return ps_kernel_get(self->device, &of(self)->tile, "nufft/tile.cl", "nufft_tile",
                             defines.text, error);
    }
    PS_TRY(ps_kernel_get(self->device, &of(self)->rows, "nufft/rows.cl", "nufft_rows", defines.text,
                         error));
    return ps_kernel_get(self->device, &of(self)->columns, "nufft/columns.cl", "nufft_columns",
                         defines.text, error);
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
    PS_TRY(ps_nufft_lines_create(&of(self)->lines, layout, self->batch, self->plans, self->device,
                                 error));
    return ps_buffer_create(self->device, &of(self)->grid,
                            layout->parts * layout->grid_cells * vector_bytes, "transformed rows",
                            error);
}

static void free_own(void *own) {
    tiles *const self = own;
    ps_nufft_lines_free(&self->lines);
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
        PS_BUFFER(plan->fft.radices), PS_BUFFER(plan->fft.twiddles), PS_BUFFER(plan->fft.position),
        PS_BUFFER(plan->gains), PS_BUFFER(self->means), PS_BUFFER(of(self)->pattern),
        PS_BUFFER(*target->scales), PS_BUFFER(*target->power), PS_BUFFER(of(self)->lines.lines),
        LOCAL_ARGUMENTS(self, &plan->axis));
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
    return PS_LAUNCH(
        self->device, of(self)->rows, &range, error, PS_STRUCT(numbers), PS_BUFFER(places->places),
        PS_BUFFER(places->sorted), PS_BUFFER(places->heights), PS_BUFFER(places->starts),
        PS_BUFFER(across->coefficients), PS_BUFFER(along->coefficients),
        PS_BUFFER(along->fft.radices), PS_BUFFER(along->fft.twiddles),
        PS_BUFFER(along->fft.position), PS_BUFFER(self->means), PS_BUFFER(of(self)->grid),
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
                     PS_BUFFER(of(self)->grid), PS_BUFFER(across->fft.radices),
                     PS_BUFFER(across->fft.twiddles), PS_BUFFER(across->fft.position),
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
    return ps_nufft_lines_run(&of(self)->lines, num_realizations, target, error);
}

const ps_nufft_launcher ps_nufft_tiles_launcher = {.has_transforms = true,
                                                   .sorts = true,
                                                   .own_bytes = sizeof(tiles),
                                                   .create = create,
                                                   .free = free_own,
                                                   .run = run,
                                                   .finish = finish};
