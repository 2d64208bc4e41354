
#include "base/round.h"
#include "engines/torus/nufft/cost.h"
#include "engines/torus/nufft/choice.h"
#include "engines/nufft/fft.h"
#include "engines/torus/nufft/variant.h"

#include <math.h>

/* Fine grids from sigma = n / 2K on. Below 1.2 windows become wider than 16, above 4 they hardly
 * shrink. */
static const double least_sigma = 1.2;
static const double largest_sigma = 4;

/* Windows must not meet themselves. */
enum { LEAST_CELLS = PS_NUFFT_MAX_WIDTH };

/* Lengths between the two sigmas, twice. */
enum { MAX_CANDIDATES = 128 };

/* Long lengths are tried only where they differ by this part at least, so that all sigmas are among
 * the candidates. */
enum { NEXT_LENGTH = 64 };

/* Mean power to choose for at least: that of white sets, half of whose modes are independent, stays
 * within four standard deviations. */
static double power_of(const ps_problem *problem) {
    const double most = 1.5;
    const double nominal = fmin(most, 1 + 4 * sqrt(2 / ps_nufft_modes(problem)));
    return fmax(nominal, ps_expected_power(problem));
}

/* Makes an axis of a window without its loss, of which it has a lower bound alone. */
static ps_nufft_axis begin_axis(const ps_nufft_axis *of_length, unsigned width) {
    ps_nufft_axis axis = *of_length;
    axis.window = (ps_nufft_window){
        .width = width, .beta = ps_nufft_window_beta(width, axis.max_frequency, axis.n)};
    axis.loss = (ps_nufft_loss){
        .worst = ps_nufft_window_least_worst(&axis.window, axis.max_frequency, axis.n)};
    return axis;
}

static ps_nufft_axis make_axis(const ps_nufft_axis *of_length, unsigned width) {
    ps_nufft_axis axis = *of_length;
    axis.window = ps_nufft_window_make(width, axis.max_frequency, axis.n);
    axis.loss = ps_nufft_window_loss(&axis.window, axis.max_frequency, axis.n);
    return axis;
}

/* ---- windows ----------------------------------------------------------------------------- */

/* The best choice that was found so far. */
typedef struct best_choice {
    ps_nufft_choice choice;
    double error, flops;
} best_choice;

/* What a window of one axis is chosen for. */
typedef struct axis_search {
    const ps_nufft_choice *whole;
    unsigned which;
    const ps_problem *problem;
    ps_precision precision;
    const best_choice *best;
} axis_search;

/* The axis that is searched for, without a window. */
static ps_nufft_axis axis_of_length(const axis_search *search, uint32_t n) {
    ps_nufft_axis axis = search->whole->axes[search->which];
    axis.n = n;
    axis.passes = ps_fft_passes(n);
    return axis;
}

static double share_of_tolerance(const axis_search *search) {
    const double rest = 0.95; /* of the tolerance, where something else comes to it */
    const unsigned num_axes = search->whole->num_axes;
    return num_axes > 1 ? rest * search->problem->tolerance / sqrt(num_axes)
                        : search->problem->tolerance;
}

/* The axis alone: an error of which it may have its share of the tolerance. */
static double error_alone(const axis_search *search, const ps_nufft_axis *axis) {
    const ps_nufft_choice *whole = search->whole;
    ps_problem problem = *search->problem;
    problem.tolerance = share_of_tolerance(search);
    problem.planned_points = (uint64_t)ps_planned_points(search->problem);
    if (whole->num_axes > 1) {
        problem.num_points = 1; /* as many as touch a row would be another problem */
    }
    return ps_nufft_error_of_axis(whole, axis, &problem, search->precision,
                                  power_of(search->problem));
}

static bool keeps_tolerance(const best_choice *best, const ps_problem *problem) {
    return best->choice.num_axes > 0 && best->error <= problem->tolerance;
}

/* Completes a choice in way number `which`; false: there are no more. */
static bool complete(ps_nufft_choice *choice, const ps_problem *problem, ps_precision precision,
                     unsigned which) {
    return choice->variant->complete != NULL
               ? choice->variant->complete(choice, problem, precision, which)
               : which == 0;
}

/* Says whether, with one axis, a choice that keeps the tolerance costs no more than this one. */
static bool is_hopeless(const axis_search *search, const ps_nufft_axis *axis) {
    ps_nufft_choice choice = *search->whole;
    if (choice.num_axes > 1 || !keeps_tolerance(search->best, search->problem)) {
        return false;
    }
    choice.axes[0] = *axis;
    if (!complete(&choice, search->problem, search->precision, 0)) {
        return true;
    }
    return ps_nufft_flops(&choice, search->precision, ps_planned_points(search->problem)) >=
           search->best->flops;
}

