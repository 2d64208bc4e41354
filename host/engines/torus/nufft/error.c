/* The error formula of torus_nufft: docs/engines/torus_nufft.md has the reasons. All errors are in
 * units of the root of sum w^2; constants were measured, and are held, by
 * tests/engines/torus/test_tolerance_sweep.c and tests/engines/torus/test_tolerance_regular.c. */
#include "engines/torus/nufft/choice.h"

#include "engines/nufft/grid_axis.h"
#include "engines/torus/nufft/variant.h"

#include <math.h>

static const double unit_roundoff[2] = {0x1p-24, 0x1p-53};

/* A set that is regular along an axis may have all its power at the frequency that aliases harm
 * most, at K and at -K. */
static const double in_step = 2;

/* What follows is rounding in units of roundoff: of points and powers, whatever the grid; of
 * windows and phases, of each pass of the transforms on both axes, of sums in dense cells (root of
 * the number of terms; where axis 0 has frequency 0, terms are in step and it is the number of
 * points in a cell that counts, and columns of equal terms round the same way every time), of
 * lattices in space, of coincident points. */
static const double point_roundings = 2;
static const double window_roundings = 7;
static const double roundings_per_pass = 1;
static const double dense_roundings = 1;
static const double dense_roundings_at_zero = 2;
static const double column_roundings = 0.3;
static const double grid_roundings_at_zero = 0.08;
static const double lattice_roundings = 0.28;
static const double coherent_roundings = 0.45;

double ps_nufft_modes(const ps_problem *problem) {
    return pow(2.0 * problem->frequencies->max_frequency + 1, problem->frequencies->dimension);
}

/* What all axes lose together. */
typedef struct whole_loss {
    double aliasing, worst, amplification, edge, passes;
    double density;  /* points in a cell, */
    double touching; /* those whose windows touch it, */
    double dense;    /* and the root of their product: what they add up to */
    double widths;
    double chunks; /* whose roundings may be in step */
} whole_loss;

static whole_loss add_axes(const ps_nufft_choice *choice, uint64_t num_points) {
    const bool has_chunks = choice->chunk > 0 && choice->chunk < num_points;
    const double at_once = fmax(1, (double)(has_chunks ? choice->chunk : num_points));
    whole_loss sum = {.amplification = 1,
                      .edge = 1,
                      .density = at_once,
                      .touching = at_once,
                      .widths = 1,
                      .chunks = (double)num_points / at_once};
    for (unsigned i = 0; i < choice->num_axes; i++) {
        const ps_nufft_axis *axis = &choice->axes[i];
        sum.aliasing += axis->loss.aliasing;
        sum.worst += axis->loss.worst;
        sum.amplification *= axis->loss.amplification;
        sum.edge *= axis->loss.edge;
        sum.passes += axis->passes * roundings_per_pass;
        sum.density /= axis->n;
        sum.touching *= (double)axis->window.width / axis->n;
        sum.widths *= axis->window.width;
    }
    sum.passes += choice->num_axes == 1 ? choice->variant->turning_roundings : 0;
    sum.dense = sqrt(sum.density * sum.touching);
    return sum;
}

/* Peaks of lattices, of power N, come in pairs: 2^(d-1) of them fit on a line of aliases, more than
 * K from each other, so that none is in the band; in one dimension one at each end of the band. */
static double aliasing_of(const ps_nufft_choice *choice, const ps_problem *problem,
                          const whole_loss *loss, double power) {
    const double peaks = choice->stride != 0 ? 4 : pow(2, problem->frequencies->dimension);
    const double points_per_mode = ps_planned_points(problem) / ps_nufft_modes(problem);
    return sqrt(loss->aliasing + loss->worst * (in_step * power + peaks * points_per_mode));
}

/* Plain sums of large sets in space: lattices that are finer than K round the same way in every
 * period of lattice and grid, and do so at frequencies up to K; their points may lie together, as
 * many as there are for a mode. */
static bool has_lattices(const ps_nufft_choice *choice) {
    return choice->variant->has_lattices && choice->num_axes == 3 && choice->chunk == 0;
}

static double rounding_of_lattices(const ps_problem *problem, const whole_loss *loss) {
    const double points_per_mode = (double)problem->num_points / ps_nufft_modes(problem);
    return lattice_roundings * loss->edge *
           sqrt(loss->touching * points_per_mode * (1 + points_per_mode));
}

/* Rounding at frequency 0, where terms are in step, counts in units of roundoff. */
static double rounding_at_zero(const ps_nufft_choice *choice, const whole_loss *loss) {
    const double columns = choice->stride == 0 ? column_roundings * loss->touching : 0;
    return choice->variant->is_gridded
               ? grid_roundings_at_zero * loss->touching * sqrt(loss->widths * loss->chunks)
               : hypot(dense_roundings_at_zero * loss->dense, columns * sqrt(loss->density)) /
                     sqrt(choice->span);
}

double ps_nufft_error(const ps_nufft_choice *choice, const ps_problem *problem,
                      ps_precision precision, double mean_power) {
    const double power = mean_power > 1 ? mean_power : 1;
    const double unit = unit_roundoff[precision];
    const whole_loss loss = add_axes(choice, problem->num_points);
    const double aliasing = aliasing_of(choice, problem, &loss, power);
    const double polynomials =
        PS_NUFFT_POLYNOMIAL_SHARE * problem->tolerance * sqrt(choice->num_axes * power);
    const double each =
        hypot(window_roundings + loss.passes, dense_roundings * sqrt(loss.touching));
    const double lattices = has_lattices(choice)
                                ? rounding_of_lattices(problem, &loss)
                                : loss.amplification * rounding_at_zero(choice, &loss);
    const double rounding = unit * hypot(loss.amplification * each * sqrt(power), lattices);
    const double coherent =
        unit * coherent_roundings * fmax(1, loss.amplification) * power * sqrt(power);
    const double given = unit * point_roundings * sqrt(power);
    return hypot(hypot(aliasing, polynomials), hypot(rounding, given)) + coherent;
}

double ps_nufft_error_of_axis(const ps_nufft_choice *whole, const ps_nufft_axis *axis,
                              const ps_problem *problem, ps_precision precision,
                              double mean_power) {
    const ps_nufft_variant variant = {
        .turning_roundings = whole->num_axes == 1 ? whole->variant->turning_roundings : 0};
    const ps_nufft_choice alone = {.variant = &variant,
                                   .num_axes = 1,
                                   .span = whole->span,
                                   .stride = whole->stride,
                                   .axes = {*axis}};
    return ps_nufft_error(&alone, problem, precision, mean_power);
}
