/* What a call of pspec_plan_run costs: microseconds for each pattern of N points, beside the engine
 * alone.
 *
 *     bench_library [POINTS [MAX_FREQUENCY]]     default 1 point, K = 4
 *
 * "calls of" is the number of patterns handed over at a time; "overhead" is what the library adds
 * to the engine's own time for a full batch (which includes nothing of checking, copying or
 * averaging). The bits of all spectra of an engine are compared.
 */
#include "bench.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DIMENSION = 2, MOST_PATTERNS = 20000, MOST_WORK = 1 << 21, REPEATS = 5 };

typedef struct library_case {
    const char *engine, *precision;
} library_case;

static const library_case cases[] = {
    {"torus_direct", "single"}, {"torus_direct", "double"}, {"host_direct", "extended"}};

static const size_t call_sizes[] = {1, 10, 100, MOST_PATTERNS};

typedef struct library_bench {
    pspec_context *context;
    pspec_plan *plan;
    pspec_pattern *patterns;
    double *points;
    size_t num_points, num_patterns;
    int32_t max_frequency;
    pspec_spectrum *first; /* of this engine */
} library_bench;

static void try_call(const library_bench *bench, pspec_status status) {
    if (status != PSPEC_OK) {
        bench_die(pspec_context_message(bench->context));
    }
}

/* As many patterns as the referee does in about a second. */
static size_t count_patterns(const library_bench *bench) {
    const size_t width = 2 * (size_t)bench->max_frequency + 1;
    const size_t count = MOST_WORK / (bench->num_points * width * width);
    return count > MOST_PATTERNS ? MOST_PATTERNS : count > 0 ? count : 1;
}

static void make_patterns(library_bench *bench) {
    bench->num_patterns = count_patterns(bench);
    const size_t stride = bench->num_points * DIMENSION;
    bench->points = bench_uniform(bench->num_patterns * stride, 1);
    bench->patterns = calloc(bench->num_patterns, sizeof *bench->patterns);
    for (size_t r = 0; r < bench->num_patterns; r++) {
        bench->patterns[r] =
            (pspec_pattern){DIMENSION, bench->num_points, bench->points + r * stride, NULL};
    }
}

static const ps_engine *find_engine(const char *name) {
    const ps_engine *const *engine = ps_engines;
    while (*engine != NULL && strcmp((*engine)->name, name) != 0) {
        engine++;
    }
    return *engine;
}

/* Seconds per pattern of the engine alone, in full batches. */
static double time_engine(const library_bench *bench, const library_case *which) {
    static const char *const precisions[] = {"single", "double", "extended"};
    ps_device *device = NULL;
    ps_frequencies set = {0};
    ps_rows rows = {0};
    bench_job job;
    int precision = 0;
    double seconds[REPEATS];
    while (strcmp(precisions[precision], which->precision) != 0) {
        precision++;
    }
    BENCH_TRY(ps_device_open(&device, getenv("POINTSPEC_DEVICE"), false, error));
    BENCH_TRY(ps_frequencies_lattice(&set, DIMENSION, bench->max_frequency, false, error));
    bench_job_create(&job, find_engine(which->engine), (ps_precision)precision, 1, device, set,
                     bench->num_points, bench->num_patterns);
    for (int i = 0; i < REPEATS; i++) {
        seconds[i] = bench_job_run(&job, &rows) / (double)bench->num_patterns;
    }
    bench_job_destroy(&job);
    ps_device_close(device);
    return bench_median(seconds, REPEATS);
}

/* Seconds per pattern of all of them in calls of `size`, the spectrum at the end included. */
static double time_calls(library_bench *bench, size_t size) {
    pspec_spectrum *spectrum = NULL;
    try_call(bench, pspec_plan_reset(bench->plan));
    const double begin = bench_seconds();
    for (size_t r = 0; r < bench->num_patterns; r += size) {
        const size_t rest = bench->num_patterns - r;
        try_call(bench,
                 pspec_plan_run(bench->plan, bench->patterns + r, rest < size ? rest : size));
    }
    try_call(bench, pspec_spectrum_create(&spectrum, bench->plan));
    const double seconds = bench_seconds() - begin;
    size_t num = 0;
    pspec_spectrum_frequencies(spectrum, &num);
    if (bench->first == NULL) {
        bench->first = spectrum;
        return seconds / (double)bench->num_patterns;
    }
    if (memcmp(pspec_spectrum_powers(bench->first), pspec_spectrum_powers(spectrum),
               num * sizeof(double)) != 0) {
        bench_die("the spectrum depends on the size of the calls");
    }
    pspec_spectrum_destroy(spectrum);
    return seconds / (double)bench->num_patterns;
}

static void make_plan(library_bench *bench, const library_case *which) {
    pspec_power_request request = PSPEC_POWER_REQUEST_INIT;
    request.dimension = DIMENSION;
    request.num_points = bench->num_points;
    request.num_realizations = bench->num_patterns;
    request.max_frequency = bench->max_frequency;
    request.engine = which->engine;
    request.precision = which->precision;
    request.no_self_check = 1;
    try_call(bench, pspec_plan_create(&bench->plan, bench->context, &request));
}

static void measure(library_bench *bench, const library_case *which) {
    const double micro = 1e6;
    const double alone = time_engine(bench, which);
    make_plan(bench, which);
    time_calls(bench, bench->num_patterns); /* touches the memory */
    for (size_t i = 0; i < sizeof call_sizes / sizeof call_sizes[0]; i++) {
        double seconds[REPEATS];
        for (int repeat = 0; repeat < REPEATS; repeat++) {
            seconds[repeat] = time_calls(bench, call_sizes[i]);
        }
        const double median = bench_median(seconds, REPEATS);
        printf("%s,%s,%zu,%.3f,%.3f,%.3f\n", which->engine, which->precision, call_sizes[i],
               micro * median, micro * alone, micro * (median - alone));
    }
    pspec_spectrum_destroy(bench->first);
    pspec_plan_destroy(bench->plan);
    bench->first = NULL;
}

int main(int argc, char **argv) {
    library_bench bench = {.num_points = argc > 1 ? (size_t)atol(argv[1]) : 1,
                           .max_frequency = argc > 2 ? (int32_t)atol(argv[2]) : 4};
    bench.context = pspec_context_create();
    pspec_context_set_device(bench.context, getenv("POINTSPEC_DEVICE"));
    make_patterns(&bench);
    printf("# %zu patterns of %zu points, K = %d, microseconds per pattern\n", bench.num_patterns,
           bench.num_points, (int)bench.max_frequency);
    printf("engine,precision,calls of,library,engine alone,overhead\n");
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        measure(&bench, &cases[i]);
    }
    pspec_context_destroy(bench.context);
    free(bench.patterns);
    free(bench.points);
    return 0;
}
