/* Time, error, GFLOP/s and share of the measured peak of torus_direct, beside a plain C loop over
 * cosf and sinf as today's tools have it.
 *
 *     bench_torus [CASE...]        a case is "grid|list D N K R single|double", K frequencies of a list
 *
 * The engine, the peak and the plain loop alternate in one run; the machine may be shared, so
 * minimum and median are given, and shares and ratios are medians of those of each repeat. Errors
 * are measured against long double sums: root mean square of |S| - |S_referee| in units of sqrt(N),
 * as --tol counts them.
 */
#include "bench.h"

#include "engines/host/host_direct.h"
#include "engines/engine.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const default_cases[] = {
    "grid 2 256 32 2048 single",   "grid 2 1024 32 512 single",  "grid 2 1024 128 128 single",
    "grid 2 4096 64 64 single",    "grid 2 4096 256 16 single",  "grid 2 16384 512 2 single",
    "grid 1 65536 32768 1 single", "grid 3 4096 32 4 single",    "grid 4 1024 8 16 single",
    "grid 2 1024 32 256 double",   "grid 2 1024 128 64 double",  "grid 2 4096 256 8 double",
    "list 2 4096 4096 32 single",  "list 3 4096 4096 32 single", "list 2 1000000 64 1 single",
    "list 6 4096 4096 32 single",  "list 2 4096 4096 16 double",
};

enum { REPEATS = 9 };

typedef struct bench_case {
    bool is_grid;
    unsigned dimension;
    size_t num_points, size, num_realizations; /* size: K, or length of the list */
    ps_precision precision;
} bench_case;

static bool parse_case(const char *text, bench_case *out) {
    char kind[8];
    char precision[8];
    const int num = sscanf(text, "%7s %u %zu %zu %zu %7s", kind, &out->dimension, &out->num_points,
                           &out->size, &out->num_realizations, precision);
    out->is_grid = strcmp(kind, "grid") == 0;
    out->precision = strcmp(precision, "double") == 0 ? PS_DOUBLE : PS_SINGLE;
    return num == 6 && (out->is_grid || strcmp(kind, "list") == 0);
}

/* A list of distinct-looking frequencies up to 1e6, as nobody's grid. */
static ps_frequencies make_frequencies(const bench_case *what) {
    ps_frequencies set = {0};
    if (what->is_grid) {
        BENCH_TRY(ps_frequencies_lattice(&set, what->dimension, (int32_t)what->size, false, error));
        return set;
    }
    const double reach = 1e6;
    const size_t count = what->size * what->dimension;
    double *uniform = bench_uniform(count, count);
    int32_t *vectors = calloc(count, sizeof(int32_t));
    for (size_t i = 0; i < count; i++) {
        vectors[i] = (int32_t)((2 * uniform[i] - 1) * reach);
    }
    free(uniform);
    BENCH_TRY(ps_frequencies_list(&set, what->dimension, what->size, vectors, error));
    return set;
}

/* One thread, float phases: what a C programmer writes first. Returns seconds per (point,
 * frequency) and the error of |S| in units of sqrt(N). */
static double plain_loop(const bench_job *job, double *error_out) {
    enum { PAIRS = 1 << 21, MOST = 64 };
    const float two_pi = 6.2831853f;
    const unsigned dimension = job->frequencies.dimension;
    const size_t n = job->num_points;
    size_t num = PAIRS / n;
    num = num < 1 ? 1 : num > MOST ? MOST : num;
    num = num < job->frequencies.num ? num : job->frequencies.num;
    float *x = calloc(n * dimension, sizeof(float));
    double *found = calloc(num, sizeof(double));
    for (size_t i = 0; i < n * dimension; i++) {
        x[i] = (float)job->points[i];
    }
    const double begin = bench_seconds();
    for (size_t i = 0; i < num; i++) {
        const int32_t *k = job->frequencies.vectors + i * dimension;
        float re = 0;
        float im = 0;
        for (size_t j = 0; j < n; j++) {
            float phase = 0;
            for (unsigned axis = 0; axis < dimension; axis++) {
                phase += (float)k[axis] * x[j * dimension + axis];
            }
            re += cosf(two_pi * phase);
            im -= sinf(two_pi * phase);
        }
        found[i] = hypot(re, im);
    }
    const double seconds = bench_seconds() - begin;
    double squares = 0;
    for (size_t i = 0; i < num; i++) {
        long double re = 0;
        long double im = 0;
        ps_host_sum(&job->patterns[0], job->frequencies.vectors + i * dimension, &re, &im);
        squares += pow(found[i] - (double)hypotl(re, im), 2);
    }
    *error_out = sqrt(squares / (double)num / (double)n);
    free(x);
    free(found);
    return seconds / ((double)num * (double)n);
}

