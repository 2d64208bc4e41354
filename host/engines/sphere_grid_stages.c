#include "engines/sphere_grid_stages.h"

#include "engines/nufft_fft.h"
#include "engines/reals.h"

#include <stdio.h>
#include <string.h>

/* ---- create ------------------------------------------------------------------------------ */

enum { OPTIONS_BYTES = 80 };

static void write_options(const ps_sphere_grid_stages *self, char *options, size_t room) {
    snprintf(options, room, "-DPRECISION=%u -DLANES=%u -DRUN_VECTORS=%u -DALONE=%u",
             self->precision == PS_SINGLE ? 32u : 64u, self->shape->lanes, self->shape->run_vectors,
             self->is_alone ? 1u : 0u);
}

static pspec_status create_kernels(ps_sphere_grid_stages *self, ps_error *error) {
    char options[OPTIONS_BYTES];
    write_options(self, options, sizeof options);
    PS_TRY(ps_kernel_create(self->device, &self->make, "sphere/grid_values.cl",
                            "sphere_grid_values", options, error));
    PS_TRY(ps_kernel_create(self->device, &self->sum, "sphere/grid_sums.cl", "sphere_grid_sums",
                            options, error));
    return ps_kernel_create(self->device, &self->fold, "sphere/orders_fold.cl",
                            "sphere_orders_fold", options, error);
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
                  {&self->values, ps_sphere_value_bytes(shape, ps_real_bytes(self->precision)),
                   "values on angles"},
                  {&self->powers, shape->at_once * bytes.powers, "powers of orders"}};
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
                                   .is_alone = ps_range_is_alone(device),
                                   .shape = shape,
                                   .points = points,
                                   .tables = tables};
    PS_TRY(ps_sphere_grid_table_create(&out->table, shape, only_even, precision, device, error));
    PS_TRY(create_kernels(out, error));
    return create_buffers(out, error);
}

void ps_sphere_grid_stages_free(ps_sphere_grid_stages *stages) {
    const cl_kernel kernels[] = {stages->make, stages->sum, stages->fold};
    for (size_t i = 0; i < sizeof kernels / sizeof kernels[0]; i++) {
        if (kernels[i] != NULL) {
            clReleaseKernel(kernels[i]);
        }
    }
    ps_sphere_grid_table_free(&stages->table);
    ps_buffer_release(&stages->grids);
    ps_buffer_release(&stages->scratch);
    ps_buffer_release(&stages->values);
    ps_buffer_release(&stages->powers);
    *stages = (ps_sphere_grid_stages){0};
}

/* ---- run --------------------------------------------------------------------------------- */

/* Work-groups of one item on CPUs, where lanes are vectors. */
static ps_range group_range(const ps_sphere_grid_stages *self, size_t groups, double flops) {
    return self->is_alone ? ps_range_alone(groups, 1, flops, 0)
                          : ps_range_heavy(self->device, 1, groups, 1, flops, 0);
}

pspec_status ps_sphere_grid_make_values(ps_sphere_grid_stages *self, size_t first_value, size_t num,
                                        ps_error *error) {
    const ps_sphere_shape *shape = self->shape;
    const ps_sphere_tables *tables = self->tables;
    const ps_nufft_plan *plan = &tables->plan;
    const ps_sphere_local local = ps_sphere_local_bytes(shape, ps_real_bytes(self->precision));
    const size_t slots = num < shape->slots ? num : shape->slots;
    const double transforms = (double)num * shape->num_angles * 2;
    const ps_range range = group_range(self, slots, transforms * ps_fft_flops(plan->axis.n / 2));
    return PS_LAUNCH(self->device, self->make, &range, error, PS_BUFFER(self->points->turns),
                     PS_BUFFER(self->points->weights), PS_BUFFER(self->points->offsets),
                     PS_U32(num), PS_BUFFER(plan->coefficients), PS_U32(plan->axis.n),
                     PS_U32(plan->axis.window.width), PS_U32(plan->degree), PS_U32(plan->bins),
                     PS_BUFFER(tables->halves.radices), PS_BUFFER(tables->halves.twiddles),
                     PS_BUFFER(tables->halves.position), PS_BUFFER(tables->around_gains),
                     PS_BUFFER(self->table.begins), PS_U32(shape->most_runs),
                     PS_U32(shape->max_degree), PS_U32(self->only_even), PS_U32(shape->pitch),
                     PS_U32(shape->pole), PS_U32(shape->num_angles), PS_BUFFER(self->grids),
                     PS_BUFFER(self->values), PS_U32(first_value), PS_U32(shape->at_once),
                     PS_BUFFER(self->scratch), PS_LOCAL(local.windows), PS_LOCAL(local.cells));
}

