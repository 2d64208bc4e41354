/* Many sets at a time on GPUs: spread box by box, then transformed axis by axis into powers
 * (kernels/nufft/grid/). */
#include "base/round.h"
#include "engines/torus/nufft/measure.h"
#include "engines/torus/nufft/variant.h"
#include "nufft/grid/grid.h"

/* A pass on the device; items of its work-groups are compiled in. */
typedef struct pass {
    ps_kernel *kernel;
    ps_range range; /* of no groups and sets yet */
    ps_buffer roots, turns, gains;
} pass;

typedef struct grid {
    ps_kernel *spread;
    bool has_sums;       /* boxes, of the chunks before */
    ps_buffer high, low; /* tiles */
    ps_buffer numbers[2];
    pass passes[PS_NUFFT_MOST_PASSES];
} grid;

static grid *of(const ps_nufft_state *self) {
    return self->own;
}

/* ---- create ------------------------------------------------------------------------------ */

/* What kernels/nufft/grid/sides.h is compiled with. */
static void add_sides(const ps_nufft_state *self, ps_defines *defines) {
    const ps_nufft_grid_sizes *sizes = &self->layout.grid;
    ps_defines_add(defines, "-DDIMENSION=%u -DPAIRS=%u", self->layout.choice.num_axes,
                   self->layout.has_pairs);
    for (unsigned i = 0; i < PS_NUFFT_MAX_AXES; i++) {
        ps_defines_add(defines, "-DEDGE_%u=%lu -DWIDTH_%u=%lu", i, (unsigned long)sizes->edges[i],
                       i, (unsigned long)(sizes->sides[i] - sizes->edges[i] + 1));
    }
}

static pspec_status create_spread(ps_nufft_state *self, ps_error *error) {
    const ps_nufft_grid_sizes *sizes = &self->layout.grid;
    ps_defines defines = ps_defines_of(self->layout.real_bytes, 0);
    add_sides(self, &defines);
    ps_defines_add(&defines, "-DCOPIES=%lu -DPITCH=%lu", (unsigned long)sizes->copies,
                   (unsigned long)sizes->pitch);
    return ps_kernel_get(self->device, &of(self)->spread, "nufft/grid/spread.cl",
                         "nufft_grid_spread", defines.text, error);
}

void ps_nufft_line_defines(ps_defines *defines, const ps_nufft_pass *sizes, size_t items) {
    for (unsigned i = 0; i < PS_NUFFT_PASS_RADICES; i++) {
        ps_defines_add(defines, "-DRADIX_%u=%lu", i, (unsigned long)sizes->radices[i]);
    }
    ps_defines_add(defines, "-DLINES=%lu -DITEMS=%zu -DIS_ACROSS=%d",
                   (unsigned long)sizes->lines_at_once, items, sizes->inner > 1);
}

static pspec_status create_lines(ps_nufft_state *self, const ps_nufft_pass *sizes, pass *out,
                                 ps_error *error) {
    ps_defines defines = ps_defines_of(self->layout.real_bytes, 0);
    out->range = ps_range_shared(self->device, sizes->items, 0, 0, 0, 0);
    if (sizes->is_first) {
        add_sides(self, &defines);
        ps_defines_add(&defines, "-DCELLS_1=%lu -DCELLS_2=%lu",
                       (unsigned long)self->layout.grid.cells[1],
                       (unsigned long)self->layout.grid.cells[2]);
    }
    const ps_nufft_choice *choice = &self->layout.choice;
    ps_nufft_line_defines(&defines, sizes, out->range.local[0]);
    ps_defines_add(&defines, "-DFROM=%d -DTO=%d -DIS_HALF=%d", sizes->is_first,
                   sizes->is_turned ? 2 : sizes->is_last && !choice->keeps_sums,
                   sizes->axis + 1 == choice->num_axes);
    return ps_kernel_get(self->device, &out->kernel, "nufft/grid/lines.cl", "nufft_grid_lines",
                         defines.text, error);
}

