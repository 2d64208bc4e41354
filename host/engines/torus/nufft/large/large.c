/* One very large set on a grid of all axes: spread chunk by chunk, then transformed into powers
 * (kernels/nufft/boxes.cl, first.cl, finish.cl, columns.cl). Memory does not grow with the points.
 */
#include "base/round.h"
#include "engines/torus/nufft/local.h"
#include "engines/torus/nufft/variant.h"
#include "nufft/boxes.h"

typedef struct grid {
    bool is_alone; /* work-groups of one item: kernels/shared/group.h */
    ps_kernel *spread, *first, *tile, *rows, *columns;
    ps_buffer high[PS_NUFFT_MOST_SLABS], low[PS_NUFFT_MOST_SLABS]; /* [num_slabs] */
    ps_buffer high_strip, low_strip;                               /* of more than one slab */
    ps_buffer tile_rows, transformed;                              /* of tiles_at_once */
} grid;

static grid *of(const ps_nufft_state *self) {
    return self->own;
}

/* ---- create ------------------------------------------------------------------------------ */

static pspec_status create_kernels(ps_nufft_state *self, ps_error *error) {
    ps_defines defines = ps_defines_of(self->layout.real_bytes, self->layout.lanes);
    ps_defines_add(&defines, "-DPAIRS=%u -DALONE=%u -DDIMENSION=%u", self->layout.has_pairs,
                   of(self)->is_alone, self->layout.choice.num_axes);
    const struct {
        ps_kernel **kernel;
        const char *source, *name;
    } all[] = {{&of(self)->spread, "nufft/boxes.cl", "nufft_boxes"},
               {&of(self)->first, "nufft/first.cl", "nufft_first"},
               {&of(self)->tile, "nufft/finish.cl", "nufft_finish_tile"},
               {&of(self)->rows, "nufft/finish.cl", "nufft_finish_rows"},
               {&of(self)->columns, "nufft/columns.cl", "nufft_columns"}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        PS_TRY(ps_kernel_get(self->device, all[i].kernel, all[i].source, all[i].name, defines.text,
                             error));
    }
    return PSPEC_OK;
}

/* Cells of all axes but the first. */
static size_t num_columns(const ps_nufft_layout *layout) {
    return layout->grid_reals / layout->choice.axes[0].n;
}

/* Cells of axis 0 in a slab. */
static size_t slab_rows(const ps_nufft_layout *layout, uint32_t slab) {
    const uint32_t rest = layout->choice.axes[0].n - slab * layout->slab_rows;
    return rest < layout->slab_rows ? rest : layout->slab_rows;
}

static pspec_status create_buffers(ps_nufft_state *self, ps_error *error) {
    const ps_nufft_layout *layout = &self->layout;
    const size_t vector_bytes = 2 * layout->lanes * layout->real_bytes;
    const size_t tile_cells = layout->grid_cells / layout->num_tiles;
    const size_t strip = layout->strip_columns * layout->choice.axes[0].n * layout->real_bytes;
    for (uint32_t slab = 0; slab < layout->num_slabs; slab++) {
        const size_t bytes = slab_rows(layout, slab) * num_columns(layout) * layout->real_bytes;
        PS_TRY(
            ps_buffer_create(self->device, &of(self)->high[slab], bytes, "the fine grid", error));
        if (layout->has_pairs) {
            PS_TRY(ps_buffer_create(self->device, &of(self)->low[slab], bytes, "the fine grid",
                                    error));
        }
    }
    if (strip > 0) {
        PS_TRY(
            ps_buffer_create(self->device, &of(self)->high_strip, strip, "the fine grid", error));
    }
    if (strip > 0 && layout->has_pairs) {
        PS_TRY(ps_buffer_create(self->device, &of(self)->low_strip, strip, "the fine grid", error));
    }
    PS_TRY(ps_buffer_create(self->device, &of(self)->tile_rows,
                            layout->tiles_at_once * num_columns(layout) * vector_bytes,
                            "rows of tiles", error));
    return ps_buffer_create(self->device, &of(self)->transformed,
                            layout->tiles_at_once * tile_cells * vector_bytes, "transformed rows",
                            error);
}

static pspec_status create(ps_nufft_state *self, ps_error *error) {
    of(self)->is_alone = ps_range_is_alone(self->device);
    PS_TRY(create_kernels(self, error));
    return create_buffers(self, error);
}

