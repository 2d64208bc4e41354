#include "engines/nufft_choice.h"

#include "engines/nufft_fft.h"

#include <math.h>
#include <string.h>

/* Fine grids from sigma = n / 2K on. Below 1.2 windows become wider than 16, above 4 they hardly shrink. */
static const double least_sigma = 1.2;
static const double largest_sigma = 4;

/* Windows must not meet themselves. */
enum { LEAST_CELLS = PS_NUFFT_MAX_WIDTH };

/* In one dimension, where more tiles mean shorter transforms. */
enum { MOST_TILES = 64 };

/* Lengths between the two sigmas. */
enum { MAX_CANDIDATES = 64 };

/* Lanes to choose for, whatever the device has. */
static const unsigned nominal_lanes[2] = {16, 8};

/* Least mean power to choose for: realizations of white noise vary by that much. */
static const double nominal_power = 1.5;

static double power_of(const ps_problem *problem) {
    return fmax(nominal_power, ps_expected_power(problem));
}

static double points_of(const ps_problem *problem) {
    return (double)(problem->planned_points > 0 ? problem->planned_points : problem->num_points);
}

static const double unit_roundoff[2] = {0x1p-24, 0x1p-53};

/* Errors in units of the root of sum w^2, measured in tests/test_torus_nufft.c, slack in
 * docs/torus_nufft.md: of aliasing against its expectation for white sets, to which a peak of a lattice
 * comes, in pairs and of power N, wherever it does most harm; of rounding, in units of
 * roundoff: of windows and phases, of each pass of the transforms on both axes, of sums in dense cells
 * (root of the number of terms; where axis 0 has frequency 0, terms are in step and it is the number of points
 * in a cell that counts), of coincident points. */
static const double alias_slack = 1.6;
static const double alias_peaks = 8;      /* for each axis */
static const double coherent_aliases = 6; /* of |S|^2: aliases of coincident points are in step */
static const double window_roundings = 4;
static const double roundings_per_pass = 1;
static const double dense_roundings = 1;
static const double dense_roundings_at_zero = 2;
static const double coherent_roundings = 0.35;

static uint32_t divide_up(uint32_t a, uint32_t b) {
    return (a + b - 1) / b;
}

uint32_t ps_nufft_base(const ps_nufft_choice *choice) {
    return choice->stride * (uint32_t)choice->axes[0].max_frequency;
}

/* ---- error ------------------------------------------------------------------------------- */

double ps_nufft_error(const ps_nufft_choice *choice, const ps_problem *problem,
                      ps_precision precision, double mean_power) {
    const ps_frequencies *set = problem->frequencies;
    const double modes = pow(2.0 * set->max_frequency + 1, set->dimension);
    const double power = mean_power > 1 ? mean_power : 1;
    const double unit = unit_roundoff[precision];
    double amplification = 1;
    double aliases = 0;
    double worst = 0;
    double passes = 0;
    double dense = (double)problem->num_points; /* points in a cell, */
    double touching = dense;                    /* and those whose windows touch it */
    for (unsigned i = 0; i < choice->num_axes; i++) {
        const ps_nufft_axis *axis = &choice->axes[i];
        amplification *= axis->loss.amplification;
        aliases += axis->loss.aliasing;
        worst += axis->loss.worst;
        passes += axis->passes * roundings_per_pass;
        dense *= sqrt(axis->window.width) / axis->n;
        touching *= (double)axis->window.width / axis->n;
    }
    const double aliasing =
        sqrt(alias_slack * alias_slack * aliases +
             choice->num_axes * alias_peaks * worst * points_of(problem) / modes) *
        sqrt(fmax(1, coherent_aliases * (power - 1)));
    const double polynomials =
        PS_NUFFT_POLYNOMIAL_SHARE * problem->tolerance * sqrt(choice->num_axes * power);
    const double sums = dense_roundings * sqrt(touching);
    const double rounding = unit * amplification * (window_roundings + passes + sums);
    const double at_zero =
        unit * amplification * dense_roundings_at_zero * dense / sqrt(choice->span);
    const double coherent = unit * coherent_roundings * power * sqrt(power);
    return hypot(hypot(aliasing, polynomials), hypot(rounding * sqrt(power), at_zero)) + coherent;
}

/* ---- cost -------------------------------------------------------------------------------- */

/* Cycles on a core with vectors of `lanes` numbers (Zen 5, PoCL 3.1, 2026-11, profile of bench_nufft): of
 * a point to be sorted, and for windows and phases; of a point in a tile, and of a cell of its window
 * there. */
static const double cycles_per_point = 60;
static const double cycles_per_value = 6;
static const double cycles_per_cell = 1.2;

/* Two fused operations in a cycle. */
static const double flops_per_lane = 4;

double ps_nufft_flops(const ps_nufft_choice *choice, ps_precision precision, double num_points) {
    const ps_nufft_axis *last = &choice->axes[choice->num_axes - 1];
    const double kept = 2.0 * last->max_frequency + 1;
    double visits = num_points;
    double transforms = ps_fft_cycles(last->n);
    if (choice->num_axes == PS_NUFFT_MAX_AXES) {
        const ps_nufft_axis *first = &choice->axes[0];
        visits *= first->window.width;
        transforms = first->n * transforms + kept * ps_fft_cycles(first->n);
    }
    const double cycles =
        divide_up(choice->span, nominal_lanes[precision]) *
            (visits * (cycles_per_value + cycles_per_cell * last->window.width) + transforms) +
        num_points * cycles_per_point;
    return cycles * nominal_lanes[precision] * flops_per_lane;
}

/* ---- choice ------------------------------------------------------------------------------ */

