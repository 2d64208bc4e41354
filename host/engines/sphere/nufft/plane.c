/* The grid of sphere_nufft on GPUs, as torus_nufft treats it: its axes and sizes. */
#include "engines/nufft/cycles.h"
#include "engines/sphere/nufft/shape.h"
#include "engines/torus/nufft/variant.h"

/* Points on the device at a time; sets of more come in chunks, each of which reads and writes the
 * cells once more: 48 bytes of vectors, and 60 of places. */
enum { MOST_POINTS = 1 << 21 };

ps_nufft_choice ps_sphere_plane_choice(const ps_nufft_axis *axis, const ps_problem *problem,
                                       ps_precision precision) {
    const bool is_cut = problem->num_points > MOST_POINTS;
    ps_nufft_choice choice = {.variant = is_cut ? &ps_nufft_grid_chunks : &ps_nufft_grid,
                              .lanes = ps_nufft_nominal_lanes(precision),
                              .num_axes = 2,
                              .keeps_sums = true,
                              .axes = {*axis, *axis}};
    choice.axes[1].axis = 1;
    choice.variant->complete(&choice, problem, precision, 0);
    return choice;
}

ps_nufft_layout ps_sphere_plane_layout(const ps_sphere_shape *shape, const ps_problem *problem,
                                       const ps_device_limits *limits, ps_precision precision,
                                       size_t num_sets) {
    static const ps_frequencies plane_frequencies = {.dimension = 2};
    const ps_nufft_choice choice = ps_sphere_plane_choice(&shape->axis, problem, precision);
    ps_problem plane = *problem;
    plane.frequencies = &plane_frequencies;
    plane.planned_points = (uint64_t)ps_planned_points(problem);
    plane.num_realizations = num_sets;
    plane.num_points = problem->num_points < MOST_POINTS ? problem->num_points : MOST_POINTS;
    return ps_nufft_layout_of(&choice, &plane, limits, precision);
}
