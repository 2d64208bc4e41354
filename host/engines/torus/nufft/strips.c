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

/* Work-groups: no more than there are cores. One that goes on to another realization has its tiles
 * in the last cache still, 0.82 to 0.93 of the time of one for each (K = 256 and 512). */
static size_t num_groups(const ps_nufft_strips *self, size_t num_realizations) {
    const size_t cores = ps_device_get_limits(self->device)->compute_units;
    const size_t most = self->layout->groups < cores ? self->layout->groups : cores;
    return num_realizations < most ? num_realizations : most;
}

static ps_range range_of(const ps_nufft_strips *self, size_t num_realizations) {
    const ps_nufft_layout *layout = self->layout;
    const ps_nufft_axis *axes = layout->choice.axes;
    const double transforms = ps_fft_flops(axes[0].n) * axes[1].n / 2 +
                              ps_fft_flops(axes[1].n) * (double)layout->num_tiles * layout->lanes;
    const double spread = 2.0 * axes[0].window.width * axes[1].window.width;
    return ps_range_alone(
        num_groups(self, num_realizations), 1,
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
