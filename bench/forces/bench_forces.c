/* Points that repel each other: the tables of docs/samplers/forces.md.
 *
 *     bench_forces                all of them, some minutes
 *     bench_forces gaussian       Gaussian blue noise: how far energies are from their bound
 *     bench_forces step           step blue noise: how far distributions are from that of a step
 *     bench_forces powers         powers of both
 *     bench_forces smoothings     powers of step blue noise by other smoothings
 *     bench_forces near           its pairs about the least distance
 *
 * POINTSPEC_DEVICE chooses the device, which has double precision. It is open before anything is
 * timed, and its kernels are built; s of processors are of all of them together, so that a busy
 * machine matters less.
 */
#include "bench.h"

#include "forces/measures.h"
#include "math/random/random.h"
#include "samplers/forces/gaussian.h"
#include "samplers/forces/step.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { PLANE = 2, SPACE = 3 };

static double processor_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static double *allocate(size_t num) {
    double *const x = calloc(num, sizeof *x);
    if (x == NULL) {
        bench_die("no memory for points");
    }
    return x;
}

static ps_random begin_set(uint64_t realization) {
    return ps_random_init(1, PS_STREAM_COORDINATES, realization);
}

/* Of two cores. */
static double hours_of_1000(double processor_seconds_of_one) {
    return processor_seconds_of_one * 1000 / 2 / 3600;
}

/* ---- Gaussian blue noise ------------------------------------------------------------------- */

typedef struct gaussian_case {
    unsigned dimension;
    size_t num;
    double sigma;
} gaussian_case;

typedef struct descent {
    unsigned steps, halvings;
    double excess, seconds;
    bool is_still;
} descent;

/* Every step is looked at: the energy falls. device NULL: the host. */
static descent descend(const gaussian_case *what, ps_device *device) {
    double *const x = allocate(what->num * what->dimension);
    ps_gaussian g;
    ps_random random = begin_set(0);
    ps_random_fill_uniform(&random, x, what->num * what->dimension);
    const double begin = processor_seconds();
    BENCH_TRY(
        ps_gaussian_begin(&g, what->num, what->dimension, what->sigma, x, device, NULL, error));
    do {
        const double before = g.energy;
        BENCH_TRY(ps_gaussian_step(&g, error));
        if (g.energy > before) {
            bench_die("an energy has risen");
        }
    } while (g.move > PS_GAUSSIAN_STILL && g.steps < PS_GAUSSIAN_MOST_STEPS);
    const descent found = {g.steps, g.halvings, ps_gaussian_excess(&g, what->sigma),
                           processor_seconds() - begin, g.move <= PS_GAUSSIAN_STILL};
    ps_gaussian_destroy(&g);
    free(x);
    return found;
}

static void show_gaussian(ps_device *device) {
    static const gaussian_case cases[] = {
        {PLANE, 256, 1},    {PLANE, 1024, 1},   {PLANE, 4096, 1}, {PLANE, 1024, 0.5},
        {PLANE, 1024, 0.7}, {PLANE, 1024, 1.5}, {PLANE, 1024, 2}, {SPACE, 256, 1},
        {SPACE, 1024, 1},   {SPACE, 256, 2}};
    printf("%2s %6s %6s %6s %6s %15s %9s %9s %6s\n", "d", "N", "sigma", "steps", "halved",
           "(E - bound) / N", "device s", "host s", "hours");
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const gaussian_case *const c = &cases[i];
        const descent there = descend(c, device);
        const descent host = descend(c, NULL);
        if (there.excess != host.excess || there.steps != host.steps) {
            bench_die("the device's points are not those of the host");
        }
        printf("%2u %6zu %6.1f %6u %6u %15.1e %9.2f %9.2f %6.2f%s\n", c->dimension, c->num,
               c->sigma, host.steps, host.halvings, host.excess / (double)c->num, there.seconds,
               host.seconds, hours_of_1000(fmin(there.seconds, host.seconds)),
               host.is_still ? "" : "  not still");
        fflush(stdout);
    }
    printf("s of processors; hours of 1000 sets on two cores, by the faster\n");
}

/* ---- step blue noise ----------------------------------------------------------------------- */

