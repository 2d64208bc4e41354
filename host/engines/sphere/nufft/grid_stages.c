#include "engines/sphere/nufft/variants.h"

#include "device/reals.h"
#include "engines/nufft/fft.h"

/* One kernel sums powers, another coefficients. */
static const ps_sphere_source sums = {"sphere/nufft/grid_sums.cl", "sphere_grid_sums", false};

/* ---- create ------------------------------------------------------------------------------ */

static pspec_status create_kernels(ps_sphere_grid_stages *self, ps_error *error) {
    static const ps_sphere_source values = {"sphere/nufft/grid_values.cl", "sphere_grid_values",
                                            false};
    PS_TRY(ps_sphere_kernel_get(&self->powers, &self->make, &values, false, error));
    return ps_sphere_kernel_get(&self->powers, &self->sum, &sums, false, error);
}

static pspec_status create_buffers(ps_sphere_grid_stages *self, ps_error *error) {
    const ps_sphere_shape *shape = self->shape;
    const ps_sphere_bytes bytes = ps_sphere_bytes_of(shape, ps_real_bytes(self->precision));
    const struct {
        ps_buffer *buffer;
        size_t bytes;
        const char *what;
    } wanted[] = {{&self->grids, bytes.grids, "grids of the sphere"},
                  {&self->scratch, bytes.scratch, "rows of transforms"},
                  {&self->values, shape->at_once * bytes.values + bytes.gaps, "values on angles"}};
    for (size_t i = 0; i < sizeof wanted / sizeof wanted[0]; i++) {
        PS_TRY(ps_buffer_create(self->device, wanted[i].buffer, wanted[i].bytes, wanted[i].what,
                                error));
    }
    return PSPEC_OK;
}

pspec_status ps_sphere_grid_stages_create(ps_sphere_grid_stages *out, const ps_sphere_shape *shape,
                                          const ps_sphere_places *points,
                                          const ps_sphere_tables *tables, bool only_even,
                                          ps_precision precision, ps_device *device,
                                          ps_error *error) {
    *out = (ps_sphere_grid_stages){.device = device,
                                   .precision = precision,
                                   .only_even = only_even,
                                   .shape = shape,
                                   .points = points,
                                   .tables = tables};
    PS_TRY(ps_sphere_grid_table_create(&out->table, shape, only_even, precision, device, error));
    PS_TRY(ps_sphere_powers_create(&out->powers, shape, precision, device, error));
    PS_TRY(create_kernels(out, error));
    return create_buffers(out, error);
}

void ps_sphere_grid_stages_free(ps_sphere_grid_stages *stages) {
    ps_sphere_grid_table_free(&stages->table);
    ps_buffer_release(&stages->grids);
    ps_buffer_release(&stages->scratch);
    ps_buffer_release(&stages->values);
    ps_sphere_powers_free(&stages->powers);
    *stages = (ps_sphere_grid_stages){0};
}

/* ---- run --------------------------------------------------------------------------------- */

static grid_values_numbers numbers_of(const ps_sphere_grid_stages *self, size_t first_value,
                                      size_t num) {
    const ps_sphere_shape *shape = self->shape;
    const ps_nufft_plan *plan = &self->tables->plan;
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

pspec_status ps_sphere_grid_make_values(ps_sphere_grid_stages *self, size_t first_value, size_t num,
                                        ps_error *error) {
    const ps_sphere_shape *shape = self->shape;
    const ps_sphere_tables *tables = self->tables;
    const ps_nufft_plan *plan = &tables->plan;
    const ps_sphere_local local = ps_sphere_local_bytes(shape, ps_real_bytes(self->precision));
    const grid_values_numbers numbers = numbers_of(self, first_value, num);
    const size_t slots = num < shape->slots ? num : shape->slots;
    const double transforms = (double)num * shape->num_angles * 2;
    const ps_range range = ps_sphere_group_range(self->device, self->powers.is_alone, slots,
                                                 transforms * ps_fft_flops(plan->axis.n / 2));
    return PS_LAUNCH(self->device, self->make, &range, error, PS_STRUCT(numbers),
                     PS_BUFFER(self->points->turns), PS_BUFFER(self->points->weights),
                     PS_BUFFER(self->points->offsets), PS_BUFFER(plan->coefficients),
                     PS_BUFFER(tables->halves.radices), PS_BUFFER(tables->halves.twiddles),
                     PS_BUFFER(tables->halves.position), PS_BUFFER(tables->around_gains),
                     PS_BUFFER(self->table.begins), PS_BUFFER(self->grids), PS_BUFFER(self->values),
                     PS_BUFFER(self->scratch), PS_LOCAL(local.windows), PS_LOCAL(local.cells));
}

/* ps_sphere_launch_sums */
static pspec_status sum_cells(void *stages, ps_kernel *kernel, const ps_buffer *to, size_t num,
                              ps_error *error) {
    const ps_sphere_grid_stages *self = stages;
    const ps_sphere_shape *shape = self->shape;
    const ps_sphere_grid_table *table = &self->table;
    const ps_range range =
        ps_sphere_group_range(self->device, self->powers.is_alone, PS_SPHERE_GROUPS,
                              4 * (double)shape->table_reals * (double)num);
    return PS_LAUNCH(self->device, kernel, &range, error, PS_BUFFER(self->values),
                     PS_U32(shape->at_once), PS_U32(num), PS_BUFFER(table->numbers),
                     PS_BUFFER(table->offsets), PS_BUFFER(table->begins), PS_U32(shape->most_runs),
                     PS_U32(shape->max_degree), PS_U32(shape->num_angles), PS_U32(self->only_even),
                     PS_U32(shape->half_pitch), PS_BUFFER(*to));
}

pspec_status ps_sphere_grid_sum(ps_sphere_grid_stages *stages, size_t num, ps_error *error) {
    PS_TRY(sum_cells(stages, stages->sum, &stages->powers.sums, num, error));
    return ps_sphere_powers_fold(&stages->powers, num, error);
}

pspec_status ps_sphere_grid_keep(ps_sphere_grid_stages *stages, double *coefficients,
                                 ps_error *error) {
    return ps_sphere_keep(&stages->powers, &sums, sum_cells, stages, coefficients, error);
}
