/* The error formula of sphere_nufft: docs/sphere_nufft.md has the reasons. */
#include "engines/sphere_nufft_shape.h"

#include <math.h>

double ps_sphere_nufft_error(const ps_nufft_axis *axis, const ps_problem *problem,
                             ps_precision precision, double mean_power) {
    const ps_frequencies box = {
        .kind = PS_FREQUENCIES_BOX, .dimension = 2, .max_frequency = axis->max_frequency};
    ps_problem torus = *problem;
    torus.frequencies = &box;
    const ps_nufft_choice choice = {.num_axes = 2,
                                    .span = (uint32_t)axis->max_frequency + 1,
                                    .is_gridded = true,
                                    .is_whole = true,
                                    .axes = {*axis, *axis}};
    return ps_nufft_error(&choice, &torus, precision, mean_power);
}
