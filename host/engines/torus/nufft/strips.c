#include "engines/torus/nufft/strips.h"

#include "engines/torus/nufft/local.h"
#include "nufft/strips.h"

#include <stdio.h>

/* ---- create ------------------------------------------------------------------------------ */

pspec_status ps_nufft_strips_create(ps_nufft_strips *out, const ps_nufft_layout *layout,
                                    const ps_nufft_plan *plans, const ps_nufft_places *places,
                                    ps_precision precision, ps_device *device, ps_error *error) {
    char options[64];
    const size_t bytes = layout->groups * layout->real_bytes;
    *out = (ps_nufft_strips){.layout = layout, .plans = plans, .places = places, .device = device};
    snprintf(options, sizeof options, "-DPRECISION=%u -DLANES=%u",
             precision == PS_SINGLE ? 32u : 64u, layout->lanes);
    PS_TRY(
        ps_kernel_create(device, &out->kernel, "nufft/strips.cl", "nufft_strips", options, error));
    PS_TRY(ps_buffer_create(device, &out->strips, bytes * layout->strips.strip_reals, "strips",
                            error));
    return ps_buffer_create(device, &out->tiles, bytes * layout->strips.tile_reals, "tiles", error);
}

void ps_nufft_strips_free(ps_nufft_strips *strips) {
    if (strips->kernel != NULL) {
        clReleaseKernel(strips->kernel);
    }
    ps_buffer_release(&strips->strips);
    ps_buffer_release(&strips->tiles);
    *strips = (ps_nufft_strips){0};
}

/* ---- run --------------------------------------------------------------------------------- */

/* The arguments of an axis, as kernels/nufft/strips.cl has them. */
#define STRIPS_AXIS(plan)                                                                          \
    PS_BUFFER((plan)->fft.radices), PS_BUFFER((plan)->fft.twiddles),                               \
        PS_BUFFER((plan)->fft.position), PS_BUFFER((plan)->gains)

static ps_range range_of(const ps_nufft_strips *self, size_t num_realizations) {
    const ps_nufft_layout *layout = self->layout;
    const ps_nufft_axis *axes = layout->choice.axes;
    const double transforms = ps_fft_flops(axes[0].n) * axes[1].n / 2 +
                              ps_fft_flops(axes[1].n) * (double)layout->num_tiles * layout->lanes;
    const double spread = 2.0 * axes[0].window.width * axes[1].window.width;
    const size_t groups = num_realizations < layout->groups ? num_realizations : layout->groups;
    return ps_range_alone(
        groups, 1,
        (double)num_realizations * transforms + spread * (double)self->places->num_points, 0);
}

static strips_numbers numbers_of(const ps_nufft_strips *self, size_t num_realizations,
                                 size_t first_row) {
    const ps_nufft_layout *layout = self->layout;
    const ps_nufft_strip_sizes *sizes = &layout->strips;
    return (strips_numbers){.stride = layout->stride,
                            .strip_reals = sizes->strip_reals,
                            .across = ps_nufft_window_numbers(&self->plans[0]),
                            .along = ps_nufft_window_numbers(&self->plans[1]),
                            .K = (uint32_t)layout->choice.axes[0].max_frequency,
                            .columns = sizes->columns,
                            .pitch = sizes->pitch,
                            .num_tiles = layout->num_tiles,
                            .num_realizations = (uint32_t)num_realizations,
                            .first_row = (uint32_t)first_row};
}

pspec_status ps_nufft_strips_run(ps_nufft_strips *strips, size_t num_realizations,
                                 const ps_buffer *means, const ps_nufft_target *target,
                                 ps_error *error) {
    const ps_nufft_places *places = strips->places;
    const ps_nufft_plan *across = &strips->plans[0];
    const ps_nufft_plan *along = &strips->plans[1];
    const strips_numbers numbers = numbers_of(strips, num_realizations, target->realization);
    const ps_range range = range_of(strips, num_realizations);
    const ps_nufft_local local = ps_nufft_strips_local(strips->layout);
    return PS_LAUNCH(
        strips->device, strips->kernel, &range, error, PS_STRUCT(numbers),
        PS_BUFFER(places->places), PS_BUFFER(places->sorted), PS_BUFFER(places->heights),
        PS_BUFFER(places->starts), PS_BUFFER(across->coefficients), PS_BUFFER(along->coefficients),
        STRIPS_AXIS(across), STRIPS_AXIS(along), PS_BUFFER(*means), PS_BUFFER(*target->scales),
        PS_BUFFER(*target->power), PS_BUFFER(strips->strips), PS_BUFFER(strips->tiles),
        PS_LOCAL(local.windows), PS_LOCAL(local.cells));
}
