/* One axis of the fine grid on the device: its transform, its window as polynomials, what undoes
 * the window. */
#ifndef PS_ENGINES_NUFFT_GRID_AXIS_H
#define PS_ENGINES_NUFFT_GRID_AXIS_H

#include "engines/nufft/axis.h"
#include "engines/nufft/fft.h"
#include "nufft/numbers.h"

/* Part of the tolerance (or of roundoff, if that is more) that polynomials of windows may be off
 * by: little, since it adds up in step in sets as regular as the grid. One degree more costs a
 * percent. */
#define PS_NUFFT_POLYNOMIAL_SHARE 0.01

typedef struct ps_nufft_plan {
    ps_nufft_axis axis;
    uint32_t bins, pitch; /* of a window, kernels/nufft/place.h */
    unsigned degree;      /* of the polynomials */
    ps_fft_plan fft;
    ps_buffer coefficients; /* [degree + 1][bins] */
    ps_buffer gains;        /* [K + 1]: 1 / squared transform of the window */
} ps_nufft_plan;

/* tolerance: of the problem. has_transform: else there are neither fft nor gains, for whoever has
 * those of all axes together. */
pspec_status ps_nufft_plan_create(ps_nufft_plan *out, const ps_nufft_axis *axis, bool has_transform,
                                  double tolerance, ps_precision precision, ps_device *device,
                                  ps_error *error) PS_MUST_CHECK;
void ps_nufft_plan_free(ps_nufft_plan *plan);

/* What undoes the window in powers of frequencies 0 .. K, or, as its roots, in amplitudes. */
typedef enum ps_nufft_gains { PS_NUFFT_OF_POWERS, PS_NUFFT_OF_AMPLITUDES } ps_nufft_gains;
pspec_status ps_nufft_gains_create(ps_buffer *out, const ps_nufft_axis *axis, ps_nufft_gains of,
                                   ps_precision precision, ps_device *device,
                                   ps_error *error) PS_MUST_CHECK;

/* What launches are told of an axis: its window and place among coordinates, its transform. */
window_numbers ps_nufft_window_numbers(const ps_nufft_plan *plan);
axis_numbers ps_nufft_axis_numbers(const ps_nufft_plan *plan);
transform_numbers ps_nufft_transform_numbers(const ps_nufft_plan *plan);

/* Where powers go: rows from `realization` on of power, times their entries in scales. */
typedef struct ps_nufft_target {
    const ps_buffer *power, *scales;
    size_t realization;
} ps_nufft_target;

/* Work-groups of one item on CPUs, where lanes are vectors; of several that share a row on GPUs,
 * and where tests say so. */
ps_range ps_nufft_group_range(const ps_device *device, size_t num_groups, size_t num_realizations,
                              double flops);

#endif