static ps_step_outcome make_step(size_t num, uint64_t realization, ps_step_smoothing smoothing,
                                 ps_device *device, double *x) {
    ps_step_outcome outcome = {0};
    ps_random random = begin_set(realization);
    BENCH_TRY(ps_step_make(num, (ps_step_options){PS_STEP_MOST_ROUNDS, smoothing}, &random, device,
                           NULL, x, &outcome, error));
    return outcome;
}

static void show_step(ps_device *device) {
    static const size_t nums[] = {256, 1024, 2048, 4096};
    printf("%6s %6s %9s %9s %9s %9s %6s\n", "N", "rounds", "before", "after", "nearest", "s",
           "hours");
    for (size_t i = 0; i < sizeof nums / sizeof nums[0]; i++) {
        double *const x = allocate(PLANE * nums[i]);
        const double begin = processor_seconds();
        const ps_step_outcome outcome = make_step(nums[i], 0, PS_STEP_SMOOTHING, device, x);
        const double seconds = processor_seconds() - begin;
        printf("%6zu %6u %9.4f %9.4f %9.2f %9.2f %6.2f\n", nums[i], outcome.rounds, outcome.first,
               outcome.last, bench_nearest(nums[i], x), seconds, hours_of_1000(seconds));
        fflush(stdout);
        free(x);
    }
    printf("s of processors; hours of 1000 sets on two cores\n");
}

/* ---- powers -------------------------------------------------------------------------------- */

static const double nus[] = {0.02, 0.06, 0.10, 0.18, 0.26, 0.34, 0.42, 0.50, 0.54,
                             0.58, 0.62, 0.66, 0.70, 0.74, 1.06, 1.14, 1.30};
enum { NUM_NUS = sizeof nus / sizeof nus[0], ROW_NAME = 24 };

static void show_head(void) {
    printf("%-*s", ROW_NAME, "nu");
    for (size_t i = 0; i < NUM_NUS; i++) {
        printf(" %7.2f", nus[i]);
    }
    printf("\n");
}

static void show_powers(const char *name, const bench_powers *powers) {
    printf("%-*s", ROW_NAME, name);
    for (size_t i = 0; i < NUM_NUS; i++) {
        printf(" %7.2g", bench_powers_mean(powers, nus[i]));
    }
    printf("\n");
    fflush(stdout);
}

static void show_gaussian_powers(size_t num, unsigned num_sets, ps_device *device) {
    char name[ROW_NAME + 1];
    bench_powers powers = {{0}, {0}};
    double *const x = allocate(PLANE * num);
    for (unsigned r = 0; r < num_sets; r++) {
        ps_random random = begin_set(r);
        BENCH_TRY(ps_gaussian_make(num, PLANE, 1, &random, device, NULL, x, error));
        bench_powers_add(&powers, num, x);
    }
    snprintf(name, sizeof name, "gaussian %zu, %u sets", num, num_sets);
    show_powers(name, &powers);
    free(x);
}

static void show_step_powers(const char *name, size_t num, unsigned num_sets,
                             ps_step_smoothing smoothing, ps_device *device) {
    bench_powers powers = {{0}, {0}};
    double *const x = allocate(PLANE * num);
    for (unsigned r = 0; r < num_sets; r++) {
        make_step(num, r, smoothing, device, x);
        bench_powers_add(&powers, num, x);
    }
    show_powers(name, &powers);
    free(x);
}

static void show_all_powers(ps_device *device) {
    show_head();
    show_gaussian_powers(1024, 20, device);
    show_step_powers("step 1024, 20 sets", 1024, 20, PS_STEP_SMOOTHING, device);
    show_step_powers("step 4096, 4 sets", 4096, 4, PS_STEP_SMOOTHING, device);
}

static void show_smoothings(ps_device *device) {
    enum { NUM = 1024, NUM_SETS = 4 };
    show_head();
    show_step_powers("8 bins", NUM, NUM_SETS, PS_STEP_SMOOTHING, device);
    show_step_powers("4 bins", NUM, NUM_SETS, (ps_step_smoothing){4, false}, device);
    show_step_powers("16 bins", NUM, NUM_SETS, (ps_step_smoothing){16, false}, device);
    show_step_powers("8 bins, g smoothed, too", NUM, NUM_SETS, (ps_step_smoothing){8, true},
                     device);
    printf("step blue noise, N = %d, %d sets\n", NUM, NUM_SETS);
}

