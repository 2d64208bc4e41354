#include "engines/torus/nufft/layout.h"

#include "base/round.h"
#include "device/reals.h"

uint32_t ps_nufft_strip_columns(unsigned lanes) {
    return 2 * lanes > PS_NUFFT_MAX_WIDTH ? 2 * lanes : PS_NUFFT_MAX_WIDTH;
}

ps_nufft_strip_sizes ps_nufft_strips_measure(const ps_nufft_choice *choice, unsigned lanes) {
    const ps_nufft_axis *across = &choice->axes[0];
    const ps_nufft_axis *along = &choice->axes[1];
    const uint32_t columns = ps_nufft_strip_columns(lanes);
    const uint32_t pitch = (uint32_t)ps_round_up(columns + ps_nufft_bins(along), lanes);
    const size_t rows = (size_t)across->n + across->window.width;
    const size_t num_tiles = ps_divide_up(choice->span, lanes);
    return (ps_nufft_strip_sizes){.columns = columns,
                                  .pitch = pitch,
                                  .strip_reals = rows * pitch,
                                  .tile_reals = num_tiles * along->n * 2 * lanes,
                                  .window_reals = PS_NUFFT_CHUNK * ((size_t)ps_nufft_bins(across) +
                                                                    ps_nufft_bins(along) + 3)};
}

bool ps_nufft_strips_fit(const ps_nufft_choice *choice, ps_precision precision) {
    const size_t most_bytes = 1 << 25;
    return ps_nufft_strips_measure(choice, choice->lanes).tile_reals * ps_real_bytes(precision) <=
           most_bytes;
}
