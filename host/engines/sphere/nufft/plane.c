/* The grid of sphere_nufft on GPUs, as torus_nufft treats it: its axes and sizes. */
#include "engines/nufft/cycles.h"
#include "engines/sphere/nufft/shape.h"
#include "engines/torus/nufft/variant.h"

/* Sets of more points come in chunks, each of which reads and writes the cells once more: a point
 * takes 48 bytes of vectors, and 60 of places. */
enum { MOST_POINTS = PS_NUFFT_MOST_CHUNK_POINTS };

static bool is_cut(const ps_problem *problem) {
    return ps_planned_points(problem) > MOST_POINTS;
}

ps_nufft_choice ps_sphere_plane_choice(const ps_nufft_axis *axis, const ps_problem *problem,
                                       ps_precision precision) {
    ps_nufft_choice choice = {.variant = is_cut(problem) ? &ps_nufft_grid_chunks : &ps_nufft_grid,
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
    plane.num_points =
        is_cut(problem) && problem->num_points > MOST_POINTS ? MOST_POINTS : problem->num_points;
    return ps_nufft_layout_of(&choice, &plane, limits, precision);
}
