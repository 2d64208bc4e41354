#include "engines/nufft/choose.h"

#include "base/round.h"
#include "engines/nufft/cost.h"
#include "engines/nufft/error.h"
#include "engines/nufft/fft.h"
#include "engines/nufft/sizes/lines.h"
#include "engines/nufft/sizes/strips.h"
#include "engines/nufft/whole_shape.h"

#include <math.h>

/* Fine grids from sigma = n / 2K on. Below 1.2 windows become wider than 16, above 4 they hardly
 * shrink. */
static const double least_sigma = 1.2;
static const double largest_sigma = 4;

/* Windows must not meet themselves. */
enum { LEAST_CELLS = PS_NUFFT_MAX_WIDTH };

/* A row must fit into local memory, a megabyte at most, in one lane of 8 bytes. */
enum { MOST_CELLS = 1 << 17 };

/* Grids take one set at a time: never worth while for fewer points. */
static const double least_gridded_points = 30000;

/* Sets of more points always go on a grid, in two and three dimensions: the places of all others
 * take memory for every point, up to 96 bytes of it. */
static const double most_sorted_points = 1 << 23;

/* Realizations that are done whole come to the device in one piece, and one core has each. */
static const double most_whole_points[PS_NUFFT_MAX_AXES] = {1 << 20, 1 << 18, 0};

/* One dimension has at most so many tiles; more of them mean shorter transforms. */
enum { MOST_TILES = 64 };

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

/* Makes an axis without its loss, of which it has a lower bound alone. */
static ps_nufft_axis begin_axis(const ps_nufft_axis *what, uint32_t n, unsigned width) {
    ps_nufft_axis axis = *what;
    uint32_t radices[PS_FFT_MAX_PASSES];
    axis.n = n;
    axis.window = ps_nufft_window_make(width, axis.max_frequency, n);
    axis.loss =
        (ps_nufft_loss){.worst = ps_nufft_window_least_worst(&axis.window, axis.max_frequency, n)};
    axis.passes = 0;
    ps_fft_radices(n, radices);
    while (radices[axis.passes] != 0) {
        axis.passes++;
    }
    return axis;
}

static ps_nufft_axis make_axis(const ps_nufft_axis *what, uint32_t n, unsigned width) {
    ps_nufft_axis axis = begin_axis(what, n, width);
    axis.loss = ps_nufft_window_loss(&axis.window, axis.max_frequency, n);
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
    const ps_nufft_choice alone = {.num_axes = 1,
                                   .span = whole->span,
                                   .stride = whole->stride,
                                   .is_whole = whole->is_whole && whole->num_axes == 1,
                                   .axes = {*axis}};
    problem.tolerance = share_of_tolerance(search);
    problem.planned_points = (uint64_t)ps_planned_points(search->problem);
    if (whole->num_axes > 1) {
        problem.num_points = 1; /* as many as touch a row would be another problem */
    }
    return ps_nufft_error(&alone, &problem, search->precision, power_of(search->problem));
}

static bool keeps_tolerance(const best_choice *best, const ps_problem *problem) {
    return best->choice.num_axes > 0 && best->error <= problem->tolerance;
}

/* Says whether, with one axis, a choice that keeps the tolerance costs no more than this one. */
static bool is_hopeless(const axis_search *search, const ps_nufft_axis *axis) {
    ps_nufft_choice choice = *search->whole;
    if (choice.num_axes > 1 || !keeps_tolerance(search->best, search->problem)) {
        return false;
    }
    choice.axes[0] = *axis;
    if (choice.is_whole && !ps_nufft_whole_shape(&choice, search->precision)) {
        return true;
    }
    return ps_nufft_flops(&choice, search->precision, ps_planned_points(search->problem)) >=
           search->best->flops;
}

/* Finds the narrowest window of a length that keeps the tolerance. Losses take microseconds, and
 * there are hundreds of lengths: they are computed only for windows that a bound leaves and that
 * would be cheaper than what there is. False says that the length has no such window. */
static bool find_narrowest(const axis_search *search, uint32_t n, ps_nufft_axis *out) {
    const double tolerance = share_of_tolerance(search);
    for (unsigned width = PS_NUFFT_MIN_WIDTH; width <= PS_NUFFT_MAX_WIDTH; width++) {
        const ps_nufft_axis *what = &search->whole->axes[search->which];
        *out = begin_axis(what, n, width);
        if (error_alone(search, out) > tolerance) {
            continue;
        }
        if (is_hopeless(search, out)) {
            return false;
        }
        *out = make_axis(what, n, width);
        if (error_alone(search, out) <= tolerance) {
            return true;
        }
    }
    return false;
}

/* The most exact window of a length. */
static ps_nufft_axis find_most_exact(const axis_search *search, uint32_t n) {
    ps_nufft_axis best = {0};
    double least_error = HUGE_VAL;
    for (unsigned width = PS_NUFFT_MAX_WIDTH; width >= PS_NUFFT_MIN_WIDTH; width--) {
        const ps_nufft_axis *what = &search->whole->axes[search->which];
        ps_nufft_axis axis = begin_axis(what, n, width);
        if (error_alone(search, &axis) > least_error) {
            continue;
        }
        axis = make_axis(what, n, width);
        const double error = error_alone(search, &axis);
        if (error <= least_error) {
            best = axis;
            least_error = error;
        }
    }
    return best;
}