static void free_own(void *own) {
    grid *const self = own;
    for (uint32_t slab = 0; slab < PS_NUFFT_MOST_SLABS; slab++) {
        ps_buffer_release(&self->high[slab]);
        ps_buffer_release(&self->low[slab]);
    }
    PS_BUFFERS_RELEASE(&self->high_strip, &self->low_strip, &self->tile_rows, &self->transformed);
}

/* ---- spread --------------------------------------------------------------------------------- */

/* One thread of a device clears, while the host converts points. */
static pspec_status begin(ps_nufft_state *self, ps_error *error) {
    for (uint32_t slab = 0; slab < self->layout.num_slabs; slab++) {
        PS_TRY(ps_buffer_clear(self->device, &of(self)->high[slab], error));
        PS_TRY(self->layout.has_pairs ? ps_buffer_clear(self->device, &of(self)->low[slab], error)
                                      : PSPEC_OK);
    }
    return PSPEC_OK;
}

/* Kernels want a buffer in every place: where there are no pairs, one that is not touched there. */
static const ps_buffer *low_of(const ps_nufft_state *self, uint32_t slab) {
    return self->layout.has_pairs ? &of(self)->low[slab] : &of(self)->high[slab];
}

/* colour: of all axes, the last one's innermost. */
static boxes_numbers numbers_of_colour(const ps_nufft_state *self, uint32_t slab, size_t num_parts,
                                       uint32_t colour) {
    const ps_nufft_layout *layout = &self->layout;
    const ps_nufft_boxes *boxes = &layout->boxes;
    boxes_numbers numbers = {.rows = boxes->sides[1],
                             .pitch = boxes->sides[2],
                             .num_parts = (uint32_t)num_parts,
                             .first_row = slab * layout->slab_rows,
                             .num_rows = (uint32_t)slab_rows(layout, slab)};
    const unsigned first = BOX_AXES - layout->choice.num_axes;
    numbers.axes[0] = (box_axis){.window = {.n = 1, .width = 1, .bins = 1}, /* in the plane */
                                 .boxes = 1,
                                 .colours = 1};
    for (unsigned i = BOX_AXES; i-- > first; colour /= boxes->colours[i]) {
        numbers.axes[i] = (box_axis){.window = ps_nufft_window_numbers(&self->plans[i - first]),
                                     .boxes = boxes->num[i],
                                     .per_cell = boxes->per_cell[i],
                                     .colours = boxes->colours[i],
                                     .colour = colour % boxes->colours[i]};
    }
    return numbers;
}

static pspec_status spread_colour(ps_nufft_state *self, uint32_t slab, size_t num_boxes,
                                  const boxes_numbers *numbers, double flops, ps_error *error) {
    const unsigned axes = self->layout.choice.num_axes;
    const ps_nufft_plan *last = &self->plans[axes - 1];
    const ps_nufft_plan *before = &self->plans[axes - 2];
    const ps_nufft_plan *first = &self->plans[0]; /* not looked at in the plane */
    const ps_nufft_local local = ps_nufft_boxes_local(&self->layout);
    const ps_range range = of(self)->is_alone
                               ? ps_range_alone(num_boxes, flops)
                               : ps_nufft_group_range(self->device, num_boxes, 1, flops);
    return PS_LAUNCH(self->device, of(self)->spread, &range, error, PS_STRUCT(*numbers),
                     PS_BUFFER(self->places.places), PS_BUFFER(self->places.sorted),
                     PS_BUFFER(self->places.heights), PS_BUFFER(self->places.starts),
                     PS_BUFFER(first->coefficients), PS_BUFFER(before->coefficients),
                     PS_BUFFER(last->coefficients), PS_BUFFER(of(self)->high[slab]),
                     PS_BUFFER(*low_of(self, slab)), PS_LOCAL(local.rows), PS_LOCAL(local.windows),
                     PS_LOCAL(local.cells));
}

/* Of a colour. */
static double spread_flops(const ps_nufft_state *self, uint32_t num_colours) {
    const unsigned axes = self->layout.choice.num_axes;
    double flops = 2.0 * (double)self->places.num_points * self->plans[axes - 1].bins / num_colours;
    for (unsigned i = 0; i + 1 < axes; i++) {
        flops *= self->plans[i].axis.window.width;
    }
    return flops;
}

