#include "engines/torus/torus_layout.h"

#include "math/pi.h"
#include "torus/product.h"

#include <math.h>

/* Errors of S in units of sqrt(sum w^2). Cosines and sines round independently from point to point,
 * and runs of L = PS_TORUS_RUN terms in a far-apart order (torus_points.h) like sums of white
 * noise: together random_error, measured up to 1.8e-7 and 3e-16. Terms that are all equal
 * (coincident points, lattices at their peaks) round the same way and add up to L u / 4 of S itself
 * (u = 2^-24, 2^-53): coherent_error. Measured, with slack, in
 * tests/engines/torus/test_tolerance.c; docs/engines/torus_direct.md. */
static const double random_error[2] = {2.2e-7, 4.0e-16};
static const double coherent_error[2] = {4.8e-7, 9.0e-16};

/* u, and what matrix units add to both, in u (docs/engines/torus_direct.md, Matrix units): a factor
 * leaves u / 2 out, a product of lower parts u / 3; what a step of 16 points cuts off, 2 at most,
 * is of the sign of its sum; a run adds 8 steps, in double precision 128 points, to L u / 4; so
 * do second sums, of which there are many. */
static const double unit_roundoff[2] = {0x1p-24, 0x1p-53};
static const double random_of_units[2] = {2.0, 4.0};
static const double cut_of_units[2] = {2.0, 0};
static const double run_of_units[2] = {UNIT_RUN / 16 / 4.0, UNIT_RUN / 4.0};

/* How many times the cuts of the model (kernels/torus/units.h) those of a card may be: an H200 had
 * errors of powers up to 4e-6 where the model has 2.1e-6, (2, 4096, 256), 2026-11-28. */
static const double slack_of_cuts = 2;

double ps_torus_error(const ps_frequencies *frequencies, ps_precision precision, bool by_units,
                      double num_points, double mean_power) {
    /* Fixed-point phases: 2 + (2 + d) 2^-24 sum |k| units of 2^-32 turns (float, torus/phase.h),
     * 2^-65 |k| turns (coordinates below 2^-11). Uniform errors: standard deviation 1/sqrt(12) of a
     * unit. */
    const double dimension = frequencies->dimension;
    const double sum_k = frequencies->max_frequency * dimension;
    const double phase = precision == PS_SINGLE
                             ? PS_TWO_PI * (2 + (2 + dimension) * ldexp(sum_k, -24)) * ldexp(1, -32)
                             : PS_TWO_PI * ldexp(sum_k, -65);
    const double uniform = sqrt(12.0);
    const double u = unit_roundoff[precision];
    const double runs = ceil(num_points / UNIT_RUN);
    const double random = by_units ? hypot(random_error[precision], u * random_of_units[precision])
                                   : random_error[precision];
    const double coherent =
        by_units
            ? u * (slack_of_cuts * cut_of_units[precision] + run_of_units[precision] + runs / 4)
            : coherent_error[precision];
    const double in_step = (coherent + phase / uniform) * sqrt(mean_power);
    return hypot(hypot(random, phase / uniform), in_step);
}
