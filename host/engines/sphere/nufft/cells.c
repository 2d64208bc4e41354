/* By cells: from points on the device to values on the angles of the grid
 * (kernels/sphere/grid/values.cl), and from these to powers or coefficients (sums.cl there). */
#include "engines/sphere/nufft/variants.h"

#include "base/round.h"
#include "device/reals.h"
#include "engines/nufft/fft.h"
#include "sphere/nufft/numbers.h"

typedef struct cells {
    ps_sphere_grid_table table;
    ps_kernel *make;
} cells;

static cells *of(const ps_sphere_state *self) {
    return self->own;
}

static pspec_status create(ps_sphere_state *self, ps_error *error) {
    PS_TRY(ps_sphere_grid_table_create(&of(self)->table, &self->shape, self->only_even,
                                       self->precision, self->device, error));
    return ps_sphere_kernel_get(self, &of(self)->make, "sphere_grid_values", error);
}

static void free_own(void *own) {
    ps_sphere_grid_table_free(&((cells *)own)->table);
}

/* ---- run --------------------------------------------------------------------------------- */

static grid_values_numbers numbers_of(const ps_sphere_state *self, size_t first_value, size_t num) {
    const ps_sphere_shape *shape = &self->shape;
    const ps_nufft_plan *plan = &self->tables.plan;
    return (grid_values_numbers){.window = ps_nufft_window_numbers(plan),
                                 .num_realizations = (uint32_t)num,
                                 .L = (uint32_t)shape->max_degree,
                                 .only_even = self->only_even,
                                 .pitch = shape->pitch,
                                 .pole = shape->pole,
                                 .num_angles = shape->num_angles,
                                 .most_runs = shape->most_runs,
                                 .first_value = (uint32_t)first_value,
                                 .value_sets = (uint32_t)shape->at_once};
}

static pspec_status make_values(ps_sphere_state *self, size_t first_value, const ps_batch *some,
                                ps_error *error) {
    const ps_sphere_shape *shape = &self->shape;
    const ps_sphere_tables *tables = &self->tables;
    const size_t num = some->num_patterns;
    const ps_nufft_plan *plan = &tables->plan;
    const ps_sphere_local local = ps_sphere_local_bytes(shape, ps_real_bytes(self->precision));
    const grid_values_numbers numbers = numbers_of(self, first_value, num);
    PS_TRY(ps_sphere_places_make(&self->points, some, error));
    const size_t slots = num < shape->slots ? num : shape->slots;
    const double transforms = (double)num * shape->num_angles * 2;
    const ps_range range = ps_range_alone(slots, transforms * ps_fft_flops(plan->axis.n / 2));
    return PS_LAUNCH(self->device, of(self)->make, &range, error, PS_STRUCT(numbers),
                     PS_BUFFER(self->points.turns), PS_BUFFER(self->points.weights),
                     PS_BUFFER(self->points.offsets), PS_BUFFER(plan->coefficients),
                     PS_FFT_TABLES(tables->halves), PS_BUFFER(tables->around_gains),
                     PS_BUFFER(of(self)->table.begins), PS_BUFFER(self->grids),
                     PS_BUFFER(self->values), PS_BUFFER(self->scratch), PS_LOCAL(local.windows),
                     PS_LOCAL(local.cells));
}

static pspec_status launch_sums(ps_sphere_state *self, ps_kernel *kernel, const ps_buffer *to,
                                size_t num, ps_error *error) {
    const ps_sphere_shape *shape = &self->shape;
    const ps_sphere_grid_table *table = &of(self)->table;
    const double flops = 4 * (double)shape->table_reals * (double)num;
    const ps_range range = ps_range_alone(PS_SPHERE_GROUPS, flops);
    return PS_LAUNCH(self->device, kernel, &range, error, PS_BUFFER(self->values),
                     PS_U32(shape->at_once), PS_U32(num), PS_BUFFER(table->numbers),
                     PS_BUFFER(table->offsets), PS_BUFFER(table->begins), PS_U32(shape->most_runs),
                     PS_U32(shape->max_degree), PS_U32(shape->num_angles), PS_U32(self->only_even),
                     PS_U32(shape->half_pitch), PS_BUFFER(*to));
}

/* ---- the row ----------------------------------------------------------------------------- */

static void describe(const ps_sphere_state *self, ps_text *text) {
    const ps_sphere_shape *shape = &self->shape;
    ps_text_append(text, "angles=%lu at_once=%zu table=%.3gMB", (unsigned long)shape->num_angles,
                   shape->at_once,
                   (double)(shape->table_reals * ps_real_bytes(self->precision)) * 1e-6);
}

/* The table of cells is made by a program of its own, in double precision. */
const ps_sphere_variant ps_sphere_cells = {.programs = 2,
                                           .program = "sphere/grid/values.cl",
                                           .count_table_flops = ps_sphere_grid_table_flops,
                                           .own_bytes = sizeof(cells),
                                           .create = create,
                                           .free = free_own,
                                           .make_values = make_values,
                                           .sums = "sphere_grid_sums",
                                           .launch_sums = launch_sums,
                                           .describe = describe};
