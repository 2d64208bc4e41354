/* Pair sums of white sets: (pair, degree) per second at 6 flop each as a share of the peak, which
 * is measured in turn with it; pairs per second into a histogram; the ways to the same sums side by
 * side, and against error and number of points, for docs/scripts/make_figures.sh.
 */
#include "bench.h"

#include "engines/error_units.h"
#include "engines/host/host_direct.h"
#include "engines/engine.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { REPEATS = 12 };

/* As docs/engines/pairs_direct.md counts them. */
#define FLOPS_PER_PAIR_DEGREE 6

/* Of all threads: on a shared machine it says more than the clock. */
static double cpu_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static double cpu_of_peak(ps_peak *peak) {
    const double begin = cpu_seconds(), clock = bench_seconds();
    const double flops = bench_peak_run(peak) * (bench_seconds() - clock);
    return flops / (cpu_seconds() - begin);
}

typedef struct question {
    const ps_engine *engine;
    ps_precision precision;
    double tolerance;
    size_t num_points;
    int32_t degree;
    size_t num_realizations;
} question;

/* CPU seconds of a realization, the best of some. */
static double run_question(ps_device *device, const question *ask, double *peak_flops) {
    ps_frequencies degrees = {0};
    bench_job job;
    ps_peak peak;
    ps_rows rows = {0};
    double cpu = HUGE_VAL;
    BENCH_TRY(ps_frequencies_degrees(&degrees, ask->degree, false, error));
    const ps_problem asked = {.frequencies = &degrees,
                              .num_points = ask->num_points,
                              .num_realizations = ask->num_realizations,
                              .measure = PS_OF_PAIR_SUMS,
                              .tolerance = ask->tolerance};
    const ps_problem own = ps_engine_problem(ask->engine, &asked);
    bench_job_create_for(&job, ask->engine, ask->precision, &own, device);
    BENCH_TRY(ps_peak_create(&peak, device, ask->precision, error));
    bench_job_run(&job, &rows);
    *peak_flops = 0;
    for (int i = 0; i < REPEATS; i++) {
        const double begin = cpu_seconds();
        bench_job_run(&job, &rows);
        cpu = fmin(cpu, cpu_seconds() - begin);
        *peak_flops = fmax(*peak_flops, cpu_of_peak(&peak));
    }
    ps_peak_destroy(&peak);
    bench_job_destroy(&job);
    return cpu / (double)ask->num_realizations;
}

static double num_pairs(const question *ask) {
    return (double)ask->num_points * ((double)ask->num_points - 1) / 2;
}

static void measure_direct(ps_device *device, ps_precision precision, size_t num_points,
                           int32_t degree, size_t num_realizations) {
    const question ask = {&ps_pairs_direct, precision, 1, num_points, degree, num_realizations};
    double peak = 0;
    const double seconds = run_question(device, &ask, &peak);
    const double rate = num_pairs(&ask) * degree / seconds;
    printf("direct    %-9s %7zu %5d %6zu %11.2f %9.3g %8.2f\n", ps_precision_name(precision),
           num_points, degree, num_realizations, 1e6 * seconds, rate,
           FLOPS_PER_PAIR_DEGREE * rate / peak);
}

static void measure_histogram(ps_device *device, ps_precision precision, double tolerance,
                              size_t num_points, int32_t degree) {
    const question ask = {&ps_pairs_histogram, precision, tolerance, num_points, degree, 1};
    double peak = 0;
    const double seconds = run_question(device, &ask, &peak);
    printf("histogram %-9s %7zu %5d %6d %11.2f %9.3g %8.1g\n", ps_precision_name(precision),
           num_points, degree, 1, 1e6 * seconds, num_pairs(&ask) / seconds, tolerance);
}

/* ---- the ways to the same sums ------------------------------------------------------------ */

enum { WAYS = 4, WAY_REPEATS = 4, REFEREE_DEGREES = 12 };
static const double enough_seconds = 0.5; /* of repeats: slow ways vary less */

static const struct {
    const ps_engine *engine;
    const char *name;
} ways[WAYS] = {{&ps_pairs_direct, "direct"},
                {&ps_pairs_histogram, "histogram"},
                {&ps_sphere_direct, "coefs."},
                {&ps_sphere_nufft, "fast coefs."}};

/* The problem that a way is told, and the cheapest precision in which it says to have the
 * tolerance. */
static bool find_precision(const ps_problem *asked, const ps_engine *engine, ps_device *device,
                           ps_precision *out) {
    const ps_device_limits *limits = ps_device_get_limits(device);
    const ps_problem own = ps_engine_problem(engine, asked);
    for (int p = PS_SINGLE; p <= (limits->has_fp64 ? PS_DOUBLE : PS_SINGLE); p++) {
        *out = (ps_precision)p;
        const ps_survey survey = engine->survey(&own, limits, *out);
        if (survey.why_not == NULL &&
            ps_engine_error_in(engine, asked, survey.error) <= asked->tolerance) {
            return true;
        }
    }
    return false;
}