static pspec_status create_pass(ps_nufft_state *self, unsigned i, ps_error *error) {
    const ps_nufft_pass *sizes = &self->layout.grid.passes[i];
    const ps_nufft_axis *axis = &self->layout.choice.axes[sizes->axis];
    pass *const out = &of(self)->passes[i];
    PS_TRY(create_lines(self, sizes, out, error));
    PS_TRY(ps_fft_roots_create(&out->roots, sizes->length, self->precision, self->device, error));
    PS_TRY(ps_fft_roots_create(&out->turns, sizes->is_turned ? axis->n : 1, self->precision,
                               self->device, error));
    return ps_nufft_gains_create(&out->gains, axis, PS_NUFFT_OF_AMPLITUDES, self->precision,
                                 self->device, error);
}

static pspec_status create_buffers(ps_nufft_state *self, ps_error *error) {
    const ps_nufft_layout *layout = &self->layout;
    const size_t tiles = layout->parts * layout->grid.tile_reals * layout->real_bytes;
    PS_TRY(ps_buffer_create(self->device, &of(self)->high, tiles, "boxes of a grid", error));
    PS_TRY(ps_buffer_create(self->device, &of(self)->low, layout->has_pairs ? tiles : 1,
                            "boxes of a grid", error));
    for (unsigned i = 0; i < 2; i++) {
        const size_t numbers = layout->parts * layout->grid.numbers[i];
        PS_TRY(ps_buffer_create(self->device, &of(self)->numbers[i],
                                2 * numbers * layout->real_bytes, "lines of a grid", error));
    }
    return PSPEC_OK;
}

static pspec_status create(ps_nufft_state *self, ps_error *error) {
    PS_TRY(create_spread(self, error));
    for (unsigned i = 0; i < self->layout.grid.num_passes; i++) {
        PS_TRY(create_pass(self, i, error));
    }
    return create_buffers(self, error);
}

static void free_own(void *own) {
    grid *const self = own;
    PS_BUFFERS_RELEASE(&self->high, &self->low, &self->numbers[0], &self->numbers[1]);
    for (unsigned i = 0; i < PS_NUFFT_MOST_PASSES; i++) {
        pass *const own_pass = &self->passes[i];
        ps_buffer_release(&own_pass->roots);
        ps_buffer_release(&own_pass->turns);
        ps_buffer_release(&own_pass->gains);
    }
}

/* ---- run --------------------------------------------------------------------------------- */

static pspec_status spread(ps_nufft_state *self, size_t num_sets, ps_error *error) {
    static const size_t slots[PS_NUFFT_MAX_AXES] = {16, 64, 128}; /* a work-item each */
    const ps_nufft_layout *layout = &self->layout;
    const ps_nufft_grid_sizes *sizes = &layout->grid;
    const unsigned num = layout->choice.num_axes, first = PS_NUFFT_MAX_AXES - num;
    const ps_nufft_grid_local local =
        ps_nufft_grid_spread_local(sizes, &layout->choice, layout->real_bytes);
    const ps_buffer *coefficients[GRID_AXES];
    grid_spread_numbers numbers = {.flush = sizes->flush, .has_sums = of(self)->has_sums};
    double flops = 2 * (double)self->places.num_points;
    for (unsigned i = 0; i < GRID_AXES; i++) {
        const ps_nufft_plan *plan = &self->plans[i < first ? 0 : i - first];
        coefficients[i] = &plan->coefficients; /* not looked at where there is no axis */
        numbers.windows[i] = ps_nufft_window_numbers(plan);
        flops *= i < first ? 1 : plan->axis.window.width;
    }
    const ps_range range = ps_range_shared(self->device, sizes->copies * slots[num - 1],
                                           ps_nufft_grid_boxes(sizes), num_sets, flops, 0);
    return PS_LAUNCH(self->device, of(self)->spread, &range, error, PS_STRUCT(numbers),
                     PS_BUFFER(self->places.places), PS_BUFFER(self->places.sorted),
                     PS_BUFFER(self->places.heights), PS_BUFFER(self->places.starts),
                     PS_BUFFER(*coefficients[0]), PS_BUFFER(*coefficients[1]),
                     PS_BUFFER(*coefficients[2]), PS_BUFFER(of(self)->high),
                     PS_BUFFER(of(self)->low), PS_LOCAL(local.copies), PS_LOCAL(local.windows),
                     PS_LOCAL(local.cells));
}

