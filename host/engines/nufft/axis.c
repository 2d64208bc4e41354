#include "engines/nufft/axis.h"

#include "base/round.h"

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

double ps_nufft_gain(const ps_nufft_axis *axis, uint32_t k) {
    const double transform = ps_nufft_window_transform(&axis->window, (long double)k / axis->n);
    return 1 / (transform * transform);
}