static ps_nufft_axis make_axis(const ps_nufft_axis *what, uint32_t n, unsigned width) {
    ps_nufft_axis axis = *what;
    uint32_t radices[PS_FFT_MAX_PASSES];
    axis.n = n;
    axis.window = ps_nufft_window_make(width, axis.max_frequency, n);
    axis.loss = ps_nufft_window_loss(&axis.window, axis.max_frequency, n);
    axis.passes = 0;
    ps_fft_radices(n, radices);
    while (radices[axis.passes] != 0) {
        axis.passes++;
    }
    return axis;
}

/* Of a length: the narrowest window that keeps the tolerance, else the most exact one. */
static ps_nufft_axis choose_width(const ps_nufft_choice *whole, unsigned which, uint32_t n,
                                  const ps_problem *problem, ps_precision precision) {
    const double tolerance = problem->tolerance / sqrt(whole->num_axes);
    ps_nufft_axis best = {0};
    double least_error = HUGE_VAL;
    ps_problem alone_problem = *problem;
    alone_problem.tolerance = tolerance;
    for (unsigned width = PS_NUFFT_MIN_WIDTH;
         width <= PS_NUFFT_MAX_WIDTH && least_error > tolerance; width++) {
        const ps_nufft_choice alone = {
            .num_axes = 1, .span = whole->span, .axes = {make_axis(&whole->axes[which], n, width)}};
        const double error = ps_nufft_error(&alone, &alone_problem, precision, power_of(problem));
        if (error < least_error) {
            best = alone.axes[0];
            least_error = error;
        }
    }
    return best;
}

static size_t list_candidates(const ps_nufft_choice *whole, unsigned which,
                              const ps_problem *problem, ps_precision precision,
                              ps_nufft_axis candidates[MAX_CANDIDATES]) {
    const double twice_k = 2.0 * whole->axes[which].max_frequency;
    const uint64_t least = (uint64_t)fmax(LEAST_CELLS, ceil(least_sigma * twice_k + 1));
    const uint64_t last = ps_fft_good_length((uint64_t)fmax(LEAST_CELLS, largest_sigma * twice_k));
    size_t num = 0;
    for (uint32_t n = ps_fft_good_length(least); n != 0 && n <= last && num < MAX_CANDIDATES;
         n = ps_fft_good_length((uint64_t)n + 1)) {
        candidates[num++] = choose_width(whole, which, n, problem, precision);
    }
    return num;
}

typedef struct best_choice {
    ps_nufft_choice choice;
    double error, flops;
} best_choice;

static void consider(best_choice *best, const ps_nufft_choice *choice, const ps_problem *problem,
                     ps_precision precision) {
    const double error = ps_nufft_error(choice, problem, precision, power_of(problem));
    const double flops = ps_nufft_flops(choice, precision, points_of(problem));
    const bool is_enough = error <= problem->tolerance;
    const bool was_enough = best->error <= problem->tolerance;
    if (best->choice.num_axes == 0 ||
        (was_enough ? is_enough && flops < best->flops : is_enough || error < best->error)) {
        *best = (best_choice){*choice, error, flops};
    }
}

/* All fine grids of a choice whose axes have frequencies. */
static void consider_grids(best_choice *best, ps_nufft_choice *choice, const ps_problem *problem,
                           ps_precision precision) {
    ps_nufft_axis candidates[PS_NUFFT_MAX_AXES][MAX_CANDIDATES];
    size_t num[PS_NUFFT_MAX_AXES] = {1, 1};
    for (unsigned i = 0; i < choice->num_axes; i++) {
        num[i] = list_candidates(choice, i, problem, precision, candidates[i]);
    }
    for (size_t i = 0; i < num[0]; i++) {
        choice->axes[0] = candidates[0][i];
        for (size_t j = 0; j < num[1]; j++) {
            if (choice->num_axes == PS_NUFFT_MAX_AXES) {
                choice->axes[1] = candidates[1][j];
            }
            consider(best, choice, problem, precision);
        }
    }
}

/* Direct phases for the whole of axis 0, transforms on all others. */
static ps_nufft_choice direct_choice(uint32_t max_frequency, unsigned dimension) {
    ps_nufft_choice choice = {.num_axes = dimension - 1, .span = max_frequency + 1};
    for (unsigned i = 0; i < choice.num_axes; i++) {
        choice.axes[i] =
            (ps_nufft_axis){.axis = i + 1, .factor = 1, .max_frequency = (int32_t)max_frequency};
    }
    return choice;
}

/* One dimension: a transform of every stride-th frequency. */
static ps_nufft_choice strided_choice(uint32_t max_frequency, uint32_t stride) {
    const uint32_t needed = divide_up(max_frequency + 1, stride);
    return (ps_nufft_choice){
        .num_axes = 1,
        .span = stride,
        .stride = stride,
        .axes = {{.axis = 0, .factor = stride, .max_frequency = (int32_t)(needed / 2)}}};
}

ps_nufft_choice ps_nufft_choose(const ps_problem *whole, ps_precision precision) {
    const unsigned dimension = whole->frequencies->dimension;
    const uint32_t max_frequency = (uint32_t)whole->frequencies->max_frequency;
    ps_problem planned = *whole; /* the error of a choice, too, is that of the points planned */
    const ps_problem *problem = &planned;
    planned.num_points = planned.planned_points > 0 ? planned.planned_points : planned.num_points;
    best_choice best = {0};
    if (dimension == 2 || dimension == 3) {
        ps_nufft_choice choice = direct_choice(max_frequency, dimension);
        consider_grids(&best, &choice, problem, precision);
    } else {
        for (uint32_t tiles = 1; tiles <= MOST_TILES; tiles *= 2) {
            ps_nufft_choice choice =
                strided_choice(max_frequency, tiles * nominal_lanes[precision]);
            consider_grids(&best, &choice, problem, precision);
        }
    }
    return best.choice;
}
