/* What patterns in memory cost: microseconds of the processor for each pattern of N points, from
 * pspec_question_add to the answer, beside the engine alone.
 *
 *     bench_library [POINTS [MAX_FREQUENCY]]     default 1 point, K = 4
 *
 * "calls of" is the number of patterns handed over at a time; "overhead" is what the library adds
 * to the engine's own time for a full batch (which includes nothing of planning, checking, copying
 * or averaging). The bits of all spectra of an engine are compared.
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
    pspec_question *question;
    double *points;
    size_t num_points, num_patterns;
    int32_t max_frequency;
    pspec_answer *first; /* of this engine */
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
    bench->points = bench_uniform(bench->num_patterns * bench->num_points * DIMENSION, 1);
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

/* Seconds per pattern of all of them in calls of `size`, the answer at the end included. */
static double time_calls(library_bench *bench, size_t size) {
    pspec_answer *answer = NULL;
    pspec_question_reset(bench->question);
    const double begin = bench_seconds();
    for (size_t r = 0; r < bench->num_patterns; r += size) {
        const size_t rest = bench->num_patterns - r;
        try_call(bench, pspec_question_add(
                            bench->question, rest < size ? rest : size, bench->num_points,
                            DIMENSION, bench->points + r * bench->num_points * DIMENSION, NULL));
    }
    try_call(bench, pspec_question_answer(&answer, bench->question));
    const double seconds = bench_seconds() - begin;
    if (bench->first == NULL) {
        bench->first = answer;
        return seconds / (double)bench->num_patterns;
    }
    const pspec_field *const first = pspec_answer_find(bench->first, "power");
    const pspec_field *const power = pspec_answer_find(answer, "power");
    if (memcmp(first->data, power->data, first->num * sizeof(double)) != 0) {
        bench_die("the spectrum depends on the size of the calls");
    }
    pspec_answer_destroy(answer);
    return seconds / (double)bench->num_patterns;
}

static void make_question(library_bench *bench, const library_case *which) {
    try_call(bench, pspec_question_create(&bench->question, bench->context, "power"));
    try_call(bench,
             pspec_question_set_number(bench->question, "max-frequency", bench->max_frequency));
    try_call(bench, pspec_question_set(bench->question, "engine", which->engine));
    if (strcmp(which->precision, "extended") != 0) { /* which is that of the engine anyway */
        try_call(bench, pspec_question_set(bench->question, "precision", which->precision));
    }
    try_call(bench, pspec_question_set(bench->question, "no-self-check", NULL));
}

static void measure(library_bench *bench, const library_case *which) {
    const double micro = 1e6;
    const double alone = time_engine(bench, which);
    make_question(bench, which);
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
    pspec_answer_destroy(bench->first);
    pspec_question_destroy(bench->question);
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
    free(bench.points);
    return 0;
}
