#include "engines/torus/nufft/layout.h"

#include "base/round.h"

/* Realizations that share a last tile, at least: lanes are put there one by one. */
enum { LEAST_SHARING = 4 };

void ps_nufft_whole_kept(const ps_nufft_choice *choice, uint32_t kept[2]) {
    const uint32_t largest = (uint32_t)choice->axes[0].max_frequency;
    kept[0] = choice->num_axes == 1 ? choice->lengths[0] / 2 : largest;
    kept[1] = choice->num_axes == 1 ? largest / choice->lengths[0] + 1 : largest;
}

uint32_t ps_nufft_whole_shared(const ps_nufft_choice *choice, unsigned lanes) {
    const uint32_t last = choice->span % lanes;
    return choice->num_axes == 2 && last * LEAST_SHARING <= lanes ? last : 0;
}

ps_nufft_whole_sizes ps_nufft_whole_measure(const ps_nufft_choice *choice, unsigned lanes) {
    const bool is_line = choice->num_axes == 1;
    const ps_nufft_axis *across = &choice->axes[0];
    const ps_nufft_axis *along = &choice->axes[choice->num_axes - 1];
    const uint32_t unit = 2 * lanes;
    const uint32_t columns = (uint32_t)ps_round_up(choice->lengths[1], unit);
    const uint32_t behind = ps_nufft_bins(along);
    const uint32_t wanted = along->n + behind > columns ? along->n + behind : columns;
    ps_nufft_whole_sizes sizes = {.columns = columns};
    sizes.pitch = is_line ? choice->lengths[1] : (uint32_t)ps_round_up(wanted, lanes);
    sizes.grid_rows =
        is_line ? choice->lengths[0] + (uint32_t)ps_divide_up(behind + 2 * unit, choice->lengths[1])
                : across->n + across->window.width;
    sizes.grid_reals = ps_round_up((uint64_t)sizes.grid_rows * sizes.pitch, lanes);
    sizes.shared = ps_nufft_whole_shared(choice, lanes);
    sizes.row_reals = (size_t)columns * unit;
    if (is_line) {
        sizes.row_reals += (size_t)choice->lengths[0] * unit;
    } else if (sizes.shared > 0) { /* loads go on for a vector, kernels/nufft/shared_tile.h */
        sizes.row_reals += (size_t)columns * unit + lanes;
    }
    sizes.window_reals =
        PS_NUFFT_CHUNK * ((is_line ? 1 : ps_nufft_bins(across)) + ps_nufft_bins(along) + 3);
    return sizes;
}
