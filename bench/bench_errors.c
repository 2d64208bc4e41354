/* What standard errors cost: microseconds for a realization by the estimator, mean only and with
 * sums of squares, alternating in one run, for bins and every frequency.
 *
 *     bench_errors [CASE...]        a case is "DIMENSION N K R"
 *
 * The planner chooses engine and precision for a tolerance of 1e-6. Patterns are white and made
 * before; the clock runs from the first to the last of them, checks of coordinates included.
 * Medians of each, and of the ratios of neighbours. The error is that of |S| as in bench_torus.
 */
#include "bench.h"

#include "jobs/estimator.h"
#include "plan/choose.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const default_cases[] = {
    "2 256 32 2000",  "2 1024 128 400",   "2 4096 64 300", "2 4096 256 100",
    "2 16384 512 30", "1 65536 32768 20", "3 4096 32 50",
};

#define TOLERANCE 1e-6

enum { ROUNDS = 15, KINDS = 2 }; /* kinds: mean only, with standard errors */

typedef struct errors_bench {
    bench_job job; /* patterns, frequencies, error */
    ps_plan plan;
    ps_estimator *estimators[KINDS];
} errors_bench;

static void create_job(errors_bench *bench, const char *text, ps_device *device) {
    const ps_plan_constraints anything = {.precision = -1};
    unsigned dimension = 0;
    size_t num_points = 0;
    size_t num_realizations = 0;
    int k = 0;
    ps_frequencies grid = {0};
    if (sscanf(text, "%u %zu %d %zu", &dimension, &num_points, &k, &num_realizations) != 4) {
        bench_die(text);
    }
    BENCH_TRY(ps_frequencies_lattice(&grid, dimension, k, false, error));
    const ps_problem problem = {.frequencies = &grid,
                                .num_points = num_points,
                                .num_realizations = num_realizations,
                                .tolerance = TOLERANCE};
    BENCH_TRY(ps_plan_make(&bench->plan, &problem, ps_device_get_limits(device), &anything, error));
    BENCH_TRY(ps_plan_require(&bench->plan, &problem, error));
    const ps_candidate *chosen = bench->plan.chosen;
    if (!chosen->engine->needs_device) {
        bench_die("the plan has an engine without a device");
    }
    bench_job_create(&bench->job, chosen->engine, chosen->precision, TOLERANCE, device, grid,
                     num_points, num_realizations);
}

static void create_estimators(errors_bench *bench) {
    const bench_job *job = &bench->job;
    for (size_t kind = 0; kind < KINDS; kind++) {
        const ps_estimator_options options = {
            .problem = {.frequencies = &job->frequencies,
                        .num_points = job->num_points,
                        .num_realizations = job->num_realizations,
                        .tolerance = TOLERANCE},
            .engine = job->engine,
            .precision = job->precision,
            .batch = bench->plan.chosen->batch,
            .want_frequencies = true,
            .mean_only = kind == 0,
        };
        BENCH_TRY(ps_estimator_create(&bench->estimators[kind], &options, job->device, error));
    }
}

/* Microseconds for a realization. */
static double run(errors_bench *bench, size_t kind) {
    const double micro = 1e6;
    const bench_job *job = &bench->job;
    ps_estimator *estimator = bench->estimators[kind];
    ps_estimator_reset(estimator);
    BENCH_TRY(ps_device_finish(job->device, error));
    const double begin = bench_seconds();
    BENCH_TRY(ps_estimator_add(estimator, job->patterns, job->num_realizations, error));
    BENCH_TRY(ps_device_finish(job->device, error));
    return (bench_seconds() - begin) / (double)job->num_realizations * micro;
}

static void run_case(const char *text, ps_device *device) {
    errors_bench bench = {0};
    double times[KINDS][ROUNDS];
    double ratios[ROUNDS];
    create_job(&bench, text, device);
    create_estimators(&bench);
    for (size_t kind = 0; kind < KINDS; kind++) {
        run(&bench, kind); /* builds kernels, touches memory */
    }
    for (size_t i = 0; i < ROUNDS; i++) {
        for (size_t kind = 0; kind < KINDS; kind++) { /* each as often first as second */
            times[(kind + i) % KINDS][i] = run(&bench, (kind + i) % KINDS);
        }
        ratios[i] = times[1][i] / times[0][i];
    }
    printf("%-18s %-13s %-7s %11.2f %11.2f %7.3f %9.1e\n", text, bench.job.engine->name,
           ps_precision_name(bench.job.precision), bench_median(times[0], ROUNDS),
           bench_median(times[1], ROUNDS), bench_median(ratios, ROUNDS),
           bench_job_error(&bench.job));
    fflush(stdout);
    for (size_t kind = 0; kind < KINDS; kind++) {
        ps_estimator_destroy(bench.estimators[kind]);
    }
    bench_job_destroy(&bench.job);
}

int main(int argc, char **argv) {
    ps_device *device = NULL;
    BENCH_TRY(ps_device_open(&device, getenv("POINTSPEC_DEVICE"), false, error));
    printf("%-18s %-13s %-7s %11s %11s %7s %9s\n", "d N K R", "engine", "", "mean us/R",
           "errors us/R", "ratio", "error");
    const int num = argc > 1 ? argc - 1 : (int)(sizeof default_cases / sizeof default_cases[0]);
    for (int i = 0; i < num; i++) {
        run_case(argc > 1 ? argv[i + 1] : default_cases[i], device);
    }
    ps_device_close(device);
    return 0;
}