/* Arithmetic as docs/developer/performance.md counts it: 8 (K+1)^2 per point in two dimensions, 4
 * per half-lattice frequency in others; a list by what its kernel does. */
static double counted_flops(const bench_case *what, const bench_job *job) {
    const double points = (double)what->num_points * (double)what->num_realizations;
    const double k1 = (double)what->size + 1;
    if (!what->is_grid) {
        const double per_pair =
            3.0 * what->dimension + 9 + (what->precision == PS_SINGLE ? 22 : 34);
        return points * (double)what->size * per_pair;
    }
    return points * (what->dimension == 2 ? 8 * k1 * k1 : 4 * (double)job->frequencies.num);
}

typedef struct timing {
    double seconds[REPEATS], share[REPEATS], ratio[REPEATS];
    double plain_seconds, plain_error; /* of a (point, frequency) pair */
} timing;

static timing measure(const bench_case *what, bench_job *job, ps_peak *peak) {
    timing out = {0};
    ps_rows rows = {0};
    const double pairs =
        (double)job->frequencies.num * (double)what->num_points * (double)what->num_realizations;
    bench_job_run(job, &rows); /* builds kernels, touches memory */
    for (int i = 0; i < REPEATS; i++) {
        const double before = bench_peak_run(peak);
        out.seconds[i] = bench_job_run(job, &rows);
        const double after = bench_peak_run(peak);
        out.share[i] = counted_flops(what, job) / out.seconds[i] / (0.5 * (before + after));
        out.plain_seconds = plain_loop(job, &out.plain_error);
        out.ratio[i] = out.plain_seconds * pairs / out.seconds[i];
    }
    return out;
}

static void run_case(const char *text, ps_device *device, ps_peak *peaks) {
    bench_case what;
    bench_job job;
    if (!parse_case(text, &what)) {
        bench_die(text);
    }
    bench_job_create(&job, &ps_torus_direct, what.precision, 1, device, make_frequencies(&what),
                     what.num_points, what.num_realizations);
    timing found = measure(&what, &job, &peaks[what.precision]);
    const double median = bench_median(found.seconds, REPEATS);
    const double realizations = (double)what.num_realizations;
    const double cores = ps_device_get_limits(device)->compute_units;
    const double pairs = (double)job.frequencies.num * (double)what.num_points * realizations;
    printf("%-30s %10.3f %10.3f %8.1e %8.1f %6.2f %9.4f | %8.2f %8.1e %8.0f\n", text,
           found.seconds[0] / realizations * 1e3, median / realizations * 1e3,
           bench_job_error(&job), counted_flops(&what, &job) / median * 1e-9,
           bench_median(found.share, REPEATS), median / pairs * 1e9 * cores,
           found.plain_seconds * 1e9, found.plain_error, bench_median(found.ratio, REPEATS));
    fflush(stdout);
    bench_job_destroy(&job);
}

int main(int argc, char **argv) {
    const size_t num_defaults = sizeof default_cases / sizeof default_cases[0];
    ps_device *device = NULL;
    if (bench_lists_cases(argc, argv, default_cases, num_defaults)) {
        return 0;
    }
    BENCH_TRY(ps_device_open(&device, getenv("POINTSPEC_DEVICE"), false, error));
    const ps_device_limits *limits = ps_device_get_limits(device);
    ps_peak peaks[2];
    BENCH_TRY(ps_peak_create(&peaks[PS_SINGLE], device, PS_SINGLE, error));
    BENCH_TRY(
        ps_peak_create(&peaks[PS_DOUBLE], device, limits->has_fp64 ? PS_DOUBLE : PS_SINGLE, error));
    printf("# device: %s (%s), %u compute units\n", limits->name, limits->version,
           limits->compute_units);
    printf("# measured peak now: %.0f GFLOP/s single, %.0f GFLOP/s double; measured again beside "
           "every "
           "run\n",
           bench_peak_run(&peaks[PS_SINGLE]) * 1e-9, bench_peak_run(&peaks[PS_DOUBLE]) * 1e-9);
    printf("# plain loop: cosf and sinf in C, one thread, no fixed-point phases; ratio of medians "
           "to all "
           "cores of the device\n");
    printf("%-30s %10s %10s %8s %8s %6s %9s | %8s %8s %8s\n", "case", "min ms/R", "median", "error",
           "GFLOP/s", "peak", "ns/pair/c", "plain ns", "error", "ratio");
    const int num = argc > 1 ? argc - 1 : (int)num_defaults;
    for (int i = 0; i < num; i++) {
        run_case(argc > 1 ? argv[i + 1] : default_cases[i], device, peaks);
    }
    ps_peak_destroy(&peaks[PS_SINGLE]);
    ps_peak_destroy(&peaks[PS_DOUBLE]);
    ps_device_close(device);
    return 0;
}
