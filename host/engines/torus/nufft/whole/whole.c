/* Realizations done whole, each by one work-group: spread on a grid, transformed twice
 * (kernels/nufft/whole.cl).
 */
#include "base/memory.h"
#include "device/reals.h"
#include "engines/torus/nufft/local.h"
#include "engines/torus/nufft/variant.h"
#include "math/pi.h"
#include "nufft/whole.h"

#include <math.h>
#include <stdlib.h>

typedef struct whole {
    ps_kernel *kernel;
    bool is_alone; /* work-groups of one item: kernels/shared/group.h */
    ps_torus_points points;
    size_t num_points; /* that were uploaded */
    ps_fft_plan transforms[2];
    ps_buffer gains, lane_turns, tile_turns; /* of the kernel */
    ps_buffer grids, rows;                   /* of work-groups */
} whole;

static whole *of(const ps_nufft_state *self) {
    return self->own;
}

/* ---- tables ------------------------------------------------------------------------------ */

static double gain(const ps_nufft_axis *axis, uint32_t k) {
    return k <= (uint32_t)axis->max_frequency ? ps_nufft_gain(axis, k) : 0;
}

/* Returns the gain of frequency k_1 of the first transform and k_2 of the second. */
static double gain_of(const ps_nufft_choice *choice, uint32_t k_1, int64_t k_2) {
    if (choice->num_axes == 1) {
        const int64_t k = k_1 + choice->lengths[0] * k_2;
        return k_1 <= choice->lengths[0] / 2 ? gain(&choice->axes[0], (uint32_t)llabs(k)) : 0;
    }
    return gain(&choice->axes[0], k_1) * gain(&choice->axes[1], (uint32_t)llabs(k_2));
}

static pspec_status create_gains(ps_nufft_state *self, ps_error *error) {
    const ps_nufft_layout *layout = &self->layout;
    uint32_t kept[2];
    ps_nufft_whole_kept(&layout->choice, kept);
    double *gains = NULL;
    PS_TRY(PS_NEW(&gains, layout->stride, "gains", error));
    const double quarter = 0.25; /* the kernel's frequencies are doubled */
    for (size_t i = 0; i < layout->stride; i++) {
        const size_t row = i / layout->lanes;
        const size_t tile = row / (2 * (size_t)kept[1] + 1);
        const size_t k_1 = tile * layout->lanes + i % layout->lanes;
        gains[i] = quarter * gain_of(&layout->choice, (uint32_t)k_1,
                                     (int64_t)(row % (2 * (size_t)kept[1] + 1)) - kept[1]);
    }
    const pspec_status status = ps_reals_upload(self->device, &of(self)->gains, self->precision,
                                                gains, layout->stride, "gains", error);
    free(gains);
    return status;
}

/* exp(-2 pi i turns / n) */
static void turn(uint64_t turns, uint64_t n, double *cosine, double *sine) {
    const long double angle = PS_TWO_PI_L * (long double)(turns % n) / (long double)n;
    *cosine = (double)cosl(angle);
    *sine = (double)-sinl(angle);
}

/* Between the transforms of one dimension; in two, a number each, since buffers are not empty. */
static pspec_status create_turns(ps_nufft_state *self, ps_error *error) {
    const ps_nufft_layout *layout = &self->layout;
    const bool is_line = layout->choice.num_axes == 1;
    const size_t lanes = layout->lanes;
    const size_t cells = is_line ? layout->choice.lengths[1] : 1;
    const size_t num_tiles = is_line ? layout->num_tiles : 1;
    const uint64_t n = layout->choice.axes[0].n;
    const size_t most = 2 * cells * (num_tiles > lanes ? num_tiles : lanes);
    double *turns = NULL;
    PS_TRY(PS_NEW(&turns, most, "turns", error));
    for (size_t i = 0; i < cells * lanes; i++) {
        double *at = turns + i / lanes * 2 * lanes + i % lanes;
        turn(i % lanes * (i / lanes), n, at, at + lanes);
    }
    pspec_status status = ps_reals_upload(self->device, &of(self)->lane_turns, self->precision,
                                          turns, 2 * cells * lanes, "turns of lanes", error);
    for (size_t i = 0; i < cells * num_tiles; i++) {
        turn(i / cells * lanes * (i % cells), n, turns + 2 * i, turns + 2 * i + 1);
    }
    if (status == PSPEC_OK) {
        status = ps_reals_upload(self->device, &of(self)->tile_turns, self->precision, turns,
                                 2 * cells * num_tiles, "turns of tiles", error);
    }
    free(turns);
    return status;
}

/* ---- create ------------------------------------------------------------------------------ */

static pspec_status create_buffers(ps_nufft_state *self, ps_error *error) {
    const ps_nufft_layout *layout = &self->layout;
    PS_TRY(ps_buffer_create(self->device, &of(self)->grids,
                            layout->groups * layout->whole.grid_reals * layout->real_bytes, "grids",
                            error));
    return ps_buffer_create(self->device, &of(self)->rows,
                            layout->groups * layout->whole.row_reals * layout->real_bytes, "rows",
                            error);
}

