#include "bench.h"

#include "base/clock.h"
#include "engines/host/host_direct.h"
#include "math/pi.h"
#include "math/random/random.h"
#include "plan/cost_model.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

void bench_die(const char *message) {
    fprintf(stderr, "bench: %s\n", message);
    exit(EXIT_FAILURE);
}

bool bench_lists_cases(int argc, char **argv, const char *const *cases, size_t num) {
    const bool is_asked = argc == 2 && strcmp(argv[1], "--cases") == 0;
    for (size_t i = 0; i < num && is_asked; i++) {
        puts(cases[i]);
    }
    return is_asked;
}

double bench_seconds(void) {
    return ps_clock_seconds();
}

double bench_thread_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void *allocate(size_t count, size_t bytes) {
    void *memory = calloc(count, bytes);
    if (memory == NULL) {
        bench_die("out of memory");
    }
    return memory;
}

double *bench_uniform(size_t count, uint64_t seed) {
    double *numbers = allocate(count, sizeof(double));
    ps_random random = ps_random_init(seed, PS_STREAM_COORDINATES, 0);
    ps_random_fill_uniform(&random, numbers, count);
    return numbers;
}

static int compare_doubles(const void *a, const void *b) {
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return x < y ? -1 : x > y;
}

double bench_median(double *numbers, size_t num) {
    qsort(numbers, num, sizeof *numbers, compare_doubles);
    return numbers[num / 2];
}

double bench_peak_run(const ps_peak *peak) {
    double rate = 0;
    BENCH_TRY(ps_peak_run(peak, &rate, error));
    return rate;
}

/* ---- jobs -------------------------------------------------------------------------------- */

/* Numbers in [0,1) become white points on the sphere: the first is the height, the second the
 * azimuth. */
static void make_unit_vectors(double *points, size_t num) {
    for (size_t j = 0; j < num; j++) {
        double *u = points + j * PS_SPHERE_DIMENSION;
        const double z = 2 * u[0] - 1;
        const double rho = sqrt((1 - z) * (1 + z));
        const double phi = PS_TWO_PI * u[1];
        u[0] = rho * cos(phi);
        u[1] = rho * sin(phi);
        u[2] = z;
    }
}

void bench_job_create_for(bench_job *job, const ps_engine *engine, ps_precision precision,
                          const ps_problem *problem, ps_device *device) {
    const size_t num_points = (size_t)problem->num_points;
    const size_t num_realizations = (size_t)problem->num_realizations;
    const unsigned dimension = problem->frequencies->dimension;
    *job = (bench_job){.engine = engine,
                       .precision = precision,
                       .device = device,
                       .frequencies = *problem->frequencies,
                       .num_points = num_points,
                       .num_realizations = num_realizations};
    ps_problem own = *problem;
    own.frequencies = &job->frequencies;
    BENCH_TRY(ps_frequencies_enumerate(&job->frequencies, error));
    const ps_device_limits *limits = ps_device_get_limits(device);
    const ps_work work = engine->survey(&own, limits, precision).work;
    job->batch = ps_cost_batch(&work, limits, num_realizations);
    job->points = bench_uniform(num_points * dimension * num_realizations, num_points);
    if (job->frequencies.kind == PS_FREQUENCIES_DEGREES) {
        make_unit_vectors(job->points, num_points * num_realizations);
    }
    job->patterns = allocate(num_realizations, sizeof *job->patterns);
    job->scales = allocate(num_realizations, sizeof *job->scales);
    job->slots = allocate(job->frequencies.num, sizeof *job->slots);
    for (size_t r = 0; r < num_realizations; r++) {
        job->patterns[r] =
            (pspec_pattern){dimension, num_points, job->points + r * num_points * dimension, NULL};
        job->scales[r] = 1 / (double)num_points;
    }
    BENCH_TRY(ps_engine_create(engine, &job->state, &own, precision, job->batch, device, error));
    ps_engine_slots(engine, job->state, own.frequencies->num, job->slots);
}

const char *bench_why_not(const ps_engine *engine, ps_precision precision,
                          const ps_problem *problem, ps_device *device) {
    return engine->survey(problem, ps_device_get_limits(device), precision).why_not;
}

void bench_job_create(bench_job *job, const ps_engine *engine, ps_precision precision,
                      double tolerance, ps_device *device, ps_frequencies frequencies,
                      size_t num_points, size_t num_realizations) {
    const ps_problem problem = {.frequencies = &frequencies,
                                .num_points = num_points,
                                .num_realizations = num_realizations,
                                .tolerance = tolerance};
    bench_job_create_for(job, engine, precision, &problem, device);
}

double bench_job_run(bench_job *job, ps_rows *rows) {
    const double begin = bench_seconds();
    for (size_t done = 0; done < job->num_realizations; done += job->batch) {
        const size_t rest = job->num_realizations - done;
        const ps_batch batch = {.num_patterns = rest < job->batch ? rest : job->batch,
                                .patterns = job->patterns + done,
                                .scales = job->scales + done};
        BENCH_TRY(job->engine->run(job->state, &batch, rows, error));
    }
    BENCH_TRY(ps_rows_wait(rows, error));
    BENCH_TRY(ps_device_finish(job->device, error));
    return bench_seconds() - begin;
}

static double read_entry(bench_job *job, const ps_rows *rows, uint32_t slot) {
    float single = 0;
    double number = 0;
    if (job->precision == PS_SINGLE) {
        BENCH_TRY(ps_buffer_read(job->device, &rows->device, slot * sizeof single, &single,
                                 sizeof single, error));
        return single;
    }
    BENCH_TRY(ps_buffer_read(job->device, &rows->device, slot * sizeof number, &number,
                             sizeof number, error));
    return number;
}

double bench_job_error(bench_job *job) {
    enum { TERMS = 1 << 22, MOST_SAMPLES = 2000 }; /* long double terms: about a quarter second */
    ps_rows rows = {0};
    const ps_batch batch = {.num_patterns = 1, .patterns = job->patterns, .scales = job->scales};
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, 1);
    size_t num_samples = TERMS / job->num_points;
    num_samples = num_samples < 1 ? 1 : num_samples > MOST_SAMPLES ? MOST_SAMPLES : num_samples;
    double squares = 0;
    BENCH_TRY(job->engine->run(job->state, &batch, &rows, error));
    for (size_t i = 0; i < num_samples; i++) {
        const size_t index = (size_t)ps_random_below(&random, job->frequencies.num);
        long double re = 0;
        long double im = 0;
        ps_host_sum(&job->patterns[0],
                    job->frequencies.vectors + index * job->frequencies.dimension, &re, &im);
        const double expected = (double)hypotl(re, im) / sqrt((double)job->num_points);
        const double off = sqrt(read_entry(job, &rows, job->slots[index])) - expected;
        squares += off * off;
    }
    return sqrt(squares / (double)num_samples);
}

void bench_job_destroy(bench_job *job) {
    ps_engine_destroy(job->engine, job->state);
    ps_frequencies_free(&job->frequencies);
    free(job->points);
    free(job->patterns);
    free(job->scales);
    free(job->slots);
}