/* Finds the narrowest window of a length that keeps the tolerance. Losses take microseconds, and
 * there are hundreds of lengths: they are computed only for windows that a bound leaves and that
 * would be cheaper than what there is. False says that the length has no such window. */
static bool find_narrowest(const axis_search *search, const ps_nufft_axis *of_length,
                           ps_nufft_axis *out) {
    const double tolerance = share_of_tolerance(search);
    for (unsigned width = PS_NUFFT_MIN_WIDTH; width <= PS_NUFFT_MAX_WIDTH; width++) {
        *out = begin_axis(of_length, width);
        if (error_alone(search, out) > tolerance) {
            continue;
        }
        if (is_hopeless(search, out)) {
            return false;
        }
        *out = make_axis(of_length, width);
        if (error_alone(search, out) <= tolerance) {
            return true;
        }
    }
    return false;
}

/* Finds the most exact window of a length, of several the narrowest. Losses are computed only for
 * the window with the least bound and for those whose bound is below what was found. */
static ps_nufft_axis find_most_exact(const axis_search *search, const ps_nufft_axis *of_length) {
    enum { WIDTHS = PS_NUFFT_MAX_WIDTH - PS_NUFFT_MIN_WIDTH + 1 };
    double bounds[WIDTHS];
    unsigned hopeful = 0;
    for (unsigned i = 0; i < WIDTHS; i++) {
        ps_nufft_axis axis = begin_axis(of_length, PS_NUFFT_MIN_WIDTH + i);
        axis.loss.amplification =
            ps_nufft_window_amplification(&axis.window, axis.max_frequency, axis.n);
        bounds[i] = error_alone(search, &axis);
        hopeful = bounds[i] < bounds[hopeful] ? i : hopeful;
    }
    ps_nufft_axis best = make_axis(of_length, PS_NUFFT_MIN_WIDTH + hopeful);
    double least_error = error_alone(search, &best);
    for (unsigned i = 0; i < WIDTHS; i++) {
        if (i == hopeful || bounds[i] > least_error) {
            continue;
        }
        const ps_nufft_axis axis = make_axis(of_length, PS_NUFFT_MIN_WIDTH + i);
        const double error = error_alone(search, &axis);
        if (error < least_error ||
            (error == least_error && axis.window.width < best.window.width)) {
            best = axis;
            least_error = error;
        }
    }
    return best;
}

static uint32_t length_for(const ps_nufft_choice *whole, unsigned which, uint64_t least) {
    const ps_nufft_variant *variant = whole->variant;
    const uint32_t unit = variant->unit != NULL ? variant->unit(whole, which) : 1;
    return least > variant->most_cells ? 0 : ps_fft_good_length(ps_divide_up(least, unit)) * unit;
}

/* The lengths of an axis, one after the other, beginning with n = 0; 0: there are no more. */
static uint32_t next_length(const axis_search *search, uint32_t n) {
    const ps_nufft_choice *whole = search->whole;
    const double twice_k = 2.0 * whole->axes[search->which].max_frequency;
    const uint64_t least = n == 0 ? (uint64_t)fmax(LEAST_CELLS, ceil(least_sigma * twice_k + 1))
                                  : (uint64_t)n + 1 + n / NEXT_LENGTH;
    const uint32_t next = length_for(whole, search->which, least);
    const bool is_too_long = n > 0 && next > (uint64_t)(largest_sigma * twice_k);
    return next <= whole->variant->most_cells && !is_too_long ? next : 0;
}

/* Where there are two axes, a window may be narrower if the other is wider. */
static size_t list_candidates(const axis_search *search, ps_nufft_axis candidates[MAX_CANDIDATES]) {
    size_t num = 0;
    for (uint32_t n = next_length(search, 0); n != 0 && num + 2 <= MAX_CANDIDATES;
         n = next_length(search, n)) {
        const ps_nufft_axis of_length = axis_of_length(search, n);
        ps_nufft_axis axis = {0};
        if (!find_narrowest(search, &of_length, &axis)) {
            axis = find_most_exact(search, &of_length);
        }
        candidates[num++] = axis;
        if (search->whole->num_axes == 2 && axis.window.width > PS_NUFFT_MIN_WIDTH) {
            candidates[num++] = make_axis(&of_length, axis.window.width - 1);
        }
    }
    return num;
}

