/* How often does the planner choose well? For a grid of problems every engine that keeps the
 * tolerance is timed, alternating in one run, and the one that plan chose is compared with the
 * best.
 *
 *     bench_choice            ends with how many were within 1.3x of the best, and which was best how
 *                             often
 *     bench_choice D N K      only this shape, with a line for every engine that was timed; D is 1, 2
 *                             or 3, sphere or pairs, and K the largest degree there
 *
 * Engines that plan thinks 30 times slower than its choice, or slower than a second, are not run.
 */
#include "bench.h"

#include "engines/error_units.h"
#include "plan/choose.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { REPEATS = 3 };

/* What is asked: spectra of the torus in so many dimensions, of the sphere, or sums over pairs. */
typedef enum domain { LINE = 1, PLANE = 2, SPACE = 3, SPHERE, PAIRS, NUM_DOMAINS } domain;
static const char *const domain_names[NUM_DOMAINS] = {"", "1", "2", "3", "sphere", "pairs"};

typedef struct choice_problem {
    domain domain;
    size_t num_points, num_realizations;
    int32_t k; /* or the largest degree */
    double tolerance;
} choice_problem;

/* 8 + 25 + 9 shapes of the torus, 15 of the sphere and 8 of pairs, each at 5 tolerances: of the
 * largest a single set. */
static const struct {
    domain domain;
    size_t num_points;
    int32_t k;
} shapes[] = {
    {LINE, 64, 100},       {LINE, 64, 2000},    {LINE, 1024, 100},   {LINE, 1024, 4000},
    {LINE, 16384, 500},    {LINE, 16384, 8192}, {LINE, 65536, 4000}, {LINE, 65536, 32768},
    {PLANE, 16, 8},        {PLANE, 16, 64},     {PLANE, 64, 8},      {PLANE, 64, 24},
    {PLANE, 64, 100},      {PLANE, 256, 8},     {PLANE, 256, 16},    {PLANE, 256, 32},
    {PLANE, 256, 80},      {PLANE, 256, 200},   {PLANE, 1024, 12},   {PLANE, 1024, 24},
    {PLANE, 1024, 48},     {PLANE, 1024, 128},  {PLANE, 1024, 300},  {PLANE, 4096, 10},
    {PLANE, 4096, 32},     {PLANE, 4096, 64},   {PLANE, 4096, 256},  {PLANE, 16384, 20},
    {PLANE, 16384, 100},   {PLANE, 16384, 512}, {PLANE, 200000, 40}, {PLANE, 200000, 300},
    {PLANE, 2000000, 400}, {SPACE, 300000, 40}, {SPACE, 64, 4},      {SPACE, 64, 10},
    {SPACE, 512, 6},       {SPACE, 512, 16},    {SPACE, 4096, 8},    {SPACE, 4096, 16},
    {SPACE, 4096, 32},     {SPACE, 65536, 12},  {SPHERE, 16, 16},    {SPHERE, 16, 256},
    {SPHERE, 64, 8},       {SPHERE, 64, 32},    {SPHERE, 64, 600},   {SPHERE, 256, 8},
    {SPHERE, 256, 32},     {SPHERE, 256, 100},  {SPHERE, 1024, 4},   {SPHERE, 1024, 32},
    {SPHERE, 1024, 128},   {SPHERE, 4096, 64},  {SPHERE, 4096, 256}, {SPHERE, 65536, 32},
    {SPHERE, 4096, 1200},  {PAIRS, 16, 16},     {PAIRS, 16, 256},    {PAIRS, 64, 32},
    {PAIRS, 64, 256},      {PAIRS, 256, 32},    {PAIRS, 256, 100},   {PAIRS, 1024, 128},
    {PAIRS, 4096, 64},
};
static const double tolerances[] = {1e-2, 1e-4, 1e-6, 1e-9, 1e-12};
enum {
    NUM_SHAPES = sizeof shapes / sizeof shapes[0],
    NUM_TOLERANCES = sizeof tolerances / sizeof tolerances[0]
};

