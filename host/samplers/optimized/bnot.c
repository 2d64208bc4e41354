#include "samplers/optimized/bnot.h"

#include "base/memory.h"
#include "samplers/list.h"
#include "base/text.h"
#include "samplers/optimized/cells.h"
#include "samplers/values.h"

#include <math.h>
#include <stdlib.h>

/* The thresholds of the authors' program, as UTK has it, in units of eps: gradients of positions
 * 0.03/N, which is this root mean square of distances from centroids, and of areas 0.03/N. */
static const double NEAR_CENTROID = 0.015;
static const double AREA_ERROR = 0.03;
/* Weights are kept over a move while the smallest cell has more than this of the mean area: from
 * smaller ones, the Hessian is near to singular. */
static const double SMALL_CELL = 0.02;
/* Nor are they kept after moves longer than this (root mean square, in 1/sqrt(N)): what they fit is
 * then another set. */
static const double LONG_MOVE = 0.1;
/* Moves until it is given up: 340 are needed at eps = 0.05, 9 at 1. */
enum { MOST_MOVES = 20000 };

/* Root mean square of distances from centroids, in units of 1/sqrt(N). */
static double distance_from_centroids(const ps_bnot *b) {
    double sum = 0;
    for (size_t i = 0; i < b->cells.num; i++) {
        sum += b->x[i] * b->x[i] + b->y[i] * b->y[i];
    }
    return sqrt(sum);
}

static void move(ps_bnot *b, bool keeps_weights) {
    ps_power_cells *const cells = &b->cells;
    int period;
    for (size_t i = 0; i < cells->num; i++) {
        cells->x[i] = ps_power_cells_wrap(cells->x[i] + b->x[i], &period);
        cells->y[i] = ps_power_cells_wrap(cells->y[i] + b->y[i], &period);
        cells->w[i] = keeps_weights ? cells->w[i] : 0;
    }
    ps_power_cells_sort(cells);
    b->has_known = false;
    b->num_moves++;
}

static void forget_weights(ps_bnot *b) {
    for (size_t i = 0; i < b->cells.num; i++) {
        b->cells.w[i] = 0;
    }
    ps_power_cells_weigh(&b->cells);
    b->has_known = false;
}

/* Cells after a move, without weights if those it had are of no use. */
static pspec_status evaluate_moved(ps_bnot *b, ps_error *error) {
    const double mean = 1 / (double)b->cells.num;
    PS_TRY(ps_bnot_evaluate(b, error));
    if (b->least_area < SMALL_CELL * mean) {
        forget_weights(b);
        PS_TRY(ps_bnot_evaluate(b, error));
    }
    if (!(b->least_area > 0)) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "two of the %zu points coincide: their cells cannot have equal areas",
                       b->cells.num);
    }
    return PSPEC_OK;
}

static pspec_status run(ps_bnot *b, double eps, double *distance, ps_error *error) {
    const double root = sqrt((double)b->cells.num);
    const ps_bnot_target while_moving = {AREA_ERROR * eps / root, 1};
    const ps_bnot_target in_the_end = {1, PS_BNOT_CAPACITY};
    for (;;) {
        PS_TRY(evaluate_moved(b, error));
        PS_TRY(ps_bnot_solve(b, while_moving, error));
        *distance = distance_from_centroids(b);
        if (*distance <= NEAR_CENTROID * eps) {
            break;
        }
        if (b->num_moves == MOST_MOVES) {
            return ps_fail(error, PSPEC_ERROR_CHECK,
                           "%zu points are %.3g/sqrt(N) from the centroids of their cells after "
                           "%d moves, not %.3g: a larger eps ends sooner",
                           b->cells.num, *distance, MOST_MOVES, NEAR_CENTROID * eps);
        }
        move(b, *distance < LONG_MOVE);
    }
    return ps_bnot_solve(b, in_the_end, error);
}

static void give(const ps_bnot *b, double distance, double *points, double *weights,
                 ps_bnot_outcome *outcome) {
    for (size_t i = 0; i < b->cells.num; i++) {
        points[2 * i] = b->cells.x[i];
        points[2 * i + 1] = b->cells.y[i];
        if (weights != NULL) {
            weights[i] = b->cells.w[i];
        }
    }
    if (outcome != NULL) {
        *outcome = (ps_bnot_outcome){.moves = b->num_moves,
                                     .steps = b->num_steps,
                                     .tries = b->num_tries,
                                     .distance = distance,
                                     .capacity = b->worst_area * (double)b->cells.num};
    }
}

pspec_status ps_bnot_check(size_t num, double eps, ps_error *error) {
    if (!(eps >= PS_BNOT_LEAST_EPS && eps <= PS_BNOT_MOST_EPS)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "eps = %g: it is from %g to %g", eps,
                       PS_BNOT_LEAST_EPS, PS_BNOT_MOST_EPS);
    }
    return ps_power_cells_check(num, error);
}

pspec_status ps_bnot_optimise(size_t num, double eps, const ps_watch *watch, double *points,
                              double *weights, ps_bnot_outcome *outcome, ps_error *error) {
    ps_bnot *b = NULL;
    double distance = 0;
    PS_TRY(ps_bnot_check(num, eps, error));
    PS_TRY(PS_NEW(&b, 1, "cells of points", error));
    pspec_status status = ps_bnot_create(b, num, points, watch, error);
    if (status == PSPEC_OK) {
        status = run(b, eps, &distance, error);
        if (status == PSPEC_OK) {
            give(b, distance, points, weights, outcome);
        }
        ps_bnot_destroy(b);
    }
    free(b);
    return status;
}

pspec_status ps_bnot_make(size_t num, double eps, ps_random *random, const ps_watch *watch,
                          double *points, ps_error *error) {
    PS_TRY(ps_bnot_check(num, eps, error));
    ps_random_fill_uniform(random, points, 2 * num);
    return ps_bnot_optimise(num, eps, watch, points, NULL, NULL, error);
}

/* ---- the row --------------------------------------------------------------------------------- */

enum { EPS };

/* All cells are made 9 times at eps = 10, 27 at 1, 127 at 0.2 and 560 at 0.05, in 1 us each; the
 * gradients between two take a time that grows with sqrt(N) (bench_cells bnot). */
static double seconds(const ps_sampler_request *request) {
    const double num = (double)request->num_points;
    return num * (3 + 25 / ps_sampler_number(request, EPS)) * (1 + 0.004 * sqrt(num)) * 1e-6;
}

static double work_bytes(const ps_sampler_request *request) {
    return ps_bnot_bytes(request->num_points);
}

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    ps_random random = ps_random_init(request->seed, PS_STREAM_COORDINATES, realization);
    return ps_bnot_make(request->num_points, ps_sampler_number(request, EPS), &random,
                        request->watch, points, error);
}

const ps_sampler ps_sampler_bnot = {
    .name = "bnot",
    .stands_beside = true,
    .summary = "blue noise through optimal transport",
    .aliases = {"optimal-transport"},
    .minimum_dimension = 2,
    .maximum_dimension = 2,
    .minimum_points = PS_CELLS_LEAST_POINTS,
    .maximum_points = PS_CELLS_MOST_POINTS,
    .parameters = {{"eps", "1",
                    "0.02 to 10, how near to the centroids of cells; smaller is more regular"}},
    .ranges = {{PS_BNOT_LEAST_EPS, PS_BNOT_MOST_EPS, false}},
    .version = 1,
    .seconds = seconds,
    .work_bytes = work_bytes,
    .is_deterministic = ps_sampler_never,
    .generate = generate,
};
