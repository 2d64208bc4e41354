/* One table of what a device does: engines beside its measured peaks of arithmetic and of memory.
 *
 *     bench_device [CASE...]       a case is "DIMENSION N K R TOLERANCE single|double"; on a GPU R times 16
 *
 * Times are medians, from points in host memory to powers on the device; errors as in bench_torus.
 * GFLOP/s are of the operations that docs/engines/torus_nufft.md and docs/engines/torus_direct.md
 * count. GB/s are of the traffic that no method can do without: points read, powers written, once
 * each; `of peak` is its share of the bandwidth of a copy (probe/copy.cl, bytes read and written).
 * torus_direct gets fewer realizations where it is slow.
 */
#include "bench.h"

#include "engines/nufft/fft.h"
#include "engines/torus/nufft/layout.h"
#include "engines/engine.h"
#include "engines/torus/nufft/variant.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const default_cases[] = {
    "2 256 32 2048 1e-6 single",    "2 256 32 1024 1e-12 double", "2 1024 128 256 1e-6 single",
    "2 1024 128 128 1e-12 double",  "2 4096 64 256 1e-6 single",  "2 4096 64 128 1e-12 double",
    "2 4096 256 64 1e-6 single",    "2 4096 256 32 1e-12 double", "2 16384 512 32 1e-6 single",
    "2 16384 512 16 1e-12 double",  "2 65536 1024 4 1e-6 single", "2 65536 1024 4 1e-12 double",
    "1 65536 32768 16 1e-6 double", "3 4096 32 16 1e-6 single",
};

enum { REPEATS = 5, GPU_REALIZATIONS = 16 };

typedef struct device_case {
    unsigned dimension;
    size_t num_points, num_realizations;
    int k;
    double tolerance;
    ps_precision precision;
} device_case;

static device_case parse_case(const char *text, const ps_device_limits *limits) {
    device_case out = {0};
    char precision[8];
    if (sscanf(text, "%u %zu %d %zu %lf %7s", &out.dimension, &out.num_points, &out.k,
               &out.num_realizations, &out.tolerance, precision) != 6) {
        bench_die(text);
    }
    out.precision = strcmp(precision, "double") == 0 ? PS_DOUBLE : PS_SINGLE;
    out.num_realizations *= limits->is_gpu ? GPU_REALIZATIONS : 1;
    return out;
}

/* ---- counted work ------------------------------------------------------------------------ */

static double direct_flops(const device_case *what, const bench_job *job) {
    const double k1 = what->k + 1.0;
    const double frequencies = (double)job->frequencies.num;
    return (double)what->num_points * (what->dimension == 2 ? 8 * k1 * k1 : 4 * frequencies);
}

/* Of one realization: spreading, then the transforms of all tiles. */
static double nufft_flops(const device_case *what, const bench_job *job) {
    const ps_problem problem = {.frequencies = &job->frequencies,
                                .num_points = what->num_points,
                                .num_realizations = what->num_realizations,
                                .tolerance = what->tolerance};
    const ps_nufft_layout layout =
        ps_nufft_layout_make(&problem, ps_device_get_limits(job->device), what->precision);
    const ps_nufft_choice *choice = &layout.choice;
    const double sums = (double)layout.num_tiles * layout.lanes;
    unsigned num = 0;
    const ps_nufft_axis *axes = ps_nufft_last_axes(choice, &num);
    const ps_nufft_axis *last = &axes[num - 1];
    const double rows = num == 2 ? axes[0].n : 1;
    const double columns = num == 2 ? 2.0 * last->max_frequency + 1 : 0;
    double spread = 2 * (double)what->num_points;
    if (choice->variant->is_gridded) { /* real numbers, and a real transform along axis 0 */
        for (unsigned i = 0; i < choice->num_axes; i++) {
            spread *= choice->axes[i].window.width;
        }
        spread += rows * last->n * ps_fft_flops(choice->axes[0].n) / 2;
    } else {
        spread *= (num == 2 ? axes[0].window.width : 1) * sums * (2.0 * last->window.width + 4);
    }
    return spread + sums * (rows * ps_fft_flops(last->n) +
                            (num == 2 ? columns * ps_fft_flops(axes[0].n) : 0));
}