static void make_frequencies(ps_frequencies *out, const choice_problem *what) {
    if (what->domain >= SPHERE) {
        BENCH_TRY(ps_frequencies_degrees(out, what->k, false, error));
    } else {
        BENCH_TRY(ps_frequencies_lattice(out, (unsigned)what->domain, what->k, false, error));
    }
}

static ps_problem as_problem(const choice_problem *what, const ps_frequencies *frequencies) {
    return (ps_problem){.frequencies = frequencies,
                        .num_points = what->num_points,
                        .num_realizations = what->num_realizations,
                        .measure = what->domain == PAIRS ? PS_OF_PAIR_SUMS : PS_OF_AMPLITUDES,
                        .tolerance = what->tolerance};
}

/* As many realizations as take about as long as timing can tell. */
static size_t enough_realizations(const choice_problem *what, const ps_frequencies *grid,
                                  const ps_device_limits *limits) {
    const double wanted = 0.02;
    const ps_plan_constraints anything = {.precision = -1};
    choice_problem probe = *what;
    ps_plan plan;
    probe.num_realizations = 256;
    const ps_problem problem = as_problem(&probe, grid);
    BENCH_TRY(ps_plan_make(&plan, &problem, limits, &anything, error));
    if (plan.chosen == NULL) {
        return 1;
    }
    const double each = plan.chosen->seconds / (double)probe.num_realizations;
    const double num = ceil(wanted / each);
    return num < 1 ? 1 : num > 2048 ? 2048 : (size_t)num;
}

typedef struct timed {
    const ps_candidate *candidate;
    bench_job job;
    double seconds[REPEATS];
} timed;

static size_t create_jobs(const ps_plan *plan, const choice_problem *what, ps_device *device,
                          timed *all) {
    const double hopeless = 30;
    const double too_long = 1;
    size_t num = 0;
    for (size_t i = 0; i < plan->num_candidates; i++) {
        const ps_candidate *candidate = &plan->candidates[i];
        if (!candidate->is_feasible || !candidate->engine->needs_device ||
            (!candidate->is_chosen && (candidate->seconds > hopeless * plan->chosen->seconds ||
                                       candidate->seconds > too_long))) {
            continue;
        }
        ps_frequencies own = {0};
        ps_rows rows = {0};
        all[num].candidate = candidate;
        make_frequencies(&own, what);
        const ps_problem asked = as_problem(what, &own);
        const ps_problem problem = ps_engine_problem(candidate->engine, &asked);
        bench_job_create_for(&all[num].job, candidate->engine, candidate->precision, &problem,
                             device);
        bench_job_run(&all[num].job, &rows); /* builds kernels, touches memory */
        num++;
    }
    return num;
}

static void print_candidate(const ps_candidate *candidate, double seconds,
                            size_t num_realizations) {
    printf("  %-15s %-6s planned %10.2f measured %10.2f us\n", candidate->engine->name,
           ps_precision_name(candidate->precision),
           candidate->seconds / (double)num_realizations * 1e6,
           seconds / (double)num_realizations * 1e6);
}

/* What became of a problem; best NULL: nothing is feasible. */
typedef struct outcome {
    const ps_engine *best;
    double chosen, fastest; /* seconds */
} outcome;

static outcome compare_engines(const ps_plan *plan, const choice_problem *what, ps_device *device,
                               bool shows_all) {
    timed all[PS_MAX_CANDIDATES];
    outcome out = {NULL, HUGE_VAL, HUGE_VAL};
    const size_t num = plan->chosen != NULL ? create_jobs(plan, what, device, all) : 0;
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        for (size_t i = 0; i < num; i++) {
            ps_rows rows = {0};
            all[i].seconds[repeat] = bench_job_run(&all[i].job, &rows);
        }
    }
    for (size_t i = 0; i < num; i++) {
        const double seconds = bench_median(all[i].seconds, REPEATS);
        out.best = seconds < out.fastest ? all[i].candidate->engine : out.best;
        out.fastest = fmin(out.fastest, seconds);
        out.chosen = all[i].candidate->is_chosen ? seconds : out.chosen;
        if (shows_all) {
            print_candidate(all[i].candidate, seconds, what->num_realizations);
        }
        bench_job_destroy(&all[i].job);
    }
    return out;
}

