#include "engines/nufft/plan.h"

#include "base/memory.h"
#include "base/round.h"
#include "device/reals.h"
#include "engines/nufft/kernels.h"

#include <math.h>
#include <stdlib.h>

/* Numbers of a window are made in whole vectors of 8 and begin at half cache lines. */
enum { BIN_UNIT = 8, PITCH_UNIT = 8 };

uint32_t ps_nufft_bins(const ps_nufft_axis *axis) {
    return (uint32_t)ps_round_up(axis->window.width, BIN_UNIT);
}

uint32_t ps_nufft_pitch(const ps_nufft_axis *axis) {
    const uint32_t written = PS_NUFFT_GAP + ps_nufft_bins(axis);
    const uint32_t read = axis->window.width + 2 * PS_NUFFT_GAP;
    return (uint32_t)ps_round_up(written > read ? written : read, PITCH_UNIT);
}

size_t ps_nufft_row_cells(const ps_nufft_axis *axis) {
    return (size_t)axis->n + axis->window.width + PS_NUFFT_GAP;
}

ps_range ps_nufft_group_range(const ps_device *device, size_t num_groups, size_t num_realizations,
                              double flops) {
    return ps_range_heavy(device, 1, num_groups, num_realizations, flops, 0);
}

/* ---- create ------------------------------------------------------------------------------ */

static pspec_status create_polynomials(ps_nufft_plan *plan, double tolerance,
                                       ps_precision precision, ps_device *device, ps_error *error) {
    const ps_nufft_axis *axis = &plan->axis;
    double coefficients[(PS_NUFFT_MAX_DEGREE + 1) * PS_NUFFT_MAX_WIDTH];
    /* When all bins are off together, they are divided by the transform at the largest frequency. */
    const double rounding = precision == PS_SINGLE ? 0x1p-24 : 0x1p-53;
    const double edge = (double)axis->max_frequency / axis->n;
    const double divisor = ps_nufft_window_transform(&axis->window, edge) / axis->window.width;
    plan->degree = ps_nufft_window_degree(&axis->window, PS_NUFFT_POLYNOMIAL_SHARE * divisor *
                                                             fmax(tolerance, rounding));
    ps_nufft_window_polynomials(&axis->window, plan->degree, plan->bins, coefficients);
    return ps_reals_upload(device, &plan->coefficients, precision, coefficients,
                           (plan->degree + 1) * (size_t)plan->bins, "window polynomials", error);
}

double ps_nufft_gain(const ps_nufft_axis *axis, uint32_t k) {
    const double transform = ps_nufft_window_transform(&axis->window, (long double)k / axis->n);
    return 1 / (transform * transform);
}

static pspec_status create_gains(ps_nufft_plan *plan, ps_precision precision, ps_device *device,
                                 ps_error *error) {
    const ps_nufft_axis *axis = &plan->axis;
    const size_t num = (size_t)axis->max_frequency + 1;
    void *memory = NULL;
    PS_TRY(ps_allocate(&memory, num, sizeof(double), "gains", error));
    double *gains = memory;
    for (size_t k = 0; k < num; k++) {
        gains[k] = ps_nufft_gain(axis, (uint32_t)k);
    }
    const pspec_status status =
        ps_reals_upload(device, &plan->gains, precision, gains, num, "gains", error);
    free(memory);
    return status;
}

pspec_status ps_nufft_plan_create(ps_nufft_plan *out, const ps_nufft_axis *axis, bool has_transform,
                                  double tolerance, ps_precision precision, ps_device *device,
                                  ps_error *error) {
    *out =
        (ps_nufft_plan){.axis = *axis, .bins = ps_nufft_bins(axis), .pitch = ps_nufft_pitch(axis)};
    PS_TRY(create_polynomials(out, tolerance, precision, device, error));
    if (!has_transform) {
        return PSPEC_OK;
    }
    PS_TRY(create_gains(out, precision, device, error));
    return ps_fft_plan_create(&out->fft, axis->n, precision, device, error);
}

void ps_nufft_plan_free(ps_nufft_plan *plan) {
    ps_buffer_release(&plan->coefficients);
    ps_buffer_release(&plan->gains);
    ps_fft_plan_free(&plan->fft);
}