static pspec_status create(ps_nufft_state *self, ps_error *error) {
    whole *own = of(self);
    const ps_nufft_layout *layout = &self->layout;
    own->is_alone = ps_range_is_alone(self->device);
    ps_defines defines = ps_defines_of(layout->real_bytes, layout->lanes);
    ps_defines_add(&defines, "-DALONE=%u", own->is_alone ? 1u : 0u);
    PS_TRY(ps_kernel_get(self->device, &own->kernel, "nufft/whole.cl", "nufft_whole", defines.text,
                         error));
    PS_TRY(ps_torus_points_create(&own->points, layout->choice.num_axes, layout->parts,
                                  layout->part_points, self->precision, false, self->device,
                                  error));
    for (size_t i = 0; i < 2; i++) {
        PS_TRY(ps_fft_plan_create(&own->transforms[i], layout->choice.lengths[i], self->precision,
                                  self->device, error));
    }
    PS_TRY(create_gains(self, error));
    PS_TRY(create_turns(self, error));
    return create_buffers(self, error);
}

static void free_own(void *own) {
    whole *const self = own;
    ps_torus_points_free(&self->points);
    for (size_t i = 0; i < 2; i++) {
        ps_fft_plan_free(&self->transforms[i]);
    }
    PS_BUFFERS_RELEASE(&self->gains, &self->lane_turns, &self->tile_turns, &self->grids,
                       &self->rows);
}

/* ---- run --------------------------------------------------------------------------------- */

static ps_range range_of(const ps_nufft_state *self, size_t num_realizations, size_t num_points) {
    const ps_nufft_choice *choice = &self->layout.choice;
    const double lanes = self->layout.lanes;
    const double flops =
        (double)num_realizations *
        (ps_fft_flops(choice->lengths[0]) * choice->lengths[1] / 2 +
         ps_fft_flops(choice->lengths[1]) * (double)self->layout.num_tiles * lanes);
    const double spread = 2.0 * choice->axes[0].window.width *
                          (choice->num_axes == 2 ? choice->axes[1].window.width : 1);
    const size_t groups =
        num_realizations < self->layout.groups ? num_realizations : self->layout.groups;
    const double all_flops = flops + spread * (double)num_points;
    return of(self)->is_alone ? ps_range_alone(groups, all_flops)
                              : ps_nufft_group_range(self->device, groups, 1, all_flops);
}

static pspec_status upload(ps_nufft_state *self, const ps_batch *some, ps_error *error) {
    return ps_torus_points_upload(&of(self)->points, self->device, some, 0, &of(self)->num_points,
                                  error);
}

static whole_numbers numbers_of(const ps_nufft_state *self, const ps_nufft_plan *across,
                                const ps_nufft_plan *along, size_t num_realizations,
                                size_t first_row) {
    const ps_nufft_layout *layout = &self->layout;
    const ps_nufft_whole_sizes *sizes = &layout->whole;
    uint32_t kept[2];
    ps_nufft_whole_kept(&layout->choice, kept);
    return (whole_numbers){.stride = layout->stride,
                           .grid_reals = sizes->grid_reals,
                           .row_reals = sizes->row_reals,
                           .across = ps_nufft_window_numbers(across),
                           .along = ps_nufft_window_numbers(along),
                           .first = {layout->choice.lengths[0], kept[0]},
                           .second = {layout->choice.lengths[1], kept[1]},
                           .dimension = layout->choice.num_axes,
                           .num_realizations = (uint32_t)num_realizations,
                           .first_row = (uint32_t)first_row,
                           .num_tiles = layout->num_tiles,
                           .pitch = (uint32_t)sizes->pitch,
                           .grid_rows = (uint32_t)sizes->grid_rows,
                           .shared_lanes = sizes->shared};
}

static pspec_status run(ps_nufft_state *self, size_t num_realizations,
                        const ps_nufft_target *target, ps_error *error) {
    const whole *own = of(self);
    const unsigned num_axes = self->layout.choice.num_axes;
    const ps_nufft_plan *along = &self->plans[num_axes - 1];
    const ps_nufft_plan none = {
        .coefficients = along->coefficients, .bins = 1, .axis = {.n = 1, .window = {.width = 1}}};
    const ps_nufft_plan *across = num_axes == 2 ? &self->plans[0] : &none;
    const whole_numbers numbers =
        numbers_of(self, across, along, num_realizations, target->realization);
    const ps_range range = range_of(self, num_realizations, own->num_points);
    const ps_nufft_local local =
        ps_nufft_windows_local(&self->layout, self->layout.whole.window_reals);
    return PS_LAUNCH(self->device, own->kernel, &range, error, PS_STRUCT(numbers),
                     PS_BUFFER(own->points.points), PS_BUFFER(own->points.weights),
                     PS_BUFFER(own->points.offsets), PS_BUFFER(across->coefficients),
                     PS_BUFFER(along->coefficients), PS_FFT_TABLES(own->transforms[0]),
                     PS_FFT_TABLES(own->transforms[1]), PS_BUFFER(own->lane_turns),
                     PS_BUFFER(own->tile_turns), PS_BUFFER(own->gains), PS_BUFFER(self->means),
                     PS_BUFFER(*target->scales), PS_BUFFER(*target->power), PS_BUFFER(own->grids),
                     PS_BUFFER(own->rows), PS_LOCAL(local.windows), PS_LOCAL(local.cells));
}

const ps_nufft_launcher ps_nufft_whole_launcher = {
    .own_bytes = sizeof(whole), .create = create, .free = free_own, .upload = upload, .run = run};