static double least_bytes(const device_case *what, const bench_job *job) {
    const double real_bytes = what->precision == PS_SINGLE ? sizeof(float) : sizeof(double);
    return (double)what->num_points * what->dimension * sizeof(double) +
           (double)job->frequencies.num * real_bytes;
}

/* ---- cases ------------------------------------------------------------------------------- */

/* torus_direct takes so much longer for large grids that fewer realizations must do. */
static size_t fewer(const device_case *what) {
    const double most_flops = 5e10;
    const double each = 4 * pow(2.0 * what->k + 1, what->dimension) / 2 * (double)what->num_points;
    const double num = fmax(2, most_flops / each);
    return num < (double)what->num_realizations ? (size_t)num : what->num_realizations;
}

static void run_engine(const char *text, const device_case *what, const ps_engine *engine,
                       ps_device *device, double bandwidth) {
    const bool is_direct = engine == &ps_torus_direct;
    bench_job job;
    ps_frequencies grid = {0};
    ps_rows rows = {0};
    double seconds[REPEATS];
    BENCH_TRY(ps_frequencies_lattice(&grid, what->dimension, what->k, false, error));
    const ps_problem problem = {.frequencies = &grid,
                                .num_points = what->num_points,
                                .num_realizations =
                                    is_direct ? fewer(what) : what->num_realizations,
                                .tolerance = what->tolerance};
    const char *const why_not = bench_why_not(engine, what->precision, &problem, device);
    if (why_not != NULL) {
        printf("# %s, %s: %s\n", text, engine->name, why_not);
        ps_frequencies_free(&grid);
        return;
    }
    bench_job_create_for(&job, engine, what->precision, &problem, device);
    bench_job_run(&job, &rows); /* builds kernels, touches memory */
    for (int i = 0; i < REPEATS; i++) {
        seconds[i] = bench_job_run(&job, &rows) / (double)job.num_realizations;
    }
    const double each = bench_median(seconds, REPEATS);
    const double flops = is_direct ? direct_flops(what, &job) : nufft_flops(what, &job);
    const double rate = least_bytes(what, &job) / each;
    printf("%-29s %-12s %7zu %11.2f %9.1e %9.1f %8.2f %8.4f\n", text, engine->name,
           job.num_realizations, each * 1e6, bench_job_error(&job), flops / each * 1e-9,
           rate * 1e-9, rate / bandwidth);
    fflush(stdout);
    bench_job_destroy(&job);
}

static void run_case(const char *text, ps_device *device, double bandwidth) {
    const ps_device_limits *limits = ps_device_get_limits(device);
    const device_case what = parse_case(text, limits);
    if (what.precision == PS_DOUBLE && !limits->has_fp64) {
        return;
    }
    run_engine(text, &what, &ps_torus_nufft, device, bandwidth);
    run_engine(text, &what, &ps_torus_direct, device, bandwidth);
}

int main(int argc, char **argv) {
    const size_t num_defaults = sizeof default_cases / sizeof default_cases[0];
    ps_device *device = NULL;
    if (bench_lists_cases(argc, argv, default_cases, num_defaults)) {
        return 0;
    }
    BENCH_TRY(ps_device_open(&device, getenv("POINTSPEC_DEVICE"), false, error));
    const ps_device_limits *limits = ps_device_get_limits(device);
    ps_figures peaks;
    BENCH_TRY(ps_device_peaks_measure(device, &peaks, error));
    printf("# device: %s (%s, driver %s), %u compute units\n", limits->name, limits->version,
           limits->driver, limits->compute_units);
    printf("# measured peaks: %.0f GFLOP/s single, %.0f GFLOP/s double, copy %.1f GB/s\n",
           peaks.flops[PS_SINGLE] * 1e-9, peaks.flops[PS_DOUBLE] * 1e-9, peaks.copied_bytes * 1e-9);
    printf("%-29s %-12s %7s %11s %9s %9s %8s %8s\n", "d N K R tolerance", "engine", "R", "us/R",
           "error", "GFLOP/s", "GB/s", "of peak");
    const int num = argc > 1 ? argc - 1 : (int)num_defaults;
    for (int i = 0; i < num; i++) {
        run_case(argc > 1 ? argv[i + 1] : default_cases[i], device, peaks.copied_bytes);
    }
    ps_device_close(device);
    return 0;
}