static pspec_status spread_on(ps_nufft_state *self, uint32_t slab, size_t num_parts,
                              ps_error *error) {
    const ps_nufft_boxes *boxes = &self->layout.boxes;
    const uint32_t colours = boxes->colours[0] * boxes->colours[1] * boxes->colours[2];
    for (uint32_t colour = 0; colour < colours; colour++) {
        const boxes_numbers numbers = numbers_of_colour(self, slab, num_parts, colour);
        PS_TRY(spread_colour(self, slab, ps_nufft_boxes_of_colour(boxes), &numbers,
                             spread_flops(self, colours), error));
    }
    return PSPEC_OK;
}

static pspec_status spread(ps_nufft_state *self, size_t num_parts, ps_error *error) {
    for (uint32_t slab = 0; slab < self->layout.num_slabs; slab++) {
        PS_TRY(spread_on(self, slab, num_parts, error));
    }
    return PSPEC_OK;
}

/* ---- finish ------------------------------------------------------------------------------ */

static size_t cells_bytes(const ps_nufft_state *self, const ps_nufft_plan *plan) {
    return plan->axis.n * 2 * (size_t)self->layout.lanes * self->layout.real_bytes;
}

/* Work-groups that each transform one row of lanes along an axis. */
static ps_range transform_range(const ps_nufft_state *self, const ps_nufft_plan *plan,
                                size_t num_groups) {
    return ps_nufft_group_range(self->device, num_groups, 1,
                                (double)num_groups * self->layout.lanes *
                                    ps_fft_flops(plan->axis.n));
}

/* Columns, and tiles, that are worked on. */
typedef struct extent {
    size_t first, num;
} extent;

static extent cut_extent(size_t first, size_t at_once, size_t whole) {
    return (extent){first, whole - first < at_once ? whole - first : at_once};
}

/* The same columns of all slabs, one below the other. */
static pspec_status gather_strip(ps_nufft_state *self, extent columns, ps_error *error) {
    const ps_nufft_layout *layout = &self->layout;
    const size_t real = layout->real_bytes;
    for (uint32_t slab = 0; slab < layout->num_slabs; slab++) {
        const ps_rectangle rectangle = {
            .row_bytes = columns.num * real,
            .num_rows = slab_rows(layout, slab),
            .from_offset = columns.first * real,
            .from_pitch = num_columns(layout) * real,
            .to_offset = (size_t)slab * layout->slab_rows * columns.num * real,
            .to_pitch = columns.num * real,
        };
        PS_TRY(ps_buffer_copy_rectangle(self->device, &of(self)->high[slab], &of(self)->high_strip,
                                        &rectangle, error));
        if (layout->has_pairs) {
            PS_TRY(ps_buffer_copy_rectangle(self->device, &of(self)->low[slab],
                                            &of(self)->low_strip, &rectangle, error));
        }
    }
    return PSPEC_OK;
}

static pspec_status transform_columns(ps_nufft_state *self, extent columns, extent tiles,
                                      ps_error *error) {
    const ps_nufft_plan *plan = &self->plans[0];
    const bool is_whole = self->layout.strip_columns == 0;
    const ps_buffer *high = is_whole ? &of(self)->high[0] : &of(self)->high_strip;
    const ps_buffer *low = !self->layout.has_pairs ? high
                           : is_whole              ? &of(self)->low[0]
                                                   : &of(self)->low_strip;
    const ps_range range = transform_range(self, plan, columns.num / (2 * self->layout.lanes));
    const first_numbers numbers = {.columns = columns.num,
                                   .first_column = columns.first,
                                   .all_columns = num_columns(&self->layout),
                                   .transform = ps_nufft_transform_numbers(plan),
                                   .first_tile = (uint32_t)tiles.first,
                                   .num_tiles = (uint32_t)tiles.num};
    return PS_LAUNCH(self->device, of(self)->first, &range, error, PS_STRUCT(numbers),
                     PS_BUFFER(*high), PS_BUFFER(*low), PS_BUFFER(self->means),
                     PS_FFT_TABLES(plan->fft), PS_BUFFER(plan->gains),
                     PS_BUFFER(of(self)->tile_rows), PS_LOCAL(cells_bytes(self, plan)));
}

