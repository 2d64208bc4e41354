/* The error formula of sphere_nufft and sphere_grid: docs/engines/sphere_nufft.md has the reasons.
 * All errors are in units of the root of sum w^2; constants were measured, and are held, by
 * tests/engines/sphere/test_sphere_nufft_sweep.c. */
#include "engines/nufft/grid_axis.h"
#include "engines/sphere/nufft/shape.h"
#include "math/pi.h"

#include <math.h>

static const double unit_roundoff[2] = {0x1p-24, 0x1p-53};

/* A set that is regular along an axis, circles of n - m points or as many circles, may have all its
 * power where aliases harm most: order 0 (or k = 0) comes back at m and -m. */
static const double in_step = 1;

/* Peaks of lattices, of power N: on a line of aliases, two, of both signs
 * (engines/torus/nufft/error.c). */
static const double peaks = 4;

/* What follows is rounding in units of roundoff: of points and coefficients, whatever the grid; of
 * windows, by cells with that of the table; of each pass of the transforms; of sums in dense cells;
 * of coincident points; of the recurrence of Lambda_lm and of sums over rings, for the root of
 * their number. */
static const double point_roundings = 2;
static const struct {
    double windows;
    double transforms; /* one after another */
} routes[] = {[PS_SPHERE_BY_RINGS] = {.windows = 4, .transforms = 3},
              [PS_SPHERE_BY_CELLS] = {.windows = 3.5, .transforms = 1},
              [PS_SPHERE_ON_GPU] = {.windows = 4, .transforms = 3}};
static const double roundings_per_pass = 0.4;
static const double dense_roundings =
    2; /* 1.4 with a million points: pointspec stress --case sphere-sum-1e6 */
static const double coherent_roundings = 0.3;
static const double ring_roundings = 0.3;

/* Angles are made of vectors in double precision: half a unit in the last place of a number below
 * pi or so, times the order or degree. In single precision next to nothing. */
static const double angle_roundings = 1.5;

/* ---- aliases ----------------------------------------------------------------------------- */

/* Frequencies count by their share in Y_lm, mean over all l <= L and m: order x L by how many
 * degrees it has, 2 (1 - x); frequency x L of theta by 4 / pi sqrt(1 - x^2), since the mean of
 * |Lambda_lm|^2 over m is that of P_l. Both are small at the edge, where aliases are largest. x =
 * sin(t) for a smooth integrand. */
void ps_sphere_nufft_loss(const ps_nufft_axis *axis, double *aliasing, double *worst) {
    enum { STEPS = 24, ALIASES = 8 }; /* with 1 / i in the end, but enough for points on cells */
    const double L = axis->max_frequency;
    double worst_around = 0;
    double worst_along = 0;
    *aliasing = 0;
    for (int i = 0; i < STEPS; i++) {
        const double t = PS_PI / 2 * (i + 0.5) / STEPS;
        const double around = 2 * (1 - sin(t));
        const double along = 4 / PS_PI * cos(t);
        const ps_nufft_aliases aliases =
            ps_nufft_window_aliases(&axis->window, fmin(L, (L + 1) * sin(t)) / axis->n, ALIASES);
        *aliasing += aliases.squares * (around + along) * cos(t) * PS_PI / 2 / STEPS;
        worst_around = fmax(worst_around, around * aliases.in_step);
        worst_along = fmax(worst_along, along * aliases.in_step);
    }
    *worst = worst_around + worst_along;
}

/* Few degrees are less of a mean than many: points at the poles, all of whose aliases are in step,
 * were off by 1.25 times the rest of the formula at L = 3, by no more from L = 9 on. */
static const double few_degrees = 3;

static double aliasing_of(const ps_nufft_axis *axis, const ps_problem *problem, double power) {
    const double modes = pow(2.0 * axis->max_frequency + 1, 2);
    const double points_per_mode = ps_planned_points(problem) / modes;
    return sqrt(
        (axis->loss.aliasing + axis->loss.worst * (in_step * power + peaks * points_per_mode)) *
        (1 + few_degrees / axis->max_frequency));
}

/* Degree 0 is in the values on rings, and in the cells. */
static double power_with_mean(const ps_nufft_axis *axis, const ps_problem *problem, double power) {
    const double degrees = axis->max_frequency + 1.0;
    return power + ps_planned_points(problem) / (degrees * degrees);
}

/* Of white sets, in units of roundoff: 8, 17, 44, 62, 92 and 168 at L = 30, 100, 250, 500, 1000 and
 * 2000 (orders_sum_one.cl with STATE_PRECISION 32, Zen 4). Rounding of a bracket wanders, and is
 * much the same from degree to degree where l is far above m. */
double ps_sphere_chain_error(const ps_nufft_axis *axis, const ps_problem *problem,
                             double mean_power) {
    const double wandering = 4, steady = 0.04;
    const double L = axis->max_frequency;
    const double power = mean_power > 1 ? mean_power : 1;
    return unit_roundoff[PS_SINGLE] * (wandering * sqrt(L) + steady * L) *
           sqrt(power_with_mean(axis, problem, power));
}

/* ---- all --------------------------------------------------------------------------------- */

double ps_sphere_nufft_error(const ps_nufft_axis *axis, const ps_problem *problem,
                             ps_precision precision, double mean_power, ps_sphere_route route) {
    const double grid_roundings =
        routes[route].windows + routes[route].transforms * axis->passes * roundings_per_pass;
    const double power = mean_power > 1 ? mean_power : 1;
    const double unit = unit_roundoff[precision];
    const double L = axis->max_frequency;
    const double points = ps_planned_points(problem);
    const double with_mean = power_with_mean(axis, problem, power);
    const double cells = (double)axis->n * axis->n / 2;
    const double touching = points * pow(axis->window.width, 2) / cells;
    const double polynomials = PS_NUFFT_POLYNOMIAL_SHARE * problem->tolerance * sqrt(2 * power);
    const double each = hypot(grid_roundings, dense_roundings * sqrt(touching));
    const double amplification = axis->loss.amplification * axis->loss.amplification;
    const double rounding = unit * amplification * each * sqrt(with_mean);
    const double rings = unit * ring_roundings * sqrt(L * with_mean);
    const double coherent = unit * coherent_roundings * power * sqrt(power);
    const double angles = unit_roundoff[PS_DOUBLE] * angle_roundings * L;
    const double given = hypot(unit * point_roundings, angles) * sqrt(power);
    return hypot(hypot(aliasing_of(axis, problem, power), polynomials),
                 hypot(hypot(rounding, rings), given)) +
           coherent;
}
