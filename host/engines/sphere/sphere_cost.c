#include "engines/sphere/sphere_layout.h"

#include "base/round.h"

#include <math.h>

/* In harmonics (0.23 and 0.48 nanoseconds of a core): an order of a point begins; a point comes to
 * the device and is prepared; a block of degrees of a realization ends, lanes are added up and
 * squared; a block of the table is made on the host. Fitted by hand to the CPU time of realizations
 * of 2 to 4096 points at L = 1 to 4096 (bench_choice; 2 cores of an EPYC with AVX2, PoCL 3.1,
 * 2026-11). What one core of the host does while the others wait counts twice. */
static const struct {
    double order, point, block, table;
} costs[2] = {[PS_SINGLE] = {7, 260, 300, 1300}, [PS_DOUBLE] = {9, 110, 130, 400}};

double ps_sphere_harmonics(const ps_sphere_layout *layout, const ps_problem *problem,
                           const ps_device_limits *limits) {
    const double realizations =
        problem->num_realizations > 0 ? (double)problem->num_realizations : 1;
    const size_t orders = (size_t)layout->max_degree + 1;
    const double blocks = (double)ps_sphere_all_blocks(layout->max_degree, 0, orders, NULL);
    const double points = (double)ps_round_up(problem->num_points, layout->lanes);
    const double items = (double)ps_divide_up(orders, layout->group_orders) * realizations;
    const double tables = layout->num_passes == 1 ? 1 : realizations; /* made for every batch */
    const double sums =
        points * (PS_SPHERE_DEGREES * blocks + costs[layout->precision].order * (double)orders) +
        costs[layout->precision].block * blocks;
    return realizations * (sums * ps_engine_idle_factor(items, limits) +
                           costs[layout->precision].point * (double)problem->num_points) +
           tables * costs[layout->precision].table * blocks;
}