/* ---- pairs that are near each other -------------------------------------------------------- */

/* About the least distance of a set by 8 bins, in 1/sqrt(N). */
static const double edges[] = {0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5};
enum { NUM_EDGES = sizeof edges / sizeof edges[0], NEAR_NUM = 1024, NEAR_SETS = 4 };

static void show_within(const char *name, const double *within) {
    printf("%-*s", ROW_NAME, name);
    for (size_t i = 0; i < NUM_EDGES; i++) {
        printf(" %7.2f", within[i] - (i > 0 ? within[i - 1] : 0));
    }
    printf("\n");
    fflush(stdout);
}

/* Of N points (N - 1)/2 int 2 pi r g(r) dr of 1/sqrt(N) each, by the middles of many rings. */
static double target_within(double distance) {
    enum { RINGS = 1000 };
    const double pi = acos(-1);
    const double width = distance / RINGS;
    double sum = 0;
    for (unsigned k = 0; k < RINGS; k++) {
        const double r = (k + 0.5) * width;
        sum += 2 * pi * r * width * (1 - 2 * ps_step_bessel(r / sqrt(pi)));
    }
    return (NEAR_NUM - 1) / 2.0 * sum;
}

static void show_step_pairs(const char *name, ps_step_smoothing smoothing, ps_device *device) {
    double within[NUM_EDGES] = {0};
    double *const x = allocate(PLANE * NEAR_NUM);
    for (unsigned r = 0; r < NEAR_SETS; r++) {
        make_step(NEAR_NUM, r, smoothing, device, x);
        for (size_t i = 0; i < NUM_EDGES; i++) {
            within[i] += (double)bench_pairs_within(NEAR_NUM, x, edges[i]) / NEAR_SETS;
        }
    }
    show_within(name, within);
    free(x);
}

static void show_near(ps_device *device) {
    double within[NUM_EDGES];
    printf("%-*s", ROW_NAME, "up to");
    for (size_t i = 0; i < NUM_EDGES; i++) {
        printf(" %7.2f", edges[i]);
        within[i] = target_within(edges[i]);
    }
    printf("\n");
    show_within("target", within);
    show_step_pairs("8 bins", PS_STEP_SMOOTHING, device);
    show_step_pairs("4 bins", (ps_step_smoothing){4, false}, device);
    show_step_pairs("16 bins", (ps_step_smoothing){16, false}, device);
    show_step_pairs("8 bins, g smoothed, too", (ps_step_smoothing){8, true}, device);
    printf("pairs of a set from the distance before to this one, in 1/sqrt(N); N = %d, %d sets\n",
           NEAR_NUM, NEAR_SETS);
}

/* -------------------------------------------------------------------------------------------- */

/* So that what follows is timed without it. */
static void build_kernels(ps_device *device) {
    enum { FEW = 64 };
    double x[SPACE * FEW];
    ps_random random = begin_set(0);
    BENCH_TRY(ps_step_make(FEW, (ps_step_options){1, PS_STEP_SMOOTHING}, &random, device, NULL, x,
                           NULL, error));
    for (unsigned d = PLANE; d <= SPACE; d++) {
        BENCH_TRY(
            ps_gaussian_make(FEW, d, PS_GAUSSIAN_LEAST_SIGMA, &random, device, NULL, x, error));
    }
}

int main(int num_words, char **words) {
    static const struct {
        const char *name;
        void (*show)(ps_device *device);
    } parts[] = {{"gaussian", show_gaussian},
                 {"step", show_step},
                 {"powers", show_all_powers},
                 {"smoothings", show_smoothings},
                 {"near", show_near}};
    const char *const wanted = num_words > 1 ? words[1] : NULL;
    bool is_known = wanted == NULL;
    ps_device *device = NULL;
    BENCH_TRY(ps_device_open(&device, getenv("POINTSPEC_DEVICE"), false, error));
    build_kernels(device);
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        if (wanted == NULL || strcmp(wanted, parts[i].name) == 0) {
            is_known = true;
            parts[i].show(device);
        }
    }
    ps_device_close(device);
    if (!is_known) {
        bench_die("the tables are gaussian, step, powers, smoothings, near");
    }
    return EXIT_SUCCESS;
}