/* Cells of a grid's last axis fill whole vectors, twice, or strips; both axes that are done in
 * strips have the same lengths. */
static uint32_t length_for(const ps_nufft_choice *whole, unsigned which, uint64_t least) {
    const bool is_last = which + 1 == whole->num_axes;
    const bool has_vectors = ps_nufft_way_of(whole) == PS_NUFFT_LARGE && is_last;
    const uint32_t unit = whole->is_in_strips ? ps_nufft_strip_columns(whole->lanes)
                          : has_vectors       ? 2 * whole->lanes
                                              : 1;
    return least > MOST_CELLS ? 0 : ps_fft_good_length(ps_divide_up(least, unit)) * unit;
}

/* The lengths of an axis, one after the other, beginning with n = 0; 0: there are no more. */
static uint32_t next_length(const axis_search *search, uint32_t n) {
    const ps_nufft_choice *whole = search->whole;
    const double twice_k = 2.0 * whole->axes[search->which].max_frequency;
    const uint64_t least = n == 0 ? (uint64_t)fmax(LEAST_CELLS, ceil(least_sigma * twice_k + 1))
                                  : (uint64_t)n + 1 + n / NEXT_LENGTH;
    const uint32_t next = length_for(whole, search->which, least);
    const bool is_too_long = n > 0 && next > (uint64_t)(largest_sigma * twice_k);
    return next <= MOST_CELLS && !is_too_long ? next : 0;
}

