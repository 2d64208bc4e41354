/* How often does the planner choose well? For a grid of problems every engine that keeps the
 * tolerance is timed, alternating in one run, and the one that plan chose is compared with the
 * best.
 *
 *     bench_choice            ends with how many were within 1.3x of the best
 *     bench_choice D N K      only this shape, with a line for every engine that was timed
 *
 * Engines that plan thinks 30 times slower than its choice, or slower than a second, are not run.
 */
#include "bench.h"

#include "plan/choose.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { REPEATS = 3 };

typedef struct choice_problem {
    unsigned dimension;
    size_t num_points, num_realizations;
    int32_t k;
    double tolerance;
} choice_problem;

/* 8 + 24 + 8 shapes, each at 5 tolerances. */
static const struct {
    unsigned dimension;
    size_t num_points;
    int32_t k;
} shapes[] = {
    {1, 64, 100},     {1, 64, 2000},    {1, 1024, 100},    {1, 1024, 4000}, {1, 16384, 500},
    {1, 16384, 8192}, {1, 65536, 4000}, {1, 65536, 32768}, {2, 16, 8},      {2, 16, 64},
    {2, 64, 8},       {2, 64, 24},      {2, 64, 100},      {2, 256, 8},     {2, 256, 16},
    {2, 256, 32},     {2, 256, 80},     {2, 256, 200},     {2, 1024, 12},   {2, 1024, 24},
    {2, 1024, 48},    {2, 1024, 128},   {2, 1024, 300},    {2, 4096, 10},   {2, 4096, 32},
    {2, 4096, 64},    {2, 4096, 256},   {2, 16384, 20},    {2, 16384, 100}, {2, 16384, 512},
    {2, 200000, 40},  {2, 200000, 300}, {3, 64, 4},        {3, 64, 10},     {3, 512, 6},
    {3, 512, 16},     {3, 4096, 8},     {3, 4096, 16},     {3, 4096, 32},   {3, 65536, 12},
};
static const double tolerances[] = {1e-2, 1e-4, 1e-6, 1e-9, 1e-12};
enum {
    NUM_SHAPES = sizeof shapes / sizeof shapes[0],
    NUM_TOLERANCES = sizeof tolerances / sizeof tolerances[0]
};

static ps_problem as_problem(const choice_problem *what, const ps_frequencies *grid) {
    return (ps_problem){.frequencies = grid,
                        .num_points = what->num_points,
                        .num_realizations = what->num_realizations,
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
        BENCH_TRY(ps_frequencies_lattice(&own, what->dimension, what->k, false, error));
        bench_job_create(&all[num].job, candidate->engine, candidate->precision, what->tolerance,
                         device, own, what->num_points, what->num_realizations);
        bench_job_run(&all[num].job, &rows); /* builds kernels, touches memory */
        num++;
    }
    return num;
}

static void print_candidate(const ps_candidate *candidate, double seconds,
                            size_t num_realizations) {
    printf("  %-12s %-6s planned %10.2f measured %10.2f us\n", candidate->engine->name,
           ps_precision_name(candidate->precision),
           candidate->seconds / (double)num_realizations * 1e6,
           seconds / (double)num_realizations * 1e6);
}

/* Time of the choice over that of the best; 1 when nothing else is feasible. */
static double run_problem(const choice_problem *shape, ps_device *device, bool shows_all) {
    const ps_plan_constraints anything = {.precision = -1};
    ps_frequencies grid = {0};
    choice_problem what = *shape;
    ps_plan plan;
    timed all[PS_MAX_CANDIDATES];
    double best = HUGE_VAL;
    double chosen = HUGE_VAL;
    const char *best_name = "";
    BENCH_TRY(ps_frequencies_lattice(&grid, what.dimension, what.k, false, error));
    what.num_realizations = enough_realizations(&what, &grid, ps_device_get_limits(device));
    const ps_problem problem = as_problem(&what, &grid);
    BENCH_TRY(ps_plan_make(&plan, &problem, ps_device_get_limits(device), &anything, error));
    const size_t num = plan.chosen != NULL ? create_jobs(&plan, &what, device, all) : 0;
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        for (size_t i = 0; i < num; i++) {
            ps_rows rows = {0};
            all[i].seconds[repeat] = bench_job_run(&all[i].job, &rows);
        }
    }
    for (size_t i = 0; i < num; i++) {
        const double seconds = bench_median(all[i].seconds, REPEATS);
        best_name = seconds < best ? all[i].candidate->engine->name : best_name;
        best = fmin(best, seconds);
        chosen = all[i].candidate->is_chosen ? seconds : chosen;
        if (shows_all) {
            print_candidate(all[i].candidate, seconds, what.num_realizations);
        }
        bench_job_destroy(&all[i].job);
    }
    if (num > 0) {
        printf("%u %7zu %6d %.0e | %-12s %-6s %10.2f %10.2f | %-12s %6.2f\n", what.dimension,
               what.num_points, (int)what.k, what.tolerance, plan.chosen->engine->name,
               ps_precision_name(plan.chosen->precision),
               plan.chosen->seconds / (double)what.num_realizations * 1e6,
               chosen / (double)what.num_realizations * 1e6, best_name, chosen / best);
    }
    return num > 0 ? chosen / best : 1;
}

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

/* "D N K" of the command line, or all shapes. */
static bool is_wanted(size_t i_shape, char **wanted) {
    return wanted == NULL || (strtoul(wanted[0], NULL, 10) == shapes[i_shape].dimension &&
                              strtoul(wanted[1], NULL, 10) == shapes[i_shape].num_points &&
                              strtol(wanted[2], NULL, 10) == shapes[i_shape].k);
}

int main(int argc, char **argv) {
    const double good = 1.3;
    char **wanted = argc == 4 ? argv + 1 : NULL;
    ps_device *device = NULL;
    double ratios[NUM_SHAPES * NUM_TOLERANCES];
    size_t num_good = 0;
    size_t num = 0;
    BENCH_TRY(ps_device_open(&device, getenv("POINTSPEC_DEVICE"), false, error));
    printf("d N K tolerance | chosen, us/R planned and measured | best, times of it\n");
    for (size_t s = 0; s < NUM_SHAPES; s++) {
        for (size_t t = 0; is_wanted(s, wanted) && t < NUM_TOLERANCES; t++) {
            const choice_problem what = {.dimension = shapes[s].dimension,
                                         .num_points = shapes[s].num_points,
                                         .k = shapes[s].k,
                                         .tolerance = tolerances[t]};
            ratios[num] = run_problem(&what, device, wanted != NULL);
            num_good += ratios[num++] <= good;
            fflush(stdout);
        }
    }
    if (num == 0) {
        fprintf(stderr, "bench_choice: no such shape\n");
        return 1;
    }
    qsort(ratios, num, sizeof ratios[0], compare);
    printf("# of %zu problems %.1f %% within %.1fx of the best; median %.2f, 95th percentile %.2f, "
           "worst %.2f\n",
           num, 100.0 * (double)num_good / (double)num, good, ratios[num / 2],
           ratios[num * 95 / 100], ratios[num - 1]);
    ps_device_close(device);
    return 0;
}
