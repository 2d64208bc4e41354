#include "engines/torus/nufft/layout.h"

#include "device/reals.h"
#include "engines/torus/nufft/choose.h"
#include "engines/torus/nufft/variant.h"

ps_nufft_layout ps_nufft_layout_make(const ps_problem *problem, const ps_device_limits *limits,
                                     ps_precision precision) {
    ps_nufft_layout layout = {.choice = ps_nufft_choose(problem, limits, precision),
                              .lanes = ps_engine_lanes(limits, precision),
                              .real_bytes = ps_real_bytes(precision)};
    if (layout.choice.num_axes == 0) {
        layout.lanes = 0;
    } else {
        layout.choice.variant->measure(&layout, problem, limits);
    }
    return layout;
}

void ps_nufft_layout_shrink(ps_nufft_layout *layout, size_t batch) {
    if (layout->choice.variant->launcher->add == NULL) {
        layout->parts = layout->parts < batch ? layout->parts : batch;
        layout->groups = layout->groups < batch ? layout->groups : batch;
    }
}
