#include "engines/torus/nufft/layout.h"

#include "device/reals.h"
#include "engines/torus/nufft/choice.h"
#include "engines/torus/nufft/variant.h"

ps_nufft_layout ps_nufft_layout_of(const ps_nufft_choice *choice, const ps_problem *problem,
                                   const ps_device_limits *limits, ps_precision precision) {
    ps_nufft_layout layout = {.choice = *choice,
                              .lanes = ps_engine_lanes(limits, precision),
                              .real_bytes = ps_real_bytes(precision)};
    if (layout.choice.num_axes == 0) {
        layout.lanes = 0;
    } else {
        layout.choice.variant->measure(&layout, problem, limits);
    }
    return layout;
}

ps_nufft_layout ps_nufft_layout_make(const ps_problem *problem, const ps_device_limits *limits,
                                     ps_precision precision) {
    const ps_nufft_choice choice = ps_nufft_choose(problem, limits, precision);
    return ps_nufft_layout_of(&choice, problem, limits, precision);
}

void ps_nufft_layout_shrink(ps_nufft_layout *layout, size_t batch) {
    if (layout->choice.variant->launcher->spread == NULL) {
        layout->parts = layout->parts < batch ? layout->parts : batch;
        layout->groups = layout->groups < batch ? layout->groups : batch;
    }
}
