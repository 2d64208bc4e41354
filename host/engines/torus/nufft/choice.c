#include "engines/torus/nufft/choice.h"

#include "engines/torus/nufft/variant.h"

ps_nufft_choice ps_nufft_choice_of_axes(const ps_problem *problem, unsigned first) {
    const int32_t max_frequency = problem->frequencies->max_frequency;
    ps_nufft_choice choice = {.num_axes = problem->frequencies->dimension - first,
                              .span = (uint32_t)max_frequency + 1};
    for (unsigned i = 0; i < choice.num_axes; i++) {
        choice.axes[i] =
            (ps_nufft_axis){.axis = i + first, .factor = 1, .max_frequency = max_frequency};
    }
    return choice;
}

uint32_t ps_nufft_tiled(const ps_nufft_choice *choice) {
    return choice->span - (choice->has_line ? 1 : 0);
}

uint32_t ps_nufft_base(const ps_nufft_choice *choice) {
    return choice->has_line ? 1 : choice->stride * (uint32_t)choice->axes[0].max_frequency;
}

const ps_nufft_axis *ps_nufft_last_axes(const ps_nufft_choice *choice, unsigned *num) {
    *num = choice->num_axes - (choice->variant->is_gridded ? 1 : 0);
    return choice->axes + (choice->variant->is_gridded ? 1 : 0);
}