/* Where there are two axes, a window may be narrower if the other is wider. */
static size_t list_candidates(const axis_search *search, ps_nufft_axis candidates[MAX_CANDIDATES]) {
    size_t num = 0;
    for (uint32_t n = next_length(search, 0); n != 0 && num + 2 <= MAX_CANDIDATES;
         n = next_length(search, n)) {
        ps_nufft_axis axis = {0};
        if (!find_narrowest(search, n, &axis)) {
            axis = find_most_exact(search, n);
        }
        candidates[num++] = axis;
        if (search->whole->num_axes == 2 && axis.window.width > PS_NUFFT_MIN_WIDTH) {
            candidates[num++] = make_axis(&axis, n, axis.window.width - 1);
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

/* Points that put so many windows on a cell. */
static double points_for(const ps_nufft_choice *choice, double windows_on_a_cell) {
    double points = windows_on_a_cell;
    for (unsigned i = 0; i < choice->num_axes; i++) {
        points *= (double)choice->axes[i].n / choice->axes[i].window.width;
    }
    return points;
}

/* Points added up before their sums go into pairs: so that what the mean of the cells rounds off
 * stays small, without going over the grid too often. */
static uint64_t choose_chunk(const ps_nufft_choice *choice) {
    const double windows_on_a_cell = 16;
    const double least = 4096;
    const double most = PS_NUFFT_MOST_CHUNK_POINTS;
    return (uint64_t)fmin(fmax(points_for(choice, windows_on_a_cell), least), most);
}

/* Roundings of plain sums of more windows on a cell may be in step beyond what the bound allows
 * for: whole realizations were tried to thousands, large sets were not. */
static bool can_be_plain(const ps_nufft_choice *choice, double num_points) {
    const double windows_on_a_cell = 256;
    return num_points <= points_for(choice, windows_on_a_cell);
}

/* Where windows of few points touch a cell, sums may do without pairs. */
static void consider_large(best_choice *best, ps_nufft_choice *choice, const ps_problem *problem,
                           ps_precision precision) {
    choice->chunk = 0;
    if (can_be_plain(choice, ps_planned_points(problem))) {
        consider(best, choice, problem, precision);
    }
    choice->chunk = choose_chunk(choice);
    consider(best, choice, problem, precision);
}

/* Whether a choice with lengths and windows can be done its way. */
static bool has_shape(ps_nufft_choice *choice, ps_precision precision) {
    return choice->is_whole       ? ps_nufft_whole_shape(choice, precision)
           : choice->is_in_strips ? ps_nufft_strips_fit(choice, precision)
                                  : true;
}

/* A choice with lengths and windows. */
static void consider_grid(best_choice *best, ps_nufft_choice *choice, const ps_problem *problem,
                          ps_precision precision) {
    if (ps_nufft_way_of(choice) == PS_NUFFT_LARGE) {
        consider_large(best, choice, problem, precision);
        return;
    }
    choice->chunk = 0;
    if (has_shape(choice, precision)) {
        consider(best, choice, problem, precision);
    }
}

/* All fine grids of one axis. */
static void consider_lengths(best_choice *best, ps_nufft_choice *choice, const ps_problem *problem,
                             ps_precision precision) {
    const axis_search search = {choice, 0, problem, precision, best};
    for (uint32_t n = next_length(&search, 0); n != 0; n = next_length(&search, n)) {
        ps_nufft_axis axis = {0};
        const bool is_enough = find_narrowest(&search, n, &axis);
        if (!is_enough && keeps_tolerance(best, problem)) {
            continue; /* nothing to gain from it */
        }
        choice->axes[0] = is_enough ? axis : find_most_exact(&search, n);
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
    for (unsigned i = 0; i < choice->num_axes; i++) {
        const axis_search search = {choice, i, problem, precision, best};
        num[i] = list_candidates(&search, candidates[i]);
        total *= num[i];
    }
    const bool are_alike = choice->is_whole || choice->is_in_strips; /* both axes */
    total = are_alike ? num[0] : total;
    for (size_t combination = 0; combination < total; combination++) {
        size_t rest = combination;
        for (unsigned i = 0; i < choice->num_axes; i++) {
            choice->axes[i] = candidates[i][rest % num[i]];
            rest /= are_alike ? 1 : num[i];
        }
        consider_grid(best, choice, problem, precision);
    }
}

/* Direct phases for the whole of axis 0, transforms on all others. */
static ps_nufft_choice direct_choice(unsigned lanes, uint32_t max_frequency, unsigned dimension) {
    ps_nufft_choice choice = {.lanes = lanes, .num_axes = dimension - 1, .span = max_frequency + 1};
    for (unsigned i = 0; i < choice.num_axes; i++) {
        choice.axes[i] =
            (ps_nufft_axis){.axis = i + 1, .factor = 1, .max_frequency = (int32_t)max_frequency};
    }
    return choice;
}

/* A grid on all axes. */
static ps_nufft_choice gridded_choice(unsigned lanes, uint32_t max_frequency, unsigned dimension) {
    ps_nufft_choice choice = {
        .lanes = lanes, .num_axes = dimension, .span = max_frequency + 1, .is_gridded = true};
    for (unsigned i = 0; i < dimension; i++) {
        choice.axes[i] =
            (ps_nufft_axis){.axis = i, .factor = 1, .max_frequency = (int32_t)max_frequency};
    }
    return choice;
}

/* One dimension: a transform of every stride-th frequency. */
static ps_nufft_choice strided_choice(unsigned lanes, uint32_t max_frequency, uint32_t stride) {
    const uint64_t needed = ps_divide_up((uint64_t)max_frequency + 1, stride);
    return (ps_nufft_choice){
        .lanes = lanes,
        .num_axes = 1,
        .span = stride,
        .stride = stride,
        .axes = {{.axis = 0, .factor = stride, .max_frequency = (int32_t)(needed / 2)}}};
}

static unsigned lanes_of(const ps_device_limits *limits, ps_precision precision) {
    const bool is_cpu = limits != NULL && !limits->has_dedicated_local_memory;
    const unsigned lanes = is_cpu ? ps_engine_lanes(limits, precision) : 1;
    return lanes > 1 ? lanes : ps_nufft_nominal_lanes(precision);
}

ps_nufft_choice ps_nufft_choose(const ps_problem *whole, const ps_device_limits *limits,
                                ps_precision precision) {
    const unsigned dimension = whole->frequencies->dimension;
    const uint32_t max_frequency = (uint32_t)whole->frequencies->max_frequency;
    const unsigned lanes = lanes_of(limits, precision);
    ps_problem planned = *whole; /* the error of a choice, too, is that of the points planned */
    const ps_problem *problem = &planned;
    planned.num_points = planned.planned_points > 0 ? planned.planned_points : planned.num_points;
    best_choice best = {0};
    if (dimension == 2 || dimension == 3) {
        ps_nufft_choice choice = direct_choice(lanes, max_frequency, dimension);
        if (ps_planned_points(problem) <= most_sorted_points) {
            consider_grids(&best, &choice, problem, precision);
        }
        if (ps_planned_points(problem) >= least_gridded_points) {
            choice = gridded_choice(lanes, max_frequency, dimension);
            consider_grids(&best, &choice, problem, precision);
        }
    } else {
        for (uint32_t tiles = 1; tiles <= MOST_TILES; tiles *= 2) {
            ps_nufft_choice choice = strided_choice(lanes, max_frequency, tiles * lanes);
            consider_grids(&best, &choice, problem, precision);
        }
    }
    if (ps_planned_points(problem) <= most_whole_points[dimension - 1] &&
        (limits == NULL || !limits->has_dedicated_local_memory)) {
        ps_nufft_choice choice = gridded_choice(lanes, max_frequency, dimension);
        choice.is_whole = true;
        consider_grids(&best, &choice, problem, precision);
        if (dimension == 2 && problem->num_realizations != 1) { /* one would keep one core busy */
            choice.is_whole = false;
            choice.is_in_strips = true;
            consider_grids(&best, &choice, problem, precision);
        }
    }
    best.choice.has_line = ps_nufft_lines_pay(&best.choice, problem, limits);
    return best.choice;
}
