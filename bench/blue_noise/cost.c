/* What realizations of samplers that keep a distance cost. Seconds are of the processor, which
 * other programs on the machine change little.
 */
#include "blue_noise/modes.h"

#include "bench.h"
#include "base/workers.h"
#include "store/figures_file.h"

#include <stdio.h>
#include <stdlib.h>

enum { THREADS = 2, MOST_ROUNDS = 15, LEAST_ROUNDS = 3, DIMENSIONS = 3 };

ps_sampler_request bench_sampler(const char *text, size_t num_points) {
    ps_sampler_request request = {0};
    BENCH_TRY(ps_sampler_parse(&request, text, error));
    request.num_points = num_points;
    request.seed = 1;
    BENCH_TRY(ps_sampler_resolve(&request, error));
    return request;
}

double bench_make_set(const ps_sampler_request *request, uint64_t realization, double *points,
                      size_t *num_points) {
    const double begin = bench_thread_seconds();
    size_t num = 0;
    BENCH_TRY(ps_sampler_generate(request, realization, points, &num, NULL, error));
    if (num_points != NULL) {
        *num_points = num;
    }
    return bench_thread_seconds() - begin;
}

static double *room_for(const ps_sampler_request *request) {
    double *const points = calloc(ps_sampler_most_points(request), DIMENSIONS * sizeof *points);
    if (points == NULL) {
        bench_die("no memory for points");
    }
    return points;
}

/* ---- beside the prototypes ----------------------------------------------------------------- */

/* Seconds of throw-away prototypes of the same algorithms, made before the samplers were, on a core
 * of an EPYC (gcc 12, -O3 -march=native): a set should take at most 1.5 times as long. */
typedef struct planned {
    const char *sampler;
    size_t num_points;
    double seconds;
} planned;

static const planned PLANNED[] = {
    {"poisson-disk", 1024, 0.003},
    {"poisson-disk", 4096, 0.014},
    {"poisson-disk", 16384, 0.055},
    {"bridson", 1024, 0.003},
    {"bridson", 4096, 0.013},
    {"bridson", 16384, 0.051},
    {"bnot", 1024, 0.03},
    {"bnot", 4096, 0.2},
    {"bnot", 16384, 0.9},
    {"bnot:eps=0.2", 1024, 0.15},
    {"bnot:eps=0.2", 4096, 0.75},
    {"fpo:distance=0.9", 1024, 0.13},
    {"fpo:distance=0.9", 4096, 0.6},
    {"fpo:distance=0.9", 16384, 2.7},
    {"fpo", 1024, 0.8},
    {"fpo", 4096, 5.6},
    {"fpo", 16384, 25},
    {"poisson-disk-sphere", 1024, 0.7},
    {"poisson-disk-sphere", 4096, 3},
};
enum { NUM_PLANNED = sizeof PLANNED / sizeof PLANNED[0] };

static unsigned rounds_of(double seconds) {
    const double budget = 5;
    const double rounds = budget / seconds;
    return rounds < LEAST_ROUNDS  ? LEAST_ROUNDS
           : rounds > MOST_ROUNDS ? MOST_ROUNDS
                                  : (unsigned)rounds;
}

void bench_blue_noise_cost(void) {
    double seconds[NUM_PLANNED][MOST_ROUNDS];
    for (unsigned round = 0; round < MOST_ROUNDS; round++) { /* A B .. A B .. */
        for (size_t i = 0; i < NUM_PLANNED; i++) {
            if (round < rounds_of(PLANNED[i].seconds)) {
                const ps_sampler_request request =
                    bench_sampler(PLANNED[i].sampler, PLANNED[i].num_points);
                double *const points = room_for(&request);
                seconds[i][round] = bench_make_set(&request, round, points, NULL);
                free(points);
            }
        }
    }
    printf("%-20s %6s %4s %10s %10s %11s %6s\n", "sampler", "N", "sets", "least ms", "median ms",
           "prototype", "ratio");
    for (size_t i = 0; i < NUM_PLANNED; i++) {
        const planned *const p = &PLANNED[i];
        const unsigned rounds = rounds_of(p->seconds);
        const double median = bench_median(seconds[i], rounds); /* sorts */
        printf("%-20s %6zu %4u %10.2f %10.2f %11.0f %6.2f\n", p->sampler, p->num_points, rounds,
               seconds[i][0] * 1e3, median * 1e3, p->seconds * 1e3, median / p->seconds);
    }
}

/* ---- hours --------------------------------------------------------------------------------- */

/* Realizations index, index + count, .., as kept sets are made. */
typedef struct shares {
    const ps_sampler_request *request;
    unsigned num_sets, count;
    double seconds[THREADS];
} shares;

static void make_share(void *of, unsigned index) {
    shares *const s = of;
    double *const points = room_for(s->request);
    for (unsigned r = index; r < s->num_sets; r += s->count) {
        s->seconds[index] += bench_make_set(s->request, r, points, NULL);
    }
    free(points);
}

/* Mean seconds of a set while both cores make some. */
static double mean_seconds(ps_workers *workers, const ps_sampler_request *request,
                           unsigned num_sets) {
    shares s = {request, num_sets, ps_workers_count(workers), {0}};
    double sum = 0;
    ps_workers_run(workers, make_share, &s);
    for (unsigned t = 0; t < s.count; t++) {
        sum += s.seconds[t];
    }
    return sum / num_sets;
}

void bench_blue_noise_hours(unsigned num_sets) {
    static const char *const samplers[] = {"poisson-disk", "bridson",      "poisson-disk-sphere",
                                           "bnot",         "bnot:eps=0.5", "fpo:distance=0.9",
                                           "fpo"};
    static const size_t counts[] = {1024, 4096, 16384};
    enum { COUNTS = sizeof counts / sizeof counts[0] };
    const double thousand = 1000;
    const double hour = 3600;
    ps_workers *const workers = ps_workers_create(THREADS);
    ps_device_limits host;
    ps_host_describe(&host);
    printf("# %s, %s; of %u sets, by %u threads at the same time\n", host.name, host.driver,
           num_sets, ps_workers_count(workers));
    printf("%-20s %29s   %29s\n", "", "hours of 1000 sets", "seconds of a set");
    printf("%-20s %9s %9s %9s   %9s %9s %9s\n", "sampler", "N=1024", "4096", "16384", "1024",
           "4096", "16384");
    for (size_t k = 0; k < sizeof samplers / sizeof samplers[0]; k++) {
        double seconds[COUNTS];
        printf("%-20s", samplers[k]);
        for (size_t i = 0; i < COUNTS; i++) {
            const ps_sampler_request request = bench_sampler(samplers[k], counts[i]);
            seconds[i] = mean_seconds(workers, &request, num_sets);
            printf(" %9.4f", thousand * seconds[i] / THREADS / hour);
            fflush(stdout);
        }
        printf("  ");
        for (size_t i = 0; i < COUNTS; i++) {
            printf(" %9.4f", seconds[i]);
        }
        printf("\n");
    }
    ps_workers_destroy(workers);
}