static pspec_status transform_first(ps_nufft_state *self, extent tiles, ps_error *error) {
    const size_t whole = num_columns(&self->layout);
    const size_t strip = self->layout.strip_columns;
    if (strip == 0) {
        return transform_columns(self, (extent){0, whole}, tiles, error);
    }
    for (size_t first = 0; first < whole; first += strip) {
        const extent columns = cut_extent(first, strip, whole);
        PS_TRY(gather_strip(self, columns, error));
        PS_TRY(transform_columns(self, columns, tiles, error));
    }
    return PSPEC_OK;
}

/* Powers of a row in front of a tile. */
static uint64_t powers_before(const ps_nufft_state *self, extent tiles) {
    return self->layout.stride / self->layout.num_tiles * tiles.first;
}

static pspec_status finish_tiles(ps_nufft_state *self, extent tiles, const ps_nufft_target *target,
                                 ps_error *error) {
    const ps_nufft_plan *plan = &self->plans[1];
    const ps_range range = transform_range(self, plan, tiles.num);
    const powers_numbers numbers = {.stride = self->layout.stride,
                                    .first_power = powers_before(self, tiles),
                                    .transform = ps_nufft_transform_numbers(plan),
                                    .first_row = (uint32_t)target->realization};
    return PS_LAUNCH(self->device, of(self)->tile, &range, error, PS_STRUCT(numbers),
                     PS_BUFFER(of(self)->tile_rows), PS_FFT_TABLES(plan->fft),
                     PS_BUFFER(plan->gains), PS_BUFFER(*target->scales), PS_BUFFER(*target->power),
                     PS_LOCAL(cells_bytes(self, plan)));
}

static pspec_status finish_rows(ps_nufft_state *self, extent tiles, const ps_nufft_target *target,
                                ps_error *error) {
    const ps_nufft_plan *across = &self->plans[1];
    const ps_nufft_plan *along = &self->plans[2];
    const size_t kept = 2 * (size_t)along->axis.max_frequency + 1;
    const ps_range rows = transform_range(self, along, tiles.num * across->axis.n);
    const ps_range columns = transform_range(self, across, tiles.num * kept);
    PS_TRY(PS_LAUNCH(self->device, of(self)->rows, &rows, error, PS_BUFFER(of(self)->tile_rows),
                     PS_FFT_TABLES(along->fft), PS_BUFFER(of(self)->transformed),
                     PS_U32(across->axis.n), PS_U32(along->axis.n),
                     PS_U32(along->axis.max_frequency), PS_LOCAL(cells_bytes(self, along))));
    const powers_numbers numbers = {.stride = self->layout.stride,
                                    .first_power = powers_before(self, tiles),
                                    .transform = ps_nufft_transform_numbers(across),
                                    .first_row = (uint32_t)target->realization,
                                    .column_K = (uint32_t)along->axis.max_frequency};
    return PS_LAUNCH(self->device, of(self)->columns, &columns, error, PS_STRUCT(numbers),
                     PS_BUFFER(of(self)->transformed), PS_FFT_TABLES(across->fft),
                     PS_BUFFER(across->gains), PS_BUFFER(along->gains), PS_BUFFER(*target->scales),
                     PS_BUFFER(*target->power), PS_LOCAL(cells_bytes(self, across)));
}

static pspec_status run(ps_nufft_state *self, size_t num_realizations,
                        const ps_nufft_target *target, ps_error *error) {
    const ps_nufft_layout *layout = &self->layout;
    (void)num_realizations; /* one */
    for (size_t first = 0; first < layout->num_tiles; first += layout->tiles_at_once) {
        const extent tiles = cut_extent(first, layout->tiles_at_once, layout->num_tiles);
        PS_TRY(transform_first(self, tiles, error));
        PS_TRY(layout->choice.num_axes == 2 ? finish_tiles(self, tiles, target, error)
                                            : finish_rows(self, tiles, target, error));
    }
    return PSPEC_OK;
}

const ps_nufft_launcher ps_nufft_large_launcher = {.has_transforms = true,
                                                   .sorts = true,
                                                   .own_bytes = sizeof(grid),
                                                   .create = create,
                                                   .free = free_own,
                                                   .run = run,
                                                   .begin = begin,
                                                   .spread = spread};
