#include "engines/sphere/nufft/variants.h"

#include "base/round.h"
#include "device/reals.h"
#include "engines/nufft/fft.h"
#include "sphere/nufft/orders.h"

/* Bits of kernels/sphere/nufft/orders.cl. */
enum { STEP_SPREAD = 1, STEP_AROUND = 2, STEP_RINGS = 4 };

static const ps_sphere_source sources_of_sums[] = {
    {"sphere/nufft/orders_sum.cl", "sphere_orders_sum", false},
    {"sphere/nufft/orders_sum_one.cl", "sphere_orders_sum_one", true}};

static const ps_sphere_source *source_of_sums(const ps_sphere_stages *self) {
    return &sources_of_sums[self->shape->is_one_set];
}

/* ---- create ------------------------------------------------------------------------------ */

static pspec_status create_kernels(ps_sphere_stages *self, ps_error *error) {
    static const ps_sphere_source orders = {"sphere/nufft/orders.cl", "sphere_orders", false};
    static const ps_sphere_source bands = {"sphere/nufft/orders_bands.cl", "sphere_orders_bands",
                                           false};
    PS_TRY(ps_sphere_kernel_get(&self->powers, &self->orders, &orders, false, error));
    if (self->shape->is_sorted) {
        PS_TRY(ps_sphere_kernel_get(&self->powers, &self->bands, &bands, false, error));
    }
    return ps_sphere_kernel_get(&self->powers, &self->sum, source_of_sums(self), false, error);
}

static pspec_status create_buffers(ps_sphere_stages *self, ps_error *error) {
    const ps_sphere_shape *shape = self->shape;
    const ps_sphere_bytes bytes = ps_sphere_bytes_of(shape, ps_real_bytes(self->precision));
    const struct {
        ps_buffer *buffer;
        size_t bytes;
        const char *what;
    } wanted[] = {{&self->grids, bytes.grids, "grids of the sphere"},
                  {&self->rows, bytes.rows, "tiles of orders"},
                  {&self->scratch, bytes.scratch, "rows of transforms"},
                  {&self->strip_turns, bytes.strip_turns, "points of strips"},
                  {&self->strip_weights, bytes.strip_weights, "weights of strips"},
                  {&self->strips, bytes.strips, "strips of points"},
                  {&self->strip_starts, bytes.strip_starts, "starts of strips"},
                  {&self->values, shape->at_once * bytes.values + bytes.gaps, "values on rings"},
                  {&self->states, bytes.states, "states of rings"},
                  {&self->scales, bytes.scales, "scales of rings"},
                  {&self->diagonals, bytes.diagonals, "first degrees of rings"},
                  {&self->diagonal_scales, bytes.diagonals / 2, "scales of first degrees"},
                  {&self->sums, (shape->at_once + 1) * bytes.sums, "sums over rings"}};
    for (size_t i = 0; i < sizeof wanted / sizeof wanted[0]; i++) {
        PS_TRY(ps_buffer_create(self->device, wanted[i].buffer, wanted[i].bytes, wanted[i].what,
                                error));
    }
    return PSPEC_OK;
}

pspec_status ps_sphere_stages_create(ps_sphere_stages *out, const ps_sphere_shape *shape,
                                     const ps_sphere_places *points, const ps_sphere_tables *tables,
                                     bool only_even, ps_precision precision, ps_device *device,
                                     ps_error *error) {
    *out = (ps_sphere_stages){.device = device,
                              .precision = precision,
                              .only_even = only_even,
                              .shape = shape,
                              .points = points,
                              .tables = tables};
    PS_TRY(ps_sphere_ring_tables_create(&out->rings, shape, precision, device, error));
    PS_TRY(ps_sphere_powers_create(&out->powers, shape, precision, device, error));
    PS_TRY(create_kernels(out, error));
    return create_buffers(out, error);
}

void ps_sphere_stages_free(ps_sphere_stages *stages) {
    ps_buffer *const buffers[] = {&stages->strip_turns,  &stages->strip_weights,   &stages->strips,
                                  &stages->strip_starts, &stages->grids,           &stages->rows,
                                  &stages->values,       &stages->states,          &stages->scales,
                                  &stages->diagonals,    &stages->diagonal_scales, &stages->sums,
                                  &stages->scratch};
    for (size_t i = 0; i < sizeof buffers / sizeof buffers[0]; i++) {
        ps_buffer_release(buffers[i]);
    }
    ps_sphere_powers_free(&stages->powers);
    ps_sphere_ring_tables_free(&stages->rings);
    *stages = (ps_sphere_stages){0};
}

