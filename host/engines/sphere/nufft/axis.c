/* Which fine grid, window and rings sphere_nufft and sphere_grid take: the cheapest that keep the
 * tolerance. */
#include "base/round.h"
#include "engines/nufft/fft.h"
#include "engines/nufft/grid_axis.h"
#include "engines/sphere/nufft/shape.h"

#include <math.h>

/* Fine grids from sigma = n / 2L on, as in engines/torus/nufft/choose.c. */
static const double least_sigma = 1.2;
static const double largest_sigma = 4;

/* Windows in front of a pole and behind it must not meet. */
enum { LEAST_CELLS = 4 * PS_NUFFT_MAX_WIDTH };

/* A grid of all cells has 32-bit indices, and on GPUs their number, too, has 32 bits. */
enum { MOST_CELLS = 1 << 16 };

/* Each candidate is longer than the one before by this part at least. */
enum { NEXT_LENGTH = 32 };

/* By rings, and on GPUs, the cheapest to transform; by cells any, since transforms are the smaller
 * part. Cells are a multiple of a unit: even, on GPUs whole boxes. */
static const struct {
    uint32_t (*length)(uint64_t least);
    uint32_t unit, most;
} lengths[] = {[PS_SPHERE_BY_RINGS] = {ps_fft_good_length, 2, MOST_CELLS},
               [PS_SPHERE_BY_CELLS] = {ps_fft_length, 2, MOST_CELLS},
               [PS_SPHERE_ON_GPU] = {ps_fft_good_length, 32, MOST_CELLS - 1}};

/* A length from `least` on; 0: beyond 32 bits. */
static uint32_t next_length(uint64_t least, ps_sphere_route route) {
    const uint32_t unit = lengths[route].unit;
    return unit * lengths[route].length(ps_divide_up(least, unit));
}

/* A few more than the least where the two transforms of half the length are cheaper by more than
 * products take. */
uint32_t ps_sphere_ring_length(int32_t max_degree) {
    const double cycles_of_products =
        0.44; /* for a degree and a ring, where transforms have one order */
    const uint64_t least = (uint64_t)max_degree + 1;
    uint32_t best = 0;
    double best_cycles = HUGE_VAL;
    for (uint32_t half = ps_fft_length(least); half != 0 && half <= least + least / 8;
         half = ps_fft_length((uint64_t)half + 1)) {
        const double cycles = ps_fft_cycles(half) + cycles_of_products * max_degree * half;
        if (cycles < best_cycles) {
            best = half;
            best_cycles = cycles;
        }
    }
    return 2 * best;
}

static ps_nufft_axis make_axis(int32_t max_degree, uint32_t n, unsigned width) {
    ps_nufft_axis axis = {.factor = 1, .max_frequency = max_degree, .n = n};
    axis.window = ps_nufft_window_make(width, max_degree, n);
    axis.loss.amplification = ps_nufft_window_amplification(&axis.window, max_degree, n);
    ps_sphere_nufft_loss(&axis, &axis.loss.aliasing, &axis.loss.worst);
    axis.passes = ps_fft_passes(n / 2) + 1; /* the halves meet */
    return axis;
}

/* Returns the width to begin with: aliases fall about as exp(-pi w sqrt(1 - 1 / sigma)). */
static unsigned hopeful_width(const ps_problem *problem, uint32_t n) {
    const double margin =
        3; /* wider than needed would cost; narrower ones are tried if nothing else will do */
    const double share = 2.0 * problem->frequencies->max_frequency / n;
    const double width = -log(problem->tolerance) / (3.14 * sqrt(1 - share)) - margin;
    return width > PS_NUFFT_MAX_WIDTH   ? PS_NUFFT_MAX_WIDTH
           : width > PS_NUFFT_MIN_WIDTH ? (unsigned)width
                                        : PS_NUFFT_MIN_WIDTH;
}

/* Tries the widths first .. last of a length: the narrowest window that keeps the tolerance, else
 * the most exact one, becomes the best if it is more exact than that. */
static void try_widths(ps_nufft_axis *best, const ps_problem *problem, uint32_t n,
                       ps_precision precision, ps_sphere_route route, unsigned first, unsigned last,
                       double *least_error) {
    for (unsigned width = first; width <= last && *least_error > problem->tolerance; width++) {
        const ps_nufft_axis axis = make_axis(problem->frequencies->max_frequency, n, width);
        const double error =
            ps_sphere_nufft_error(&axis, problem, precision, ps_expected_power(problem), route);
        if (error < *least_error) {
            *best = axis;
            *least_error = error;
        }
    }
}

static ps_nufft_axis choose_width(const ps_problem *problem, uint32_t n, ps_precision precision,
                                  ps_sphere_route route, double *least_error) {
    const unsigned first = hopeful_width(problem, n);
    ps_nufft_axis best = {0};
    *least_error = HUGE_VAL;
    try_widths(&best, problem, n, precision, route, first, PS_NUFFT_MAX_WIDTH, least_error);
    try_widths(&best, problem, n, precision, route, PS_NUFFT_MIN_WIDTH, first - 1, least_error);
    return best;
}

ps_nufft_axis ps_sphere_choose_axis(const ps_problem *problem, ps_precision precision,
                                    ps_sphere_route route) {
    const double twice = 2.0 * problem->frequencies->max_frequency;
    const uint64_t last = (uint64_t)fmax(LEAST_CELLS, largest_sigma * twice);
    ps_nufft_axis best = {0};
    double best_error = HUGE_VAL;
    double best_cycles = HUGE_VAL;
    for (uint32_t n =
             next_length((uint64_t)fmax(LEAST_CELLS, ceil(least_sigma * twice + 1)), route);
         n != 0 && n <= lengths[route].most && (best.n == 0 || n <= last);
         n = next_length((uint64_t)n + 1 + n / NEXT_LENGTH, route)) {
        double error = 0;
        const ps_nufft_axis least = {.max_frequency = problem->frequencies->max_frequency,
                                     .n = n,
                                     .window = {.width = hopeful_width(problem, n)}};
        if (best_error <= problem->tolerance &&
            ps_sphere_grid_cycles(&least, problem, precision, route) >= best_cycles) {
            continue;
        }
        const ps_nufft_axis axis = choose_width(problem, n, precision, route, &error);
        const double cycles = ps_sphere_grid_cycles(&axis, problem, precision, route);
        const bool is_enough = error <= problem->tolerance;
        const bool was_enough = best_error <= problem->tolerance;
        if (best.n == 0 ||
            (was_enough ? is_enough && cycles < best_cycles : is_enough || error < best_error)) {
            best = axis;
            best_error = error;
            best_cycles = cycles;
        }
    }
    return best;
}
