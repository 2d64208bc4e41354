#include "samplers/forces/step.h"

#include "base/memory.h"
#include "samplers/forces/loan.h"
#include "samplers/forces/step_pairs.h"
#include "samplers/list.h"
#include "base/text.h"
#include "samplers/values.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The schedule of the authors' program: a step is this share of the mean distance at most, at
 * first; shorter by a factor after so many tries that were not better than the best, or after one
 * that was so much worse, which also goes back to the best; and it ends at the last length. */
static const double FIRST_LENGTH = 1;
static const double LAST_LENGTH = 1e-3;
static const double SHORTER = 0.9;
static const double WORSE = 1.2;
enum { AXES = 2, MOST_TRIES = 5 };

typedef struct search {
    ps_step_pairs pairs;
    ps_step_curves curves;
    uint64_t *counts;   /* [num_bins] */
    double *table;      /* [num_bins + 1] */
    double *x, *force;  /* [num][2] */
    double *best;       /* [num][2] */
    double *best_found; /* [num_bins], the distribution of the best */
    double best_off;    /* its distance from the target */
    double length;      /* of the longest move of a step, in 1/sqrt(N) */
    unsigned tries;
    ps_step_options options;
    size_t num;
    const ps_watch *watch;
} search;

static pspec_status create(search *s, ps_device *device, ps_error *error) {
    const size_t num_bins = s->num;
    PS_TRY(ps_step_pairs_create(&s->pairs, device, s->num, num_bins, error));
    PS_TRY(ps_step_curves_create(&s->curves, s->num, num_bins, s->options.smoothing, error));
    PS_TRY(PS_NEW(&s->counts, num_bins, "counts of pairs", error));
    PS_TRY(PS_NEW(&s->table, num_bins + 1, "forces over distances", error));
    PS_TRY(PS_NEW(&s->best_found, num_bins, "distributions of distances", error));
    PS_TRY(PS_NEW(&s->best, AXES * s->num, "points", error));
    PS_TRY(PS_NEW(&s->x, AXES * s->num, "points", error));
    return PS_NEW(&s->force, AXES * s->num, "forces", error);
}

static void destroy(search *s) {
    ps_step_pairs_destroy(&s->pairs);
    ps_step_curves_destroy(&s->curves);
    free(s->counts);
    free(s->table);
    free(s->best_found);
    free(s->best);
    free(s->x);
    free(s->force);
}

static void keep(search *s, double off) {
    memcpy(s->best, s->x, AXES * s->num * sizeof *s->x);
    memcpy(s->best_found, s->curves.found, s->curves.num_bins * sizeof *s->best_found);
    s->best_off = off;
    s->tries = 0;
}

static void go_back(search *s) {
    memcpy(s->x, s->best, AXES * s->num * sizeof *s->x);
    memcpy(s->curves.found, s->best_found, s->curves.num_bins * sizeof *s->best_found);
}

/* Points go on from where they are, or from the best. */
static void judge(search *s, double off) {
    if (off < s->best_off) {
        keep(s, off);
        return;
    }
    const bool is_worse = off > WORSE * s->best_off;
    s->tries++;
    if (is_worse || s->tries == MOST_TRIES) {
        s->length *= SHORTER;
        s->tries = 0;
    }
    if (is_worse) {
        go_back(s);
    }
}

static void move(search *s) {
    double most2 = 0;
    for (size_t i = 0; i < s->num; i++) {
        const double *const f = s->force + AXES * i;
        const double square = f[0] * f[0] + f[1] * f[1];
        most2 = square > most2 ? square : most2;
    }
    const double scale = most2 > 0 ? s->length / sqrt((double)s->num * most2) : 0;
    for (size_t k = 0; k < AXES * s->num; k++) {
        s->x[k] = ps_forces_wrap(s->x[k] + scale * s->force[k]);
    }
}

