#include "engines/nufft/grid_axis.h"

#include "base/memory.h"
#include "device/reals.h"

#include <math.h>
#include <stdlib.h>

ps_range ps_nufft_group_range(const ps_device *device, size_t num_groups, size_t num_realizations,
                              double flops) {
    return ps_range_heavy(device, 1, num_groups, num_realizations, flops, 0);
}

/* ---- create ------------------------------------------------------------------------------ */

static pspec_status create_polynomials(ps_nufft_plan *plan, double tolerance,
                                       ps_precision precision, ps_device *device, ps_error *error) {
    const ps_nufft_axis *axis = &plan->axis;
    double coefficients[(PS_NUFFT_MAX_DEGREE + 1) * PS_NUFFT_MAX_WIDTH];
    /* When all bins are off together, they are divided by the transform at the largest frequency.
     */
    const double rounding = precision == PS_SINGLE ? 0x1p-24 : 0x1p-53;
    const double edge = (double)axis->max_frequency / axis->n;
    const double divisor = ps_nufft_window_transform(&axis->window, edge) / axis->window.width;
    plan->degree = ps_nufft_window_degree(&axis->window, PS_NUFFT_POLYNOMIAL_SHARE * divisor *
                                                             fmax(tolerance, rounding));
    ps_nufft_window_polynomials(&axis->window, plan->degree, plan->bins, coefficients);
    return ps_reals_upload(device, &plan->coefficients, precision, coefficients,
                           (plan->degree + 1) * (size_t)plan->bins, "window polynomials", error);
}

pspec_status ps_nufft_gains_create(ps_buffer *out, const ps_nufft_axis *axis, ps_nufft_gains of,
                                   ps_precision precision, ps_device *device, ps_error *error) {
    const size_t num = (size_t)axis->max_frequency + 1;
    double *gains = NULL;
    PS_TRY(PS_NEW(&gains, num, "gains", error));
    for (size_t k = 0; k < num; k++) {
        const double gain = ps_nufft_gain(axis, (uint32_t)k);
        gains[k] = of == PS_NUFFT_OF_AMPLITUDES ? sqrt(gain) : gain;
    }
    const pspec_status status = ps_reals_upload(device, out, precision, gains, num, "gains", error);
    free(gains);
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
    PS_TRY(ps_nufft_gains_create(&out->gains, axis, PS_NUFFT_OF_POWERS, precision, device, error));
    return ps_fft_plan_create(&out->fft, axis->n, precision, device, error);
}

void ps_nufft_plan_free(ps_nufft_plan *plan) {
    ps_buffer_release(&plan->coefficients);
    ps_buffer_release(&plan->gains);
    ps_fft_plan_free(&plan->fft);
}

/* ---- launches ---------------------------------------------------------------------------- */

window_numbers ps_nufft_window_numbers(const ps_nufft_plan *plan) {
    return (window_numbers){plan->axis.n, plan->axis.window.width, plan->degree, plan->bins};
}

axis_numbers ps_nufft_axis_numbers(const ps_nufft_plan *plan) {
    return (axis_numbers){.factor = plan->axis.factor,
                          .window = ps_nufft_window_numbers(plan),
                          .axis = plan->axis.axis,
                          .pitch = plan->pitch};
}

transform_numbers ps_nufft_transform_numbers(const ps_nufft_plan *plan) {
    return (transform_numbers){plan->axis.n, (uint32_t)plan->axis.max_frequency};
}
