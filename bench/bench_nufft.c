/* Time and error of torus_nufft beside torus_direct, alternating in one run.
 *
 *     bench_nufft [CASE...]        a case is "N K R TOLERANCE single|double [DIMENSION]", two dimensions by default
 *
 * The machine may be shared: minimum and median of each, and the median of the ratios. The passes
 * are timed in a run of their own, with the profile of the device. Errors as in bench_torus.
 */
#include "bench.h"

#include "engines/engine.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const default_cases[] = {
    "256 32 2048 1e-3 single",  "256 32 2048 1e-6 single",   "256 32 1024 1e-9 double",
    "256 32 1024 1e-12 double", "1024 128 256 1e-3 single",  "1024 128 256 1e-6 single",
    "1024 128 128 1e-9 double", "1024 128 128 1e-12 double", "4096 64 256 1e-3 single",
    "4096 64 256 1e-6 single",  "4096 64 128 1e-9 double",   "4096 64 128 1e-12 double",
    "4096 256 64 1e-3 single",  "4096 256 64 1e-6 single",   "4096 256 32 1e-9 double",
    "4096 256 32 1e-12 double", "16384 512 32 1e-3 single",  "16384 512 32 1e-6 single",
    "16384 512 16 1e-9 double", "16384 512 16 1e-12 double",
};

enum { REPEATS = 5 };

typedef struct bench_case {
    size_t num_points, num_realizations;
    int k;
    double tolerance;
    ps_precision precision;
    unsigned dimension;
} bench_case;

static bool parse_case(const char *text, bench_case *out) {
    char precision[8];
    out->dimension = 2;
    const int num = sscanf(text, "%zu %d %zu %lf %7s %u", &out->num_points, &out->k,
                           &out->num_realizations, &out->tolerance, precision, &out->dimension);
    out->precision = strcmp(precision, "double") == 0 ? PS_DOUBLE : PS_SINGLE;
    return num >= 5;
}

static const char *why_not(const bench_case *what, ps_device *device) {
    ps_frequencies grid = {0};
    BENCH_TRY(ps_frequencies_lattice(&grid, what->dimension, what->k, false, error));
    const ps_problem problem = {.frequencies = &grid,
                                .num_points = what->num_points,
                                .num_realizations = what->num_realizations,
                                .tolerance = what->tolerance};
    const char *const why = bench_why_not(&ps_torus_nufft, what->precision, &problem, device);
    ps_frequencies_free(&grid);
    return why;
}

static void create(bench_job *job, const ps_engine *engine, const bench_case *what,
                   size_t num_realizations, ps_device *device) {
    ps_frequencies grid = {0};
    BENCH_TRY(ps_frequencies_lattice(&grid, what->dimension, what->k, false, error));
    bench_job_create(job, engine, what->precision, what->tolerance, device, grid, what->num_points,
                     num_realizations);
}

/* torus_direct takes so much longer for large grids that fewer realizations must do. */
static size_t fewer(const bench_case *what) {
    const double most_flops = 1e11;
    const double each = 2 * pow(2.0 * what->k, what->dimension) * (double)what->num_points;
    const double num = most_flops / each;
    return num < 2                                ? 2
           : num < (double)what->num_realizations ? (size_t)num
                                                  : what->num_realizations;
}

static void print_profile(ps_device *device, const bench_case *what) {
    size_t num_rows = 0;
    const ps_profile_row *rows = ps_device_profile(device, &num_rows);
    for (size_t i = 0; i < num_rows; i++) {
        printf("#   %-16s %8.2f us/R %8.1f GFLOP/s %8.1f GB/s\n", rows[i].kernel,
               rows[i].seconds / 2 / (double)what->num_realizations * 1e6,
               rows[i].flops / rows[i].seconds * 1e-9, rows[i].bytes / rows[i].seconds * 1e-9);
    }
}

static void profile(const bench_case *what) {
    ps_device *device = NULL;
    bench_job job;
    ps_rows rows = {0};
    BENCH_TRY(ps_device_open(&device, getenv("POINTSPEC_DEVICE"), true, error));
    create(&job, &ps_torus_nufft, what, what->num_realizations, device);
    bench_job_run(&job, &rows);
    bench_job_run(&job, &rows);
    print_profile(device, what);
    bench_job_destroy(&job);
    ps_device_close(device);
}

static void run_case(const char *text, ps_device *device) {
    bench_case what;
    bench_job fast;
    bench_job direct;
    ps_rows rows = {0};
    ps_text description = {0};
    double times[2][REPEATS];
    double ratios[REPEATS];
    if (!parse_case(text, &what)) {
        bench_die(text);
    }
    const char *const refusal = why_not(&what, device);
    if (refusal != NULL) {
        printf("%-28s %s\n", text, refusal);
        return;
    }
    create(&fast, &ps_torus_nufft, &what, what.num_realizations, device);
    create(&direct, &ps_torus_direct, &what, fewer(&what), device);
    bench_job_run(&fast, &rows); /* builds kernels, touches memory */
    bench_job_run(&direct, &rows);
    for (int i = 0; i < REPEATS; i++) {
        times[0][i] = bench_job_run(&fast, &rows) / (double)fast.num_realizations * 1e6;
        times[1][i] = bench_job_run(&direct, &rows) / (double)direct.num_realizations * 1e6;
        ratios[i] = times[1][i] / times[0][i];
    }
    const double medians[2] = {bench_median(times[0], REPEATS), bench_median(times[1], REPEATS)};
    fast.engine->describe(fast.state, &description);
    printf("%-28s %9.1f %9.1f %8.1e | %10.1f %10.1f %8.1e | %7.1f\n", text, times[0][0], medians[0],
           bench_job_error(&fast), times[1][0], medians[1], bench_job_error(&direct),
           bench_median(ratios, REPEATS));
    printf("#   %s batch=%zu\n", ps_text_string(&description), fast.batch);
    ps_text_free(&description);
    bench_job_destroy(&fast);
    bench_job_destroy(&direct);
    profile(&what);
    fflush(stdout);
}

int main(int argc, char **argv) {
    const size_t num_defaults = sizeof default_cases / sizeof default_cases[0];
    ps_device *device = NULL;
    if (bench_lists_cases(argc, argv, default_cases, num_defaults)) {
        return 0;
    }
    BENCH_TRY(ps_device_open(&device, getenv("POINTSPEC_DEVICE"), false, error));
    printf("%-28s %9s %9s %8s | %10s %10s %8s | %7s\n", "N K R tolerance", "min us/R", "median",
           "error", "direct us", "median", "error", "ratio");
    const int num = argc > 1 ? argc - 1 : (int)num_defaults;
    for (int i = 0; i < num; i++) {
        run_case(argc > 1 ? argv[i + 1] : default_cases[i], device);
    }
    ps_device_close(device);
    return 0;
}