static void consider(best_choice *best, const ps_nufft_choice *choice, const ps_problem *problem,
                     ps_precision precision) {
    const double error = ps_nufft_error(choice, problem, precision, power_of(problem));
    const double flops = ps_nufft_flops(choice, precision, ps_planned_points(problem));
    const bool is_enough = error <= problem->tolerance;
    const bool was_enough = best->error <= problem->tolerance;
    if (best->choice.num_axes == 0 ||
        (was_enough ? is_enough && flops < best->flops : is_enough || error < best->error)) {
        *best = (best_choice){*choice, error, flops};
    }
}

/* A choice with lengths and windows, in all ways that complete it. */
static void consider_grid(best_choice *best, ps_nufft_choice *choice, const ps_problem *problem,
                          ps_precision precision) {
    for (unsigned which = 0; complete(choice, problem, precision, which); which++) {
        consider(best, choice, problem, precision);
    }
}

/* All fine grids of one axis. */
static void consider_lengths(best_choice *best, ps_nufft_choice *choice, const ps_problem *problem,
                             ps_precision precision) {
    const axis_search search = {choice, 0, problem, precision, best};
    for (uint32_t n = next_length(&search, 0); n != 0; n = next_length(&search, n)) {
        const ps_nufft_axis of_length = axis_of_length(&search, n);
        ps_nufft_axis axis = {0};
        const bool is_enough = find_narrowest(&search, &of_length, &axis);
        if (!is_enough && keeps_tolerance(best, problem)) {
            continue; /* nothing to gain from it */
        }
        choice->axes[0] = is_enough ? axis : find_most_exact(&search, &of_length);
        consider_grid(best, choice, problem, precision);
    }
}

/* All fine grids of a choice whose axes have frequencies. */
static void consider_grids(best_choice *best, ps_nufft_choice *choice, const ps_problem *problem,
                           ps_precision precision) {
    ps_nufft_axis candidates[PS_NUFFT_MAX_AXES][MAX_CANDIDATES];
    size_t num[PS_NUFFT_MAX_AXES] = {1, 1, 1};
    size_t total = 1;
    if (choice->num_axes == 1) {
        consider_lengths(best, choice, problem, precision);
        return;
    }
    const bool are_alike = choice->variant->are_alike; /* to the first */
    for (unsigned i = 0; i < (are_alike ? 1 : choice->num_axes); i++) {
        const axis_search search = {choice, i, problem, precision, best};
        num[i] = list_candidates(&search, candidates[i]);
        total *= num[i];
    }
    for (size_t combination = 0; combination < total; combination++) {
        size_t rest = combination;
        for (unsigned i = 0; i < choice->num_axes; i++) {
            const unsigned from = are_alike ? 0 : i, axis = choice->axes[i].axis;
            choice->axes[i] = candidates[from][rest % num[from]];
            choice->axes[i].axis = axis;
            rest /= are_alike ? 1 : num[i];
        }
        consider_grid(best, choice, problem, precision);
    }
}

static unsigned lanes_of(const ps_device_limits *limits, ps_precision precision) {
    const bool is_cpu = limits != NULL && !limits->has_dedicated_local_memory;
    const unsigned lanes = is_cpu ? ps_engine_lanes(limits, precision) : 1;
    return lanes > 1 ? lanes : ps_nufft_nominal_lanes(precision);
}

ps_nufft_choice ps_nufft_choose_among(const ps_nufft_variant *const *variants,
                                      const ps_problem *whole, const ps_device_limits *limits,
                                      ps_precision precision) {
    const bool is_gpu = limits != NULL && limits->has_dedicated_local_memory;
    const unsigned lanes = lanes_of(limits, precision);
    ps_problem problem = *whole; /* the error of a choice, too, is that of the points planned */
    problem.num_points = problem.planned_points > 0 ? problem.planned_points : problem.num_points;
    best_choice best = {0};
    for (size_t i = 0; variants[i] != NULL; i++) {
        const ps_nufft_variant *variant = variants[i];
        ps_nufft_choice choice = {0};
        for (unsigned which = 0; (is_gpu ? variant->on_gpus : variant->on_cpus) &&
                                 variant->offer(&problem, lanes, which, &choice);
             which++) {
            choice.variant = variant;
            choice.lanes = lanes;
            consider_grids(&best, &choice, &problem, precision);
        }
    }
    if (best.choice.num_axes > 0 && best.choice.variant->settle != NULL) {
        best.choice.variant->settle(&best.choice, &problem);
    }
    return best.choice;
}

ps_nufft_choice ps_nufft_choose(const ps_problem *problem, const ps_device_limits *limits,
                                ps_precision precision) {
    return ps_nufft_choose_among(ps_nufft_variants, problem, limits, precision);
}
