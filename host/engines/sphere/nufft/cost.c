/* What sphere_nufft and sphere_grid cost: the planner compares, and grids are chosen by it. */
#include "engines/nufft/cycles.h"
#include "engines/nufft/fft.h"
#include "engines/nufft/grid_axis.h"
#include "engines/sphere/nufft/shape.h"
#include "engines/torus/nufft/cost.h"

#include <math.h>

/* ---- what depends on the grid ------------------------------------------------------------ */

/* Cycles on a core (Zen 5, PoCL 3.1, 2026-11, steps of the kernels left out in turn, N = 1024 L =
 * 128 and N = 4096 L = 256; by cells 0.9 to 1.3 times that of batches of L = 64, 128 and 256 at
 * 1e-5 and 1e-12); spreading as in engines/torus/nufft/whole/, and two arc tangents. */
static const double cycles_per_cell = 3; /* of a vector: cleared, fetched */

static double spreading_cycles(const ps_nufft_axis *axis, double lanes, double num_points) {
    const double cycles_per_point = 16;
    const double cycles_per_row = 2.4;
    const double cycles_per_polynomial = 0.6;
    const double width = axis->window.width;
    const double bins = ps_nufft_bins(axis);
    return num_points * (cycles_per_point + cycles_per_polynomial * 2 * (width + 2) * bins / lanes +
                         cycles_per_row * width * ceil(bins / lanes));
}

/* Transforms around the axis and along theta. */
static double ring_cycles(const ps_nufft_axis *axis, double lanes) {
    const double cycles_per_turned = 14; /* of a vector of cells, into tiles of two parities */
    const double cycles_per_meridian_cell =
        20; /* fetched from two tiles, taken to the other transform */
    const double n = axis->n;
    const double halves = ps_fft_cycles(axis->n / 2);
    const double groups = ceil((n / 2 + axis->window.width + 1) / lanes);
    const double pairs = floor(axis->max_frequency / (2 * lanes)) + 1;
    return groups * (halves + cycles_per_cell * n + pairs * 2 * lanes * cycles_per_turned) +
           pairs * (2 * halves + cycles_per_meridian_cell * n);
}

/* Transforms around the axis and products with the table, towards the poles only for low orders. */
static double cell_cycles(const ps_nufft_axis *axis, double lanes) {
    const double cycles_per_value = 10;    /* of a vector of angles, from the transform to memory */
    const double cycles_per_product = 1.4; /* of a vector of degrees and an angle: two */
    const double cycles_per_order = 150;   /* whatever the degrees */
    const double cycles_per_set = 8000;    /* whatever its size: to the device and back */
    const double share = 0.7;              /* of angles where an order counts */
    const double n = axis->n;
    const double L = axis->max_frequency;
    const double groups = 2 * ceil(n / 4 / lanes);
    const double products = (L + 1) * (L / 2 + lanes) / lanes * n / 4 * share;
    return groups * (ps_fft_cycles(axis->n / 2) + cycles_per_cell * n + cycles_per_value * L) +
           products * cycles_per_product + cycles_per_order * (L + 1) + cycles_per_set;
}

/* ---- what does not ----------------------------------------------------------------------- */

/* Rings, and products with Lambda_lm. */
static double more_ring_cycles(const ps_sphere_shape *shape, double lanes, double num_points,
                               double num_realizations) {
    const double cycles_of_table = 0.33; /* of a number of Lambda_lm, made in double precision */
    const double cycles_of_coefficients = 16; /* of a degree and an order */
    const double cycles_of_product = 1.6;     /* of a vector of it and one realization */
    /* of a number and one realization without a table: 0.5 on a Zen 4, whose vectors take twice the
     * cycles (2026-11, N = 4096, L = 2000) */
    const double cycles_of_one = shape->is_single_chain ? 0.15 : 0.25;
    const double cycles_per_ring =
        12; /* of a value on a circle, on its way to rings of both hemispheres */
    const double cycles_per_order = 250; /* whatever the degrees */
    const double cycles_per_sorted = 20; /* point */
    const double share = 0.7;            /* of rings where Lambda_lm is more than zero */
    const double L = shape->max_degree;
    const double vectors = (L + 1) * (L / 2 + lanes) / lanes * shape->num_rings * share;
    const double sharing = fmax(1, fmin(num_realizations, (double)shape->at_once));
    const double rings = shape->pairs * (double)shape->lanes / lanes *
                         (2 * ps_fft_cycles(shape->rings / 2) + cycles_per_ring * shape->rings);
    const double sums = shape->is_one_set ? cycles_of_one * lanes
                                          : cycles_of_table * lanes / sharing + cycles_of_product;
    return rings + vectors * sums + cycles_of_coefficients * (L + 1) * L / 2 / sharing +
           cycles_per_order * (L + 1) + (shape->is_sorted ? cycles_per_sorted * num_points : 0);
}

