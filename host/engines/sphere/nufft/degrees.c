/* Sums over rings on GPUs: coefficients by a work-group for each order and some realizations
 * (kernels/sphere/nufft/degrees.cl), then powers or what is kept of them (degree_powers.cl). */
#include "engines/sphere/nufft/variants.h"

#include "base/round.h"
#include "device/reals.h"
#include "sphere/nufft/degrees.h"

ps_sphere_degree_sizes ps_sphere_degrees_measure(bool is_one_set, const ps_device_limits *limits,
                                                 size_t real_bytes) {
    enum { WANTED_RINGS = 64, LEAST_RINGS = 8, WANTED_SETS = 8 };
    ps_sphere_degree_sizes sizes = {.sets = is_one_set ? 1 : WANTED_SETS,
                                    .coefficients = DEGREES_OF_RUN * 3 * sizeof(double)};
    for (uint32_t rings = WANTED_RINGS; rings >= LEAST_RINGS; rings /= 2) {
        sizes.table = DEGREES_OF_RUN * (rings + (size_t)1) * real_bytes;
        sizes.columns = 2 * rings * (2 * sizes.sets + (size_t)1) * real_bytes;
        const size_t bytes = sizes.table + sizes.columns + sizes.coefficients + sizeof(uint32_t);
        if (rings <= limits->max_work_group_size && bytes <= limits->local_bytes) {
            sizes.rings = rings;
            break;
        }
    }
    return sizes;
}

uint64_t ps_sphere_degrees_bytes(const ps_sphere_shape *shape, size_t real_bytes) {
    const uint32_t L = (uint32_t)shape->max_degree;
    return 2 * coefficients_of(L, L + 1) * real_bytes;
}

pspec_status ps_sphere_degrees_create(ps_sphere_degrees *out, const ps_sphere_state *self,
                                      ps_error *error) {
    const ps_sphere_shape *shape = &self->shape;
    const size_t real_bytes = ps_real_bytes(self->precision);
    ps_defines defines = ps_defines_of(real_bytes, 0);
    out->range =
        ps_range_shared(self->device, shape->degrees.rings, (size_t)shape->max_degree + 1, 0, 0, 0);
    out->rings = shape->degrees.rings < out->range.local[0] ? shape->degrees.rings
                                                            : (uint32_t)out->range.local[0];
    ps_defines_add(&defines, "-DRINGS=%lu -DSETS=%lu", (unsigned long)out->rings,
                   (unsigned long)shape->degrees.sets);
    PS_TRY(ps_kernel_get(self->device, &out->sum, "sphere/nufft/degrees.cl", "sphere_degrees",
                         defines.text, error));
    return ps_buffer_create(self->device, &out->coefficients,
                            shape->at_once * ps_sphere_degrees_bytes(shape, real_bytes),
                            "coefficients", error);
}

void ps_sphere_degrees_free(ps_sphere_degrees *degrees) {
    ps_buffer_release(&degrees->coefficients);
}

/* Rings come in blocks of about the same size. */
static degrees_numbers numbers_of(const ps_sphere_state *self, uint32_t rings, size_t num) {
    const ps_sphere_shape *shape = &self->shape;
    const uint64_t blocks = ps_divide_up(shape->num_rings, rings);
    return (degrees_numbers){.order_apart = ps_sphere_order_apart(shape),
                             .L = (uint32_t)shape->max_degree,
                             .only_even = self->only_even,
                             .num_rings = shape->num_rings,
                             .ring_pitch = shape->ring_pitch,
                             .block = (uint32_t)ps_divide_up(shape->num_rings, blocks),
                             .groups = PS_SPHERE_GROUPS,
                             .num_sets = (uint32_t)num};
}

static pspec_status make_coefficients(const ps_sphere_state *self, const ps_sphere_degrees *degrees,
                                      const ps_sphere_starts *starts, size_t num, ps_error *error) {
    const ps_sphere_degree_sizes *sizes = &self->shape.degrees;
    const degrees_numbers numbers = numbers_of(self, degrees->rings, num);
    const double L = self->shape.max_degree;
    ps_range range = degrees->range;
    range.global[2] = ps_divide_up(num, sizes->sets);
    range.flops = 4 * L * L / 2 * self->shape.num_rings * (double)num;
    return PS_LAUNCH(
        self->device, degrees->sum, &range, error, PS_STRUCT(numbers), PS_BUFFER(self->values),
        PS_BUFFER(starts->starts), PS_BUFFER(starts->start_scales), PS_BUFFER(starts->steps),
        PS_BUFFER(starts->step_scales), PS_BUFFER(starts->ratios), PS_BUFFER(starts->distances),
        PS_BUFFER(degrees->coefficients), PS_LOCAL(sizes->table), PS_LOCAL(sizes->columns),
        PS_LOCAL(sizes->coefficients), PS_LOCAL(sizeof(uint32_t)));
}

pspec_status ps_sphere_degrees_sum(const ps_sphere_state *self, const ps_sphere_degrees *degrees,
                                   const ps_sphere_starts *starts, ps_kernel *kernel,
                                   const ps_buffer *to, size_t num, ps_error *error) {
    const bool keeps = to != &self->sums;
    const ps_sphere_shape *shape = &self->shape;
    const size_t L = (size_t)shape->max_degree;
    const size_t step = self->only_even ? 2 : 1;
    const double flops = 4 * (double)L * (double)L / 2 * (double)num;
    const ps_range range =
        ps_range_light(self->device, L / step + 1, keeps ? L + 1 : PS_SPHERE_GROUPS, num, flops, 0);
    PS_TRY(make_coefficients(self, degrees, starts, num, error));
    return PS_LAUNCH(self->device, kernel, &range, error, PS_BUFFER(degrees->coefficients),
                     PS_U32(L), PS_U32(step), PS_U32(shape->half_pitch), PS_BUFFER(*to));
}
