#include "engines/sphere/sphere_layout.h"

#include <math.h>

/* Errors of S in units of sqrt(sum w^2), by precision: hypot(begin, step L). begin is the rounding
 * of w, azimuth, sin^m(theta) and sums; step that of t = 1 - |cos theta|, which shifts theta and so
 * every degree a little more.
 *  random:   of every point on its own, as white noise has it: measured up to 3.3e-7 and 8.9e-9 L (1.1e-8 L for points at
 *            the equator, where it is largest); 2e-15 and 7.0e-17 L (1.1e-16 L).
 *  coherent: of points at one place, which err alike: measured up to 5.2e-7 and 2.3e-8 L; 1.2e-15 and 1.6e-17 L at two
 *            places, where a place may have several times the mean.
 *  leak:     the constants of the recurrence are rounded, so the sphere as a whole, sqrt(N) of it, shows in every
 *            degree: measured up to 1.9e-9 and 3.4e-17. A set of weights has less of it.
 * Measured, with slack, by tests/engines/sphere/test_sphere_error.c; docs/engines/sphere_direct.md.
 */
typedef struct error_law {
    double random_begin, random_step, coherent_begin, coherent_step, leak;
} error_law;

static const error_law error_laws[2] = {
    [PS_SINGLE] = {4.2e-7, 1.3e-8, 7e-7, 3.5e-8, 3e-9},
    [PS_DOUBLE] = {2.2e-15, 1.5e-16, 1.6e-15, 1.0e-16, 5e-17},
};

/* White noise has a mean power of 1: what is above comes from points that are close together. */
double ps_sphere_error(const ps_problem *problem, ps_precision precision, double mean_power) {
    const error_law *law = &error_laws[precision];
    const double degree = problem->frequencies->max_frequency;
    const double excess = mean_power > 1 ? mean_power - 1 : 0;
    const double random = hypot(law->random_begin, law->random_step * degree);
    const double coherent = hypot(law->coherent_begin, law->coherent_step * degree) * sqrt(excess);
    return hypot(hypot(random, coherent), law->leak * sqrt((double)problem->num_points));
}