static pspec_status run(search *s, ps_step_outcome *outcome, ps_error *error) {
    while (s->length >= LAST_LENGTH && outcome->rounds < s->options.most_rounds) {
        PS_TRY(ps_watch_tell(s->watch, "sampler: step, moves of all points", outcome->rounds, 0,
                             NULL, error));
        PS_TRY(ps_step_pairs_count(&s->pairs, s->x, s->counts, s->watch, error));
        const double off = ps_step_curves_measure(&s->curves, s->counts);
        outcome->first = outcome->rounds == 0 ? off : outcome->first;
        judge(s, off);
        ps_step_curves_force(&s->curves, s->table);
        PS_TRY(ps_step_pairs_force(&s->pairs, s->x, s->table, s->force, s->watch, error));
        move(s);
        outcome->rounds++;
    }
    outcome->last = s->best_off;
    return PSPEC_OK;
}

pspec_status ps_step_make(size_t num, ps_step_options options, ps_random *random, ps_device *device,
                          const ps_watch *watch, double *points, ps_step_outcome *outcome,
                          ps_error *error) {
    search s = {.num = num,
                .options = options,
                .watch = watch,
                .length = FIRST_LENGTH,
                .best_off = HUGE_VAL};
    ps_step_outcome done = {0};
    if (num < PS_STEP_LEAST_POINTS || num > PS_STEP_MOST_POINTS) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%zu points: step blue noise has from %d to %d", num, PS_STEP_LEAST_POINTS,
                       PS_STEP_MOST_POINTS);
    }
    pspec_status status = create(&s, device, error);
    if (status == PSPEC_OK) {
        ps_random_fill_uniform(random, s.x, AXES * num);
        status = run(&s, &done, error);
    }
    if (status == PSPEC_OK) {
        memcpy(points, s.best, AXES * num * sizeof *points);
    }
    destroy(&s);
    if (outcome != NULL) {
        *outcome = done;
    }
    return status;
}

/* ---- the row --------------------------------------------------------------------------------- */

enum { ROUNDS };

/* Rounds grow like the fourth root of N, from 270 at 256 points to 550 at 4096; launches of a round
 * take 0.1 ms of one core, a pair 2.5 ns, what the host does in a round 0.2 us a point (an EPYC
 * with AVX-512, PoCL 3.1, 2026-11). A device is opened once for many sets. */
static double seconds(const ps_sampler_request *request) {
    const double num = (double)request->num_points;
    const double most = ps_sampler_number(request, ROUNDS);
    const double rounds = fmin(270 * sqrt(sqrt(num / 256)), most);
    return rounds * (1e-4 + num * (num / 2 * 2.5e-9 + 0.2e-6));
}

/* Points, forces and the best; counts, a table and four distributions; on the device and here. */
static double work_bytes(const ps_sampler_request *request) {
    const size_t num = request->num_points, numbers = 3 * AXES + 6;
    return ps_step_pairs_bytes(num, num) + (double)(numbers * num * sizeof(double));
}

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    ps_random random = ps_random_init(request->seed, PS_STREAM_COORDINATES, realization);
    ps_loan loan = {0};
    const unsigned rounds = (unsigned)ps_sampler_number(request, ROUNDS);
    pspec_status status = ps_loan_begin(&loan, request, false, error);
    if (status == PSPEC_OK) {
        status = ps_step_make(request->num_points, (ps_step_options){rounds, PS_STEP_SMOOTHING},
                              &random, loan.device, request->watch, points, NULL, error);
    }
    ps_loan_end(&loan);
    return status;
}

static pspec_status check_device(const ps_sampler_request *request, const char *selector,
                                 ps_error *error) {
    return ps_loan_check(request, selector, false, error);
}

const ps_sampler ps_sampler_step = {
    .name = "step",
    .summary = "blue noise whose spectrum is a step, on a device",
    .aliases = {"step-blue-noise"},
    .minimum_dimension = 2,
    .maximum_dimension = 2,
    .minimum_points = PS_STEP_LEAST_POINTS,
    .maximum_points = PS_STEP_MOST_POINTS,
    .parameters = {{"rounds", "10000",
                    "1 to 10000, moves of all points after which it ends with the best so far"}},
    .ranges = {{1, PS_STEP_MOST_ROUNDS, true}},
    .version = 2,
    .seconds = seconds,
    .work_bytes = work_bytes,
    .is_deterministic = ps_sampler_never,
    .check_device = check_device,
    .generate = generate,
};
