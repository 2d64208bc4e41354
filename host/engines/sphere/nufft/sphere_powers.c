/* From sums of orders to powers or coefficients: what sphere_nufft and sphere_grid have in common
 * behind their kernels of sums, and the options that both compile with. */
#include "engines/sphere/nufft/variants.h"

#include "device/reals.h"

ps_defines ps_sphere_defines(const ps_sphere_shape *shape, ps_precision precision) {
    ps_defines defines = ps_defines_of(ps_real_bytes(precision), shape->lanes);
    ps_defines_add(&defines, "-DRUN_VECTORS=%u", shape->run_vectors);
    return defines;
}

pspec_status ps_sphere_kernel_get(const ps_sphere_state *self, ps_kernel **out, const char *name,
                                  ps_error *error) {
    const ps_defines defines = ps_sphere_defines(&self->shape, self->precision);
    return ps_kernel_get(self->device, out, self->variant->program, name, defines.text, error);
}

/* In double precision, with lanes of its own. */
static ps_defines defines_of_sums_one(const ps_sphere_state *self) {
    const ps_sphere_shape *shape = &self->shape;
    ps_defines defines = ps_defines_of(sizeof(double), shape->sum_lanes);
    ps_defines_add(&defines, "-DRUN_VECTORS=%u -DVALUE_PRECISION=%zu -DVALUE_LANES=%u",
                   PS_SPHERE_ONE_RUN, 8 * ps_real_bytes(self->precision), shape->lanes);
    ps_defines_add(&defines, "-DRING_VECTORS=%u -DPARITIES=%u -DSTATE_PRECISION=%u",
                   ps_sphere_one_vectors(shape), self->only_even ? 1u : 2u,
                   shape->is_single_chain ? 32u : 64u);
    return defines;
}

/* keeps: coefficients, instead of sums of their squares. */
static pspec_status get_sums(const ps_sphere_state *self, ps_kernel **out, bool keeps,
                             ps_error *error) {
    const bool is_one = self->shape.is_one_set && self->variant->has_sums_one;
    ps_defines defines =
        is_one ? defines_of_sums_one(self) : ps_sphere_defines(&self->shape, self->precision);
    if (keeps) {
        ps_defines_add(&defines, "-DKEEP=1");
    }
    return ps_kernel_get(
        self->device, out, is_one ? "sphere/nufft/orders_sum_one.cl" : self->variant->program,
        is_one ? "sphere_orders_sum_one" : self->variant->sums, defines.text, error);
}

pspec_status ps_sphere_powers_create(ps_sphere_state *self, ps_error *error) {
    const uint64_t each = (uint64_t)PS_SPHERE_GROUPS * 2 * self->shape.half_pitch * sizeof(double);
    PS_TRY(ps_sphere_kernel_get(self, &self->fold, "sphere_orders_fold", error));
    PS_TRY(get_sums(self, &self->sum, false, error));
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
    PS_TRY(get_sums(self, &kernel, true, error));
    PS_TRY(ps_buffer_create(self->device, &kept, num * sizeof(double), "coefficients", error));
    pspec_status status = self->variant->launch_sums(self, kernel, &kept, 1, error);
    if (status == PSPEC_OK) {
        status = ps_buffer_read(self->device, &kept, 0, coefficients, num * sizeof(double), error);
    }
    ps_buffer_release(&kept);
    return status;
}