/* ---- run --------------------------------------------------------------------------------- */

/* Some of the realizations whose points are on the device. */
typedef struct some_realizations {
    size_t first, end;
    size_t first_value; /* where values of the first of all of them go */
} some_realizations;

static orders_numbers numbers_of(const ps_sphere_stages *self, some_realizations some,
                                 unsigned steps, size_t shares) {
    const ps_sphere_shape *shape = self->shape;
    const ps_nufft_plan *plan = &self->tables->plan;
    return (orders_numbers){.most_points = shape->set_points,
                            .window = ps_nufft_window_numbers(plan),
                            .first_realization = (uint32_t)some.first,
                            .end_realization = (uint32_t)some.end,
                            .steps = steps,
                            .shares = (uint32_t)shares,
                            .L = (uint32_t)shape->max_degree,
                            .only_even = self->only_even,
                            .pitch = (uint32_t)shape->pitch,
                            .grid_rows = (uint32_t)shape->grid_rows,
                            .bands = (uint32_t)shape->bands,
                            .pole = (uint32_t)shape->pole,
                            .columns = (uint32_t)shape->columns,
                            .strip = (uint32_t)shape->strip,
                            .rings = (uint32_t)shape->rings,
                            .num_rings = (uint32_t)shape->num_rings,
                            .ring_pitch = (uint32_t)shape->ring_pitch,
                            .first_value = (uint32_t)some.first_value,
                            .value_sets = (uint32_t)shape->at_once};
}

/* Runs the steps for as many realizations at a time as there are slots. */
static pspec_status run_steps(ps_sphere_stages *self, some_realizations some, unsigned steps,
                              size_t shares, ps_error *error) {
    const ps_sphere_shape *shape = self->shape;
    const ps_sphere_tables *tables = self->tables;
    const ps_sphere_ring_tables *rings = &self->rings;
    const ps_sphere_local local = ps_sphere_local_bytes(shape, ps_real_bytes(self->precision));
    const orders_numbers numbers = numbers_of(self, some, steps, shares);
    const size_t num = some.end - some.first;
    const size_t slots = num < shape->slots ? num : shape->slots;
    const double transforms = (double)num * shape->pairs * 4.0 * shape->lanes;
    const ps_range range =
        ps_sphere_group_range(self->device, self->powers.is_alone, slots * shares,
                              transforms * ps_fft_flops(shape->axis.n));
    return PS_LAUNCH(self->device, self->orders, &range, error, PS_STRUCT(numbers),
                     PS_BUFFER(self->points->turns), PS_BUFFER(self->points->weights),
                     PS_BUFFER(self->points->offsets), PS_BUFFER(tables->plan.coefficients),
                     PS_BUFFER(tables->halves.radices), PS_BUFFER(tables->halves.twiddles),
                     PS_BUFFER(tables->halves.position), PS_BUFFER(rings->transforms.radices),
                     PS_BUFFER(rings->transforms.twiddles), PS_BUFFER(rings->transforms.position),
                     PS_BUFFER(rings->turns), PS_BUFFER(rings->ring_turns),
                     PS_BUFFER(tables->around_gains), PS_BUFFER(rings->along_gains),
                     PS_BUFFER(self->strip_turns), PS_BUFFER(self->strip_weights),
                     PS_BUFFER(self->strips), PS_BUFFER(self->strip_starts), PS_BUFFER(self->grids),
                     PS_BUFFER(self->rows), PS_BUFFER(self->values), PS_BUFFER(self->scratch),
                     PS_LOCAL(local.windows), PS_LOCAL(local.cells));
}

/* All steps in one go where there is a realization for every work-group; else slot by slot, each
 * shared. Strips are spread by who transforms them. */
pspec_status ps_sphere_stages_make_values(ps_sphere_stages *self, size_t first_value, size_t num,
                                          ps_error *error) {
    const ps_sphere_shape *shape = self->shape;
    if (shape->shares == 1) {
        const some_realizations all = {0, num, first_value};
        return run_steps(self, all, STEP_SPREAD | STEP_AROUND | STEP_RINGS, 1, error);
    }
    for (size_t first = 0; first < num; first += shape->slots) {
        const size_t end = num - first < shape->slots ? num : first + shape->slots;
        const some_realizations some = {first, end, first_value};
        if (ps_sphere_has_strips(shape)) {
            PS_TRY(run_steps(self, some, STEP_SPREAD | STEP_AROUND, shape->shares, error));
        } else {
            PS_TRY(run_steps(self, some, STEP_SPREAD, 1, error));
            PS_TRY(run_steps(self, some, STEP_AROUND, shape->shares, error));
        }
        PS_TRY(run_steps(self, some, STEP_RINGS, shape->shares, error));
    }
    return PSPEC_OK;
}

