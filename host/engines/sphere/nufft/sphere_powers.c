/* From sums of orders to powers or coefficients: what sphere_nufft and sphere_grid have in common
 * behind their kernels of sums, and the options that both compile with. */
#include "engines/sphere/nufft/variants.h"

#include "device/reals.h"

pspec_status ps_sphere_kernel_get(const ps_sphere_state *self, ps_kernel **out,
                                  const ps_sphere_source *source, bool keeps, ps_error *error) {
    const ps_sphere_shape *shape = &self->shape;
    const size_t value_bytes = ps_real_bytes(self->precision);
    ps_defines defines = source->sums_one ? ps_defines_of(sizeof(double), shape->sum_lanes)
                                          : ps_defines_of(value_bytes, shape->lanes);
    ps_defines_add(&defines, "-DRUN_VECTORS=%u",
                   source->sums_one ? PS_SPHERE_ONE_RUN : shape->run_vectors);
    if (source->sums_one) {
        ps_defines_add(&defines,
                       "-DVALUE_PRECISION=%zu -DVALUE_LANES=%u -DRING_VECTORS=%u -DPARITIES=%u "
                       "-DSTATE_PRECISION=%u",
                       8 * value_bytes, shape->lanes, ps_sphere_one_vectors(shape),
                       self->only_even ? 1u : 2u, shape->is_single_chain ? 32u : 64u);
    }
    if (keeps) {
        ps_defines_add(&defines, "-DKEEP=1");
    }
    return ps_kernel_get(self->device, out, source->file, source->name, defines.text, error);
}

static const ps_sphere_source *source_of_sums(const ps_sphere_state *self) {
    return self->variant->sources_of_sums[self->shape.is_one_set];
}

pspec_status ps_sphere_powers_create(ps_sphere_state *self, ps_error *error) {
    static const ps_sphere_source fold = {.file = "sphere/nufft/orders_fold.cl",
                                          .name = "sphere_orders_fold"};
    const uint64_t each = (uint64_t)PS_SPHERE_GROUPS * 2 * self->shape.half_pitch * sizeof(double);
    PS_TRY(ps_sphere_kernel_get(self, &self->fold, &fold, false, error));
    PS_TRY(ps_sphere_kernel_get(self, &self->sum, source_of_sums(self), false, error));
    return ps_buffer_create(self->device, &self->sums, self->shape.at_once * each,
                            "powers of orders", error);
}

static pspec_status fold_sums(const ps_sphere_state *self, size_t num, ps_error *error) {
    const size_t entries = num * 2 * self->shape.half_pitch;
    const ps_range range = ps_range_light(self->device, entries / self->shape.lanes, 1, 1,
                                          (double)(PS_SPHERE_GROUPS * entries), 0);
    return PS_LAUNCH(self->device, self->fold, &range, error, PS_BUFFER(self->sums),
                     PS_U32(PS_SPHERE_GROUPS), PS_U64(entries), PS_U32(self->shape.half_pitch));
}

pspec_status ps_sphere_powers_sum(ps_sphere_state *self, size_t num, ps_error *error) {
    PS_TRY(self->variant->launch_sums(self, self->sum, &self->sums, num, error));
    return fold_sums(self, num, error);
}

/* ---- coefficients ------------------------------------------------------------------------ */

pspec_status ps_sphere_powers_keep(ps_sphere_state *self, double *coefficients, ps_error *error) {
    const size_t num = ((size_t)self->shape.max_degree + 1) * 4 * self->shape.half_pitch;
    ps_kernel *kernel = NULL;
    ps_buffer kept = {0};
    PS_TRY(ps_sphere_kernel_get(self, &kernel, source_of_sums(self), true, error));
    PS_TRY(ps_buffer_create(self->device, &kept, num * sizeof(double), "coefficients", error));
    pspec_status status = self->variant->launch_sums(self, kernel, &kept, 1, error);
    if (status == PSPEC_OK) {
        status = ps_buffer_read(self->device, &kept, 0, coefficients, num * sizeof(double), error);
    }
    ps_buffer_release(&kept);
    return status;
}