static double *read_rows(const bench_job *job, const ps_rows *rows) {
    const size_t bytes =
        rows->stride * (rows->precision == PS_SINGLE ? sizeof(float) : sizeof(double));
    double *out = calloc(rows->stride, sizeof *out);
    void *data = calloc(bytes, 1);
    if (out == NULL || data == NULL) {
        bench_die("no memory for a row");
    }
    if (rows->host == NULL) {
        BENCH_TRY(ps_buffer_read(job->device, &rows->device, 0, data, bytes, error));
    }
    for (size_t i = 0; i < rows->stride; i++) {
        out[i] = rows->host != NULL             ? rows->host[i]
                 : rows->precision == PS_SINGLE ? (double)((const float *)data)[i]
                                                : ((const double *)data)[i];
    }
    free(data);
    return out;
}

/* The largest error of Q(l) of the first realization, in (sum |w|)^2, for some degrees, against
 * long double. */
static double measure_error(bench_job *job) {
    const double num = (double)job->num_points;
    const ps_batch batch = {.num_patterns = 1, .patterns = job->patterns, .scales = job->scales};
    ps_rows rows = {0};
    double worst = 0;
    BENCH_TRY(job->engine->run(job->state, &batch, &rows, error));
    BENCH_TRY(ps_rows_wait(&rows, error));
    double *powers = read_rows(job, &rows);
    for (int32_t i = 1; i <= REFEREE_DEGREES; i++) {
        const int32_t degree = (int32_t)(job->frequencies.num * (size_t)i / REFEREE_DEGREES);
        ps_host_degree referee;
        BENCH_TRY(ps_host_degree_create(&referee, degree, error));
        ps_host_degree_sum(&referee, &job->patterns[0]);
        const double expected = (double)ps_host_degree_power(&referee) / num;
        worst = fmax(worst, fabs(powers[job->slots[degree - 1]] - expected) / num);
        ps_host_degree_free(&referee);
    }
    free(powers);
    return worst;
}

static double measure_way(const ps_problem *asked, const ps_engine *engine, ps_precision precision,
                          ps_device *device, double *off) {
    ps_problem own = ps_engine_problem(engine, asked);
    ps_frequencies degrees = {0}; /* the job's */
    bench_job job;
    ps_rows rows = {0};
    double cpu = HUGE_VAL;
    BENCH_TRY(ps_frequencies_degrees(&degrees, asked->frequencies->max_frequency, false, error));
    own.frequencies = &degrees;
    bench_job_create_for(&job, engine, precision, &own, device);
    bench_job_run(&job, &rows);
    const double start = cpu_seconds();
    for (int i = 0; i < WAY_REPEATS && cpu_seconds() - start < enough_seconds; i++) {
        const double begin = cpu_seconds();
        bench_job_run(&job, &rows);
        cpu = fmin(cpu, cpu_seconds() - begin);
    }
    *off = measure_error(&job);
    bench_job_destroy(&job);
    return cpu / (double)asked->num_realizations;
}

/* As many realizations as take a millisecond or more. */
static ps_problem make_problem(const ps_frequencies *degrees, size_t num_points, double tolerance) {
    const double pairs_at_least = 1e6; /* of all realizations */
    const double pairs = 0.5 * (double)num_points * (double)num_points;
    return (ps_problem){.frequencies = degrees,
                        .num_points = num_points,
                        .num_realizations = (uint64_t)ceil(pairs_at_least / pairs),
                        .measure = PS_OF_PAIR_SUMS,
                        .tolerance = tolerance};
}

/* Microseconds of a realization and error by each way that has the tolerance. */
static void measure_ways(ps_device *device, size_t num_points, int32_t degree, double tolerance) {
    ps_frequencies degrees = {0};
    BENCH_TRY(ps_frequencies_degrees(&degrees, degree, false, error));
    const ps_problem asked = make_problem(&degrees, num_points, tolerance);
    double best = HUGE_VAL;
    const char *fastest = "none";
    printf("%6zu %5d %7.0e", num_points, degree, tolerance);
    for (size_t i = 0; i < WAYS; i++) {
        ps_precision precision = PS_SINGLE;
        double off = 0;
        if (!find_precision(&asked, ways[i].engine, device, &precision)) {
            printf("  %22s", "-");
            continue;
        }
        const double cpu = measure_way(&asked, ways[i].engine, precision, device, &off);
        printf("  %10.1f %c %9.1e", 1e6 * cpu, precision == PS_SINGLE ? 's' : 'd', off);
        fastest = cpu < best ? ways[i].name : fastest;
        best = fmin(cpu, best);
    }
    printf("  %s\n", fastest);
    fflush(stdout);
    ps_frequencies_free(&degrees);
}

