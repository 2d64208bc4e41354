/* Measures the rates of host/plan/cost_model.c and the cycles of host/engines/nufft/cycles.c on
 * this machine and prints them as they stand there. Rates are shares of what those cycles allow:
 * new cycles first, then the rates again.
 *
 * Run on a quiet machine; a busy neighbour makes everything up to twice as slow. The best of
 * several runs is taken, since nothing but disturbance makes a run slower.
 */
#include "bench.h"
#include "cycles.h"

#include "engines/host/host_direct.h"
#include "engines/engine.h"
#include "plan/cost_model.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { REPEATS = 9 };

static double best_run(bench_job *job) {
    ps_rows rows = {0};
    double best = HUGE_VAL;
    bench_job_run(job, &rows);
    for (int i = 0; i < REPEATS; i++) {
        best = fmin(best, bench_job_run(job, &rows));
    }
    return best;
}

/* Of fast transforms; it hardly matters to their rate. */
#define TOLERANCE 1e-6

static double measure(ps_device *device, const ps_engine *engine, ps_precision precision, int32_t k,
                      size_t num_points, size_t num_realizations, ps_work *work) {
    ps_frequencies grid = {0};
    bench_job job;
    BENCH_TRY(ps_frequencies_lattice(&grid, 2, k, false, error));
    bench_job_create(&job, engine, precision, TOLERANCE, device, grid, num_points,
                     num_realizations);
    const ps_problem problem = {.frequencies = &job.frequencies,
                                .num_points = num_points,
                                .num_realizations = num_realizations,
                                .tolerance = TOLERANCE};
    *work = engine->survey(&problem, ps_device_get_limits(device), precision).work;
    const double seconds = best_run(&job);
    bench_job_destroy(&job);
    return seconds;
}

/* Small and large grids: the geometric mean of what the cycles of host/engines/nufft/cycles.c are
 * worth. */
static double transform_share(ps_device *device, ps_precision precision) {
    const double peak = ps_cost_nominal_flops(ps_device_get_limits(device), precision);
    ps_work small;
    ps_work large;
    const double a = measure(device, &ps_torus_nufft, precision, 32, 256, 1024, &small);
    const double b = measure(device, &ps_torus_nufft, precision, 256, 4096, 32, &large);
    return sqrt(small.transform_flops / (a * peak) * large.transform_flops / (b * peak));
}

/* Points on a sphere's north cap would do as well: the time depends on their number. */
static double harmonics_per_flop(ps_device *device, ps_precision precision) {
    enum { DEGREE = 64, POINTS = 256, REALIZATIONS = 1024 };
    ps_frequencies degrees = {0};
    bench_job job;
    BENCH_TRY(ps_frequencies_degrees(&degrees, DEGREE, false, error));
    bench_job_create(&job, &ps_sphere_direct, precision, TOLERANCE, device, degrees, POINTS,
                     REALIZATIONS);
    const ps_problem problem = {.frequencies = &job.frequencies,
                                .num_points = POINTS,
                                .num_realizations = REALIZATIONS,
                                .tolerance = TOLERANCE};
    const ps_device_limits *limits = ps_device_get_limits(device);
    const double harmonics = ps_sphere_direct.survey(&problem, limits, precision).work.harmonics;
    const double rate = harmonics / best_run(&job);
    bench_job_destroy(&job);
    return rate / ps_cost_nominal_flops(limits, precision);
}

/* Two grids, one where tables weigh most and one where products do: two equations for two rates. */
static void calibrate(ps_device *device, ps_precision precision) {
    ps_work small;
    ps_work large;
    const double a = measure(device, &ps_torus_direct, precision, 16, 1024, 1024, &small);
    const double b = measure(device, &ps_torus_direct, precision, 256, 4096, 8, &large);
    const double peak = ps_cost_nominal_flops(ps_device_get_limits(device), precision);
    const double determinant =
        small.phases * large.product_flops - large.phases * small.product_flops;
    const double phase = (a * large.product_flops - b * small.product_flops) / determinant;
    const double product = (small.phases * b - large.phases * a) / determinant;
    printf("    [%s] = {%.3g, %.3g, %.3g, %.3g},\n",
           precision == PS_SINGLE ? "PS_SINGLE" : "PS_DOUBLE", 1 / (phase * peak),
           1 / (product * peak), transform_share(device, precision),
           harmonics_per_flop(device, precision));
}

static double host_seconds_per_phase(void) {
    enum { TERMS = 1 << 18 };
    double *points = bench_uniform((size_t)2 * TERMS, 1);
    const pspec_pattern pattern = {2, TERMS, points, NULL};
    const int32_t k[2] = {17, -5};
    double best = HUGE_VAL;
    for (int i = 0; i < REPEATS; i++) {
        long double re = 0;
        long double im = 0;
        const double begin = bench_seconds();
        ps_host_sum(&pattern, k, &re, &im);
        best = fmin(best, bench_seconds() - begin);
    }
    free(points);
    return best / TERMS;
}

int main(void) {
    ps_device *device = NULL;
    BENCH_TRY(ps_device_open(&device, getenv("POINTSPEC_DEVICE"), false, error));
    const ps_device_limits *limits = ps_device_get_limits(device);
    printf("/* %s, %u compute units at %u MHz, %s */\n", limits->name, limits->compute_units,
           limits->clock_mhz, limits->version);
    printf("device_rates (phases_per_flop, product_share, transform_share, harmonics_per_flop):\n");
    calibrate(device, PS_SINGLE);
    if (limits->has_fp64) {
        calibrate(device, PS_DOUBLE);
    }
    printf("host_seconds_per_phase = %.2g\n", host_seconds_per_phase());
    ps_device_close(device);
    bench_calibrate_cycles(getenv("POINTSPEC_DEVICE"));
    return 0;
}
