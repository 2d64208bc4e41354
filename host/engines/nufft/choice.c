#include "engines/nufft/choice.h"

uint32_t ps_nufft_tiled(const ps_nufft_choice *choice) {
    return choice->span - (choice->has_line ? 1 : 0);
}

uint32_t ps_nufft_base(const ps_nufft_choice *choice) {
    return choice->has_line ? 1 : choice->stride * (uint32_t)choice->axes[0].max_frequency;
}

const ps_nufft_axis *ps_nufft_last_axes(const ps_nufft_choice *choice, unsigned *num) {
    *num = choice->num_axes - (choice->is_gridded ? 1 : 0);
    return choice->axes + (choice->is_gridded ? 1 : 0);
}