static pspec_status run_pass(ps_nufft_state *self, unsigned i, size_t num_sets,
                             const ps_nufft_target *target, ps_error *error) {
    const ps_nufft_grid_sizes *grid_sizes = &self->layout.grid;
    const ps_nufft_pass *sizes = &grid_sizes->passes[i];
    const ps_nufft_axis *axis = &self->layout.choice.axes[sizes->axis];
    const pass *own = &of(self)->passes[i];
    ps_range range = own->range;
    range.global[1] = ps_divide_up(sizes->lines, sizes->lines_at_once);
    range.global[2] = num_sets;
    range.flops = (double)num_sets * (double)sizes->lines * ps_fft_flops(sizes->length);
    range.bytes =
        (double)num_sets * (double)(sizes->from + sizes->to) * 2 * (double)self->layout.real_bytes;
    const grid_lines_numbers numbers = {
        .lines = sizes->lines,
        .inner = sizes->inner,
        .from_stride = sizes->from,
        .to_stride = sizes->to,
        .apart = sizes->apart,
        .n = axis->n,
        .K = (uint32_t)axis->max_frequency,
        .boxes = {grid_sizes->boxes[0], grid_sizes->boxes[1], grid_sizes->boxes[2]},
        .first_row = (uint32_t)target->realization,
        .neighbours = sizes->neighbours};
    return PS_LAUNCH(self->device, own->kernel, &range, error, PS_STRUCT(numbers),
                     PS_BUFFER(of(self)->numbers[(i + 1) % 2]), PS_BUFFER(of(self)->high),
                     PS_BUFFER(of(self)->low), PS_BUFFER(self->means), PS_BUFFER(own->roots),
                     PS_BUFFER(own->turns), PS_BUFFER(own->gains), PS_BUFFER(*target->scales),
                     PS_BUFFER(of(self)->numbers[i % 2]), PS_BUFFER(*target->power),
                     PS_LOCAL(sizes->lines_at_once * ps_nufft_line_reals(sizes->length) *
                              self->layout.real_bytes));
}

static pspec_status transform(ps_nufft_state *self, size_t num_sets, const ps_nufft_target *target,
                              ps_error *error) {
    for (unsigned i = 0; i < self->layout.grid.num_passes; i++) {
        PS_TRY(run_pass(self, i, num_sets, target, error));
    }
    return PSPEC_OK;
}

static pspec_status run(ps_nufft_state *self, size_t num_realizations,
                        const ps_nufft_target *target, ps_error *error) {
    PS_TRY(spread(self, num_realizations, error));
    return transform(self, num_realizations, target, error);
}

const ps_buffer *ps_nufft_grid_sums(const ps_nufft_state *self) {
    return &of(self)->numbers[(self->layout.grid.num_passes - 1) % 2];
}

const ps_nufft_launcher ps_nufft_grid_launcher = {
    .sorts = true, .own_bytes = sizeof(grid), .create = create, .free = free_own, .run = run};

/* ---- chunks ------------------------------------------------------------------------------ */

static pspec_status begin(ps_nufft_state *self, ps_error *error) {
    (void)error;
    of(self)->has_sums = false;
    return PSPEC_OK;
}

static pspec_status spread_chunk(ps_nufft_state *self, size_t num_parts, ps_error *error) {
    PS_TRY(spread(self, num_parts, error));
    of(self)->has_sums = true;
    return PSPEC_OK;
}

/* Of a set without points boxes are empty. */
static pspec_status finish_chunks(ps_nufft_state *self, size_t num_realizations,
                                  const ps_nufft_target *target, ps_error *error) {
    if (!of(self)->has_sums) {
        PS_TRY(ps_buffer_clear(self->device, &of(self)->high, error));
        PS_TRY(ps_buffer_clear(self->device, &of(self)->low, error));
    }
    return transform(self, num_realizations, target, error);
}

const ps_nufft_launcher ps_nufft_grid_chunks_launcher = {.sorts = true,
                                                         .own_bytes = sizeof(grid),
                                                         .create = create,
                                                         .free = free_own,
                                                         .run = finish_chunks,
                                                         .begin = begin,
                                                         .spread = spread_chunk};