static outcome run_problem(const choice_problem *shape, ps_device *device, bool shows_all) {
    const ps_plan_constraints anything = {.precision = -1};
    const ps_device_limits *limits = ps_device_get_limits(device);
    ps_frequencies frequencies = {0};
    choice_problem what = *shape;
    ps_plan plan;
    make_frequencies(&frequencies, &what);
    what.num_realizations = enough_realizations(&what, &frequencies, limits);
    const ps_problem problem = as_problem(&what, &frequencies);
    BENCH_TRY(ps_plan_make(&plan, &problem, limits, &anything, error));
    const outcome out = compare_engines(&plan, &what, device, shows_all);
    if (out.best != NULL) {
        const double micro = 1e6 / (double)what.num_realizations;
        printf("%-6s %7zu %6d %.0e | %-15s %-6s %10.2f %10.2f | %-15s %6.2f\n",
               domain_names[what.domain], what.num_points, (int)what.k, what.tolerance,
               plan.chosen->engine->name, ps_precision_name(plan.chosen->precision),
               plan.chosen->seconds * micro, out.chosen * micro, out.best->name,
               out.chosen / out.fastest);
    }
    ps_frequencies_free(&frequencies);
    return out;
}

/* ---- all problems -------------------------------------------------------------------------- */

typedef struct tally {
    double ratios[NUM_SHAPES * NUM_TOLERANCES]; /* time of the choice over that of the best */
    const ps_engine *best[NUM_SHAPES * NUM_TOLERANCES];
    size_t num;
} tally;

static void count(tally *sum, const outcome *one) {
    if (one->best != NULL) {
        sum->best[sum->num] = one->best;
        sum->ratios[sum->num++] = one->chosen / one->fastest;
    }
}

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

/* "D N K" of the command line, or all shapes. */
static bool is_wanted(size_t i_shape, char **wanted) {
    return wanted == NULL || (strcmp(wanted[0], domain_names[shapes[i_shape].domain]) == 0 &&
                              strtoul(wanted[1], NULL, 10) == shapes[i_shape].num_points &&
                              strtol(wanted[2], NULL, 10) == shapes[i_shape].k);
}

static void print_sum(tally *sum) {
    const double good = 1.3;
    size_t num_good = 0;
    for (size_t i = 0; i < sum->num; i++) {
        num_good += sum->ratios[i] <= good;
    }
    qsort(sum->ratios, sum->num, sizeof sum->ratios[0], compare);
    printf("# of %zu problems %.1f %% within %.1fx of the best; median %.2f, 95th percentile %.2f, "
           "worst %.2f\n",
           sum->num, 100.0 * (double)num_good / (double)sum->num, good, sum->ratios[sum->num / 2],
           sum->ratios[sum->num * 95 / 100], sum->ratios[sum->num - 1]);
    printf("# best:");
    for (size_t e = 0; ps_engines[e] != NULL; e++) {
        size_t num = 0;
        for (size_t i = 0; i < sum->num; i++) {
            num += sum->best[i] == ps_engines[e];
        }
        if (ps_engines[e]->needs_device) {
            printf(" %s %zu", ps_engines[e]->name, num);
        }
    }
    printf("\n");
}

int main(int argc, char **argv) {
    static tally all;
    char **wanted = argc == 4 ? argv + 1 : NULL;
    ps_device *device = NULL;
    BENCH_TRY(ps_device_open(&device, getenv("POINTSPEC_DEVICE"), false, error));
    printf("domain N K tolerance | chosen, us/R planned and measured | best, times of it\n");
    for (size_t s = 0; s < NUM_SHAPES; s++) {
        for (size_t t = 0; is_wanted(s, wanted) && t < NUM_TOLERANCES; t++) {
            const choice_problem what = {.domain = shapes[s].domain,
                                         .num_points = shapes[s].num_points,
                                         .k = shapes[s].k,
                                         .tolerance = tolerances[t]};
            const outcome one = run_problem(&what, device, wanted != NULL);
            count(&all, &one);
            fflush(stdout);
        }
    }
    if (all.num == 0) {
        fprintf(stderr, "bench_choice: no such shape, or no engine for it\n");
        return 1;
    }
    print_sum(&all);
    ps_device_close(device);
    return 0;
}
