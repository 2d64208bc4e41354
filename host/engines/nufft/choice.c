#include "engines/nufft/choice.h"

uint32_t ps_nufft_base(const ps_nufft_choice *choice) {
    return choice->stride * (uint32_t)choice->axes[0].max_frequency;
}

const ps_nufft_axis *ps_nufft_last_axes(const ps_nufft_choice *choice, unsigned *num) {
    *num = choice->num_axes - (choice->is_gridded ? 1 : 0);
    return choice->axes + (choice->is_gridded ? 1 : 0);
}
