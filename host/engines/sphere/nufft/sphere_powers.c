#include "engines/sphere/nufft/sphere_powers.h"

#include "device/reals.h"

pspec_status ps_sphere_kernel_get(const ps_sphere_powers *self, ps_kernel **out,
                                  const ps_sphere_source *source, bool keeps, ps_error *error) {
    const ps_sphere_shape *shape = self->shape;
    const size_t value_bytes = ps_real_bytes(self->precision);
    ps_defines defines = source->sums_one ? ps_defines_of(sizeof(double), shape->sum_lanes)
                                          : ps_defines_of(value_bytes, shape->lanes);
    ps_defines_add(&defines, "-DRUN_VECTORS=%u -DALONE=%u", shape->run_vectors,
                   self->is_alone ? 1u : 0u);
    if (source->sums_one) {
        ps_defines_add(&defines, "-DVALUE_PRECISION=%zu -DVALUE_LANES=%u -DRING_VECTORS=%u",
                       8 * value_bytes, shape->lanes, ps_sphere_one_vectors(shape));
    }
    if (keeps) {
        ps_defines_add(&defines, "-DKEEP=1");
    }
    return ps_kernel_get(self->device, out, source->file, source->name, defines.text, error);
}

pspec_status ps_sphere_powers_create(ps_sphere_powers *out, const ps_sphere_shape *shape,
                                     ps_precision precision, ps_device *device, ps_error *error) {
    const uint64_t each = (uint64_t)PS_SPHERE_GROUPS * 2 * shape->half_pitch * sizeof(double);
    *out = (ps_sphere_powers){.device = device,
                              .precision = precision,
                              .is_alone = ps_range_is_alone(device),
                              .shape = shape};
    static const ps_sphere_source fold = {"sphere/nufft/orders_fold.cl", "sphere_orders_fold",
                                          false};
    PS_TRY(ps_sphere_kernel_get(out, &out->fold, &fold, false, error));
    return ps_buffer_create(device, &out->sums, shape->at_once * each, "powers of orders", error);
}

void ps_sphere_powers_free(ps_sphere_powers *powers) {
    ps_buffer_release(&powers->sums);
    *powers = (ps_sphere_powers){0};
}

ps_range ps_sphere_group_range(const ps_device *device, bool is_alone, size_t groups,
                               double flops) {
    return is_alone ? ps_range_alone(groups, 1, flops, 0)
                    : ps_range_heavy(device, 1, groups, 1, flops, 0);
}

pspec_status ps_sphere_powers_fold(const ps_sphere_powers *self, size_t num, ps_error *error) {
    const size_t entries = num * 2 * self->shape->half_pitch;
    const ps_range range = ps_range_light(self->device, entries / self->shape->lanes, 1, 1,
                                          (double)(PS_SPHERE_GROUPS * entries), 0);
    return PS_LAUNCH(self->device, self->fold, &range, error, PS_BUFFER(self->sums),
                     PS_U32(PS_SPHERE_GROUPS), PS_U64(entries), PS_U32(self->shape->half_pitch));
}

/* ---- coefficients ------------------------------------------------------------------------ */

static pspec_status keep_with(const ps_sphere_powers *self, ps_kernel *kernel,
                              ps_sphere_launch_sums launch, void *stages, double *to,
                              ps_error *error) {
    const size_t num = ((size_t)self->shape->max_degree + 1) * 4 * self->shape->half_pitch;
    ps_buffer kept = {0};
    PS_TRY(ps_buffer_create(self->device, &kept, num * sizeof(double), "coefficients", error));
    pspec_status status = launch(stages, kernel, &kept, 1, error);
    if (status == PSPEC_OK) {
        status = ps_buffer_read(self->device, &kept, 0, to, num * sizeof(double), error);
    }
    ps_buffer_release(&kept);
    return status;
}

pspec_status ps_sphere_keep(const ps_sphere_powers *self, const ps_sphere_source *source,
                            ps_sphere_launch_sums launch, void *stages, double *coefficients,
                            ps_error *error) {
    ps_kernel *kernel = NULL;
    PS_TRY(ps_sphere_kernel_get(self, &kernel, source, true, error));
    return keep_with(self, kernel, launch, stages, coefficients, error);
}
