/* What sphere_nufft and sphere_grid cost: the planner compares, and grids are chosen by it. */
#include "engines/nufft/cycles.h"
#include "engines/nufft/fft.h"
#include "engines/nufft/grid_axis.h"
#include "engines/sphere/nufft/shape.h"

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

/* ---- all --------------------------------------------------------------------------------- */

static const struct {
    double (*grid)(const ps_nufft_axis *, double lanes);
    double (*more)(const ps_sphere_shape *, double lanes, double num_points,
                   double num_realizations);
} routes[] = {[PS_SPHERE_BY_RINGS] = {ring_cycles, more_ring_cycles},
              [PS_SPHERE_BY_CELLS] = {cell_cycles, no_more_cycles}};

double ps_sphere_grid_cycles(const ps_nufft_axis *axis, ps_precision precision, double num_points,
                             ps_sphere_route route) {
    const double lanes = ps_nufft_nominal_lanes(precision);
    return spreading_cycles(axis, lanes, num_points) + routes[route].grid(axis, lanes);
}

/* Cycles, by CPU time of the kernels on a machine that others used (Zen 5, PoCL 3.1, 2026-11): 0.7
 * to 1.2 times what it says, of white sets from N = 256, L = 64 to N = 1e6, L = 1000 and 4096,
 * 2000, alone and in batches, at 1e-3, 1e-5 and 1e-12. The same of a GPU, by the time of all
 * kernels on an H200: 135 to 230 ps for a degree and order at an angle of each of 32 to 64 sets by
 * cells ((1024, 64), (1024, 128), (4096, 256)), which took 1 to 2 % of the card, so that batches of
 * hundreds, which were not measured, are taken to last as long; and 63 ms for the one set of (1e6,
 * 1000) by rings without its sort. Double precision was measured once, at less than single; a
 * fourth more is an estimate. */
static double gpu_cycles(const ps_sphere_shape *shape, ps_precision precision, double num_points,
                         double num_realizations) {
    const double cycles_of_cell = 178, cycles_of_ring = 260, cycles_per_sorted = 15.7e3;
    const double share = 0.7; /* of angles or rings where Lambda_lm is more than zero */
    const double measured_sets = 48;
    const double sets = fmin(num_realizations, (double)shape->at_once);
    const double dearer = precision == PS_DOUBLE ? 1.25 : 1;
    const bool is_by_rings = shape->route == PS_SPHERE_BY_RINGS;
    const double L = shape->max_degree;
    const double angles = is_by_rings ? shape->num_rings : shape->axis.n / 4.0;
    const double numbers = (L + 1) * L / 2 * angles * share;
    const double points = shape->is_sorted ? cycles_per_sorted * num_points : 0;
    return dearer * (is_by_rings ? numbers * cycles_of_ring + points
                                 : numbers * cycles_of_cell * measured_sets / fmax(sets, 1));
}

double ps_sphere_nufft_flops(const ps_sphere_shape *shape, ps_precision precision,
                             double num_points, double num_realizations) {
    const double flops_per_lane = 4; /* two fused operations in a cycle */
    const double lanes = ps_nufft_nominal_lanes(precision);
    const double cycles =
        shape->is_gpu ? gpu_cycles(shape, precision, num_points, num_realizations)
                      : ps_sphere_grid_cycles(&shape->axis, precision, num_points, shape->route) +
                            routes[shape->route].more(shape, lanes, num_points, num_realizations);
    return cycles * lanes * flops_per_lane;
}