static double no_more_cycles(const ps_sphere_shape *shape, double lanes, double num_points,
                             double num_realizations) {
    (void)shape, (void)lanes, (void)num_points, (void)num_realizations;
    return 0;
}

/* ---- on GPUs ----------------------------------------------------------------------------- */

/* Behind the grid, in nominal cycles of a picosecond (engines/nufft/cycles.c), of a device with an
 * H200's bandwidth and peaks: transforms to rings as those of the grid; numbers of sums, values and
 * coefficients written once and read once. A
 * product of sums is four operations, a step of the recurrence six in double precision, both at a
 * third of the peak, as plain sums of the torus were measured; prototypes with matrix units did
 * half of it. Counted, not measured. */
static double gpu_ring_cycles(const ps_sphere_shape *shape, double lanes, double num_points,
                              double num_realizations) {
    const double cycles_of_product = 0.2, cycles_of_step = 0.6,
                 share = 0.8; /* of rings with more than zeros */
    const double word = ps_nufft_cycles[PS_NUFFT_GPU_WORD];
    const double single_lanes = ps_nufft_nominal_lanes(PS_SINGLE);
    const double factor = single_lanes / lanes; /* words of a number */
    const double L = shape->max_degree, orders = L + 1;
    const double degrees = orders * (L + 2) / 2; /* and orders */
    const double numbers = degrees * shape->num_rings * share;
    const double sums = 2 * orders * (2 * L + 1), values = 4 * orders * shape->num_rings;
    const double sets = fmax(1, fmin(num_realizations, shape->degrees.sets));
    (void)num_points;
    return 2 * orders * ps_fft_flops(shape->rings / 2) * ps_nufft_cycles[PS_NUFFT_GPU_OPERATION] *
               factor +
           (sums + 2 * values + 2 * 2 * degrees) * word * factor +
           numbers * (cycles_of_product * factor + cycles_of_step / sets);
}

/* ---- all --------------------------------------------------------------------------------- */

static const struct {
    double (*grid)(const ps_nufft_axis *, double lanes);
    double (*more)(const ps_sphere_shape *, double lanes, double num_points,
                   double num_realizations);
} routes[] = {[PS_SPHERE_BY_RINGS] = {ring_cycles, more_ring_cycles},
              [PS_SPHERE_BY_CELLS] = {cell_cycles, no_more_cycles},
              [PS_SPHERE_ON_GPU] = {NULL, gpu_ring_cycles}};

double ps_sphere_grid_cycles(const ps_nufft_axis *axis, const ps_problem *problem,
                             ps_precision precision, ps_sphere_route route) {
    const double lanes = ps_nufft_nominal_lanes(precision);
    const double num_points = ps_planned_points(problem);
    if (route == PS_SPHERE_ON_GPU) {
        const ps_nufft_choice choice = ps_sphere_plane_choice(axis, problem, precision);
        const ps_nufft_counts counts = ps_nufft_count(&choice, precision, num_points);
        return ps_nufft_cycles_of(&counts);
    }
    return spreading_cycles(axis, lanes, num_points) + routes[route].grid(axis, lanes);
}

/* Cycles, by CPU time of the kernels on a machine that others used (Zen 5, PoCL 3.1, 2026-11): 0.7
 * to 1.2 times what it says, of white sets from N = 256, L = 64 to N = 1e6, L = 1000 and 4096,
 * 2000, alone and in batches, at 1e-3, 1e-5 and 1e-12. */
double ps_sphere_nufft_flops(const ps_sphere_shape *shape, const ps_problem *problem,
                             ps_precision precision, double num_realizations) {
    const double flops_per_lane = 4; /* two fused operations in a cycle */
    const double lanes = ps_nufft_nominal_lanes(precision);
    const double num_points = ps_planned_points(problem);
    const double cycles = routes[shape->route].more(shape, lanes, num_points, num_realizations);
    const double grid =
        shape->route == PS_SPHERE_ON_GPU /* with what idles where boxes are few */
            ? ps_nufft_flops_of_layout(&shape->plane, precision, num_points)
            : ps_sphere_grid_cycles(&shape->axis, problem, precision, shape->route) * lanes *
                  flops_per_lane;
    return grid + cycles * lanes * flops_per_lane;
}