pspec_status ps_sphere_stages_add_sorted(ps_sphere_stages *stages, bool is_first, ps_error *error) {
    const ps_sphere_shape *shape = stages->shape;
    const ps_sphere_places *points = stages->points;
    const ps_nufft_plan *plan = &stages->tables->plan;
    const ps_buffer *heights = points->has_unit_weights ? &points->weights : &points->heights;
    const ps_sphere_local local = ps_sphere_local_bytes(shape, ps_real_bytes(stages->precision));
    const double flops_per_point = 2000;
    const orders_bands_numbers numbers = {
        .part_points = PS_SPHERE_PART_POINTS,
        .window = ps_nufft_window_numbers(plan),
        .num_parts = (uint32_t)ps_divide_up(points->num_points, PS_SPHERE_PART_POINTS),
        .tiles = shape->tiles,
        .is_first = is_first,
        .bands = shape->bands,
        .band_rows = shape->band_rows,
        .pitch = shape->pitch};
    const ps_range range =
        ps_sphere_group_range(stages->device, stages->powers.is_alone, shape->bands,
                              flops_per_point * (double)points->num_points);
    return PS_LAUNCH(stages->device, stages->bands, &range, error, PS_STRUCT(numbers),
                     PS_BUFFER(points->sorted), PS_BUFFER(*heights), PS_BUFFER(points->starts),
                     PS_BUFFER(plan->coefficients), PS_BUFFER(stages->grids),
                     PS_LOCAL(local.windows), PS_LOCAL(local.cells));
}

pspec_status ps_sphere_stages_finish_sorted(ps_sphere_stages *stages, size_t value,
                                            ps_error *error) {
    const size_t shares = stages->shape->shares;
    const some_realizations one = {0, 1, value};
    PS_TRY(run_steps(stages, one, STEP_AROUND, shares, error));
    return run_steps(stages, one, STEP_RINGS, shares, error);
}

/* ps_sphere_launch_sums */
static pspec_status sum_rings(void *stages, ps_kernel *kernel, const ps_buffer *to, size_t num,
                              ps_error *error) {
    const ps_sphere_stages *self = stages;
    const ps_sphere_shape *shape = self->shape;
    const ps_sphere_starts *rings = &self->rings.starts;
    const ps_sphere_local local = ps_sphere_local_bytes(shape, ps_real_bytes(self->precision));
    const double degrees = shape->max_degree;
    const double flops = 4 * degrees * degrees / 2 * shape->num_rings * (double)num;
    const ps_range range =
        ps_sphere_group_range(self->device, self->powers.is_alone, PS_SPHERE_GROUPS, flops);
    const orders_sum_numbers numbers = {.rings = ps_sphere_ring_numbers(shape, self->only_even),
                                        .value_sets = (uint32_t)shape->at_once,
                                        .num_realizations = (uint32_t)num,
                                        .half_pitch = shape->half_pitch};
    return PS_LAUNCH(
        self->device, kernel, &range, error, PS_STRUCT(numbers), PS_BUFFER(self->values),
        PS_BUFFER(rings->starts), PS_BUFFER(rings->start_scales), PS_BUFFER(rings->steps),
        PS_BUFFER(rings->step_scales), PS_BUFFER(rings->ratios), PS_BUFFER(rings->cosines),
        PS_BUFFER(rings->distances), PS_BUFFER(rings->squares), PS_BUFFER(self->states),
        PS_BUFFER(self->scales), PS_BUFFER(self->diagonals), PS_BUFFER(self->diagonal_scales),
        PS_BUFFER(self->sums), PS_BUFFER(*to), PS_LOCAL(local.table), PS_LOCAL(local.coefficients),
        PS_LOCAL(local.begins));
}

pspec_status ps_sphere_stages_sum(ps_sphere_stages *stages, size_t num, ps_error *error) {
    PS_TRY(sum_rings(stages, stages->sum, &stages->powers.sums, num, error));
    return ps_sphere_powers_fold(&stages->powers, num, error);
}

pspec_status ps_sphere_stages_keep(ps_sphere_stages *stages, double *coefficients,
                                   ps_error *error) {
    return ps_sphere_keep(&stages->powers, source_of_sums(stages), sum_rings, stages, coefficients,
                          error);
}