/* The same as one line for each way, with its name without blanks. */
static void measure_routes(ps_device *device, const char *sweep, size_t num_points, int32_t degree,
                           double tolerance) {
    ps_frequencies degrees = {0};
    BENCH_TRY(ps_frequencies_degrees(&degrees, degree, false, error));
    const ps_problem asked = make_problem(&degrees, num_points, tolerance);
    for (size_t i = 0; i < WAYS; i++) {
        ps_precision precision = PS_SINGLE;
        double off = 0;
        if (find_precision(&asked, ways[i].engine, device, &precision)) {
            const double cpu = measure_way(&asked, ways[i].engine, precision, device, &off);
            printf("%-9s %6zu %5d %7.0e %-15s %-6s %12.1f %9.1e\n", sweep, num_points, (int)degree,
                   tolerance, ways[i].engine->name, ps_precision_name(precision), 1e6 * cpu, off);
            fflush(stdout);
        }
    }
    ps_frequencies_free(&degrees);
}

/* Time against the tolerance, and against the number of points. */
static void measure_all_routes(ps_device *device) {
    enum { DECADES = 14, FEWEST = 64, MOST = 4096 };
    static const int32_t degrees[] = {32, 128, 512};
    printf("sweep          N     L    tol. engine          prec.   us/realiz.     error\n");
    for (size_t l = 1; l < sizeof degrees / sizeof degrees[0]; l++) {
        for (int decade = 3; decade <= DECADES; decade++) {
            measure_routes(device, "tolerance", 1024, degrees[l], pow(10, -decade));
        }
    }
    for (size_t l = 0; l < sizeof degrees / sizeof degrees[0]; l++) {
        for (size_t num = FEWEST; num <= MOST; num *= 2) {
            measure_routes(device, "points", num, degrees[l], 1e-5);
            measure_routes(device, "points", num, degrees[l], 1e-10);
        }
    }
}

static void measure_all_direct(ps_device *device, bool has_fp64) {
    printf("direct: us of a realization, pairs times degrees per second, share of the peak at 6 "
           "flop each\n"
           "          precision       N     L      R   us/realiz.    rate    share\n");
    for (int precision = PS_SINGLE; precision <= (has_fp64 ? PS_DOUBLE : PS_SINGLE); precision++) {
        measure_direct(device, (ps_precision)precision, 64, 32, 200);
        measure_direct(device, (ps_precision)precision, 256, 64, 10);
        measure_direct(device, (ps_precision)precision, 1024, 128, 1);
    }
}

static void measure_all_histograms(ps_device *device, bool has_fp64) {
    printf("histogram: us of a realization, pairs per second, tolerance\n"
           "          precision       N     L      R   us/realiz.    rate tolerance\n");
    for (int precision = PS_SINGLE; precision <= (has_fp64 ? PS_DOUBLE : PS_SINGLE); precision++) {
        const double tolerance = precision == PS_SINGLE ? 1e-5 : 1e-10;
        measure_histogram(device, (ps_precision)precision, tolerance, 1024, 256);
        measure_histogram(device, (ps_precision)precision, tolerance, 4096, 100);
        measure_histogram(device, (ps_precision)precision, tolerance, 4096, 256);
        measure_histogram(device, (ps_precision)precision, tolerance, 4096, 1000);
    }
}

static void measure_all_ways(ps_device *device) {
    static const size_t nums[] = {64, 256, 1024, 4096};
    static const int32_t degrees[] = {32, 128, 512};
    static const double tolerances[] = {1e-3, 1e-4, 1e-6, 1e-8, 1e-12};
    printf("us of a realization, s(ingle) or d(ouble) precision, largest error in (sum w)^2\n"
           "     N     L    tol. ");
    for (size_t i = 0; i < WAYS; i++) {
        printf(" %22s ", ways[i].name);
    }
    printf(" fastest\n");
    for (size_t n = 0; n < sizeof nums / sizeof nums[0]; n++) {
        for (size_t l = 0; l < sizeof degrees / sizeof degrees[0]; l++) {
            measure_ways(device, nums[n], degrees[l], 1e-5);
            measure_ways(device, nums[n], degrees[l], 1e-10);
        }
    }
    for (size_t t = 0; t < sizeof tolerances / sizeof tolerances[0]; t++) {
        measure_ways(device, 1024, 128, tolerances[t]);
    }
}

/* bench_pairs [PART...]: direct, histogram, ways, routes; without, all but the last, which takes
 * minutes. */
static bool is_wanted(int argc, char **argv, const char *part) {
    bool found = argc < 2 && strcmp(part, "routes") != 0;
    for (int i = 1; i < argc; i++) {
        found = found || strcmp(argv[i], part) == 0;
    }
    return found;
}

int main(int argc, char **argv) {
    ps_device *device = NULL;
    BENCH_TRY(ps_device_open(&device, getenv("POINTSPEC_DEVICE"), false, error));
    const bool has_fp64 = ps_device_get_limits(device)->has_fp64;
    printf("CPU time of all threads\n");
    if (is_wanted(argc, argv, "direct")) {
        measure_all_direct(device, has_fp64);
    }
    if (is_wanted(argc, argv, "histogram")) {
        measure_all_histograms(device, has_fp64);
    }
    if (is_wanted(argc, argv, "ways")) {
        measure_all_ways(device);
    }
    if (is_wanted(argc, argv, "routes")) {
        measure_all_routes(device);
    }
    ps_device_close(device);
    return 0;
}