/* To powers, or with the kernel that keeps them to coefficients. */
static pspec_status sum_cells(ps_sphere_grid_stages *self, cl_kernel kernel, const ps_buffer *to,
                              size_t num, ps_error *error) {
    const ps_sphere_shape *shape = self->shape;
    const ps_sphere_grid_table *table = &self->table;
    const ps_range range =
        group_range(self, PS_SPHERE_GROUPS, 4 * (double)shape->table_reals * (double)num);
    return PS_LAUNCH(self->device, kernel, &range, error, PS_BUFFER(self->values),
                     PS_U32(shape->at_once), PS_U32(num), PS_BUFFER(table->numbers),
                     PS_BUFFER(table->offsets), PS_BUFFER(table->begins), PS_U32(shape->most_runs),
                     PS_U32(shape->max_degree), PS_U32(shape->num_angles), PS_U32(self->only_even),
                     PS_U32(shape->half_pitch), PS_BUFFER(*to));
}

pspec_status ps_sphere_grid_sum(ps_sphere_grid_stages *stages, size_t num, double *powers,
                                ps_error *error) {
    const size_t entries = num * 2 * stages->shape->half_pitch;
    const ps_range range = ps_range_light(stages->device, entries / stages->shape->lanes, 1, 1,
                                          (double)(PS_SPHERE_GROUPS * entries), 0);
    PS_TRY(sum_cells(stages, stages->sum, &stages->powers, num, error));
    PS_TRY(PS_LAUNCH(stages->device, stages->fold, &range, error, PS_BUFFER(stages->powers),
                     PS_U32(PS_SPHERE_GROUPS), PS_U64(entries), PS_U32(stages->shape->half_pitch)));
    return ps_buffer_read(stages->device, &stages->powers, 0, powers, entries * sizeof(double),
                          error);
}

/* ---- coefficients ------------------------------------------------------------------------ */

static pspec_status keep_with(ps_sphere_grid_stages *self, cl_kernel kernel, size_t num, double *to,
                              ps_error *error) {
    ps_buffer kept = {0};
    PS_TRY(ps_buffer_create(self->device, &kept, num * sizeof(double), "coefficients", error));
    pspec_status status = sum_cells(self, kernel, &kept, 1, error);
    if (status == PSPEC_OK) {
        status = ps_buffer_read(self->device, &kept, 0, to, num * sizeof(double), error);
    }
    ps_buffer_release(&kept);
    return status;
}

/* Kernel and room only where they are asked for. */
pspec_status ps_sphere_grid_keep(ps_sphere_grid_stages *stages, double *coefficients,
                                 ps_error *error) {
    const size_t num = ((size_t)stages->shape->max_degree + 1) * 4 * stages->shape->half_pitch;
    static const char keep[] = " -DKEEP=1";
    char options[OPTIONS_BYTES + sizeof keep];
    cl_kernel kernel = NULL;
    write_options(stages, options, OPTIONS_BYTES);
    strcat(options, keep);
    PS_TRY(ps_kernel_create(stages->device, &kernel, "sphere/grid_sums.cl", "sphere_grid_sums",
                            options, error));
    const pspec_status status = keep_with(stages, kernel, num, coefficients, error);
    clReleaseKernel(kernel);
    return status;
}
