#include "engines/torus/nufft/local.h"

/* How much each point of a chunk turns, kernels/nufft/spread.h. */
enum { TURN_REALS = 2 * PS_NUFFT_CHUNK };

size_t ps_nufft_chunk_reals(const ps_nufft_layout *layout) {
    return layout->chunk_reals + layout->group * TURN_REALS;
}

static size_t tiles_and_chunk(const ps_nufft_layout *layout, size_t num_tiles) {
    const size_t tile = layout->row_bytes + TURN_REALS * layout->real_bytes;
    const size_t chunk = (layout->line.spread_reals + layout->chunk_reals) * layout->real_bytes +
                         PS_NUFFT_CHUNK * (sizeof(uint64_t) + sizeof(uint32_t));
    return num_tiles * tile + chunk;
}

size_t ps_nufft_fitting_tiles(const ps_nufft_layout *layout, uint64_t local_bytes) {
    const size_t chunk = tiles_and_chunk(layout, 0);
    const size_t tile = tiles_and_chunk(layout, 1) - chunk;
    return local_bytes > chunk ? (size_t)(local_bytes - chunk) / tile : 0;
}

size_t ps_nufft_tiles_local_bytes(const ps_nufft_layout *layout) {
    return tiles_and_chunk(layout, layout->group);
}

static const size_t cells_bytes = 2 * PS_NUFFT_CHUNK * sizeof(uint32_t);

ps_nufft_local ps_nufft_boxes_local(const ps_nufft_layout *layout) {
    const ps_nufft_choice *choice = &layout->choice;
    size_t windows = PS_NUFFT_MAX_AXES + 1; /* centres and weights */
    for (unsigned i = 0; i < choice->num_axes; i++) {
        windows += ps_nufft_bins(&choice->axes[i]);
    }
    windows += choice->num_axes == 2 ? 1 : 0; /* in the place of an axis weights */
    return (ps_nufft_local){.rows = ps_nufft_boxes_reals(&layout->boxes) * layout->real_bytes,
                            .windows = PS_NUFFT_CHUNK * windows * layout->real_bytes,
                            .cells = cells_bytes};
}

ps_nufft_local ps_nufft_windows_local(const ps_nufft_layout *layout, size_t window_reals) {
    return (ps_nufft_local){.windows = window_reals * layout->real_bytes, .cells = cells_bytes};
}

size_t ps_nufft_local_sum(ps_nufft_local local) {
    return local.rows + local.windows + local.cells;
}
