/* Values of integrands at points of the plane in memory (host/trials), beside a plain C loop of one
 * thread (integrands/plain.c): sets of 16384 points, one trial of each, and eight, for which the
 * points go to the device once.
 *
 *     bench_integrands [NUM_SETS]                             default 64
 *
 * All take turns. Million values for each second that a processor works for them, so that other
 * programs matter less: medians of the repeats, and of the ratios of neighbours. `clock` is the
 * ratio by the clock, with all processors of the device against the one of the loop, as busy as the
 * machine is. Shares of the peak count what CASES says.
 */
#include "bench.h"

#include "plain.h"
#include "trials/trials.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { REPEATS = 9, NUM_POINTS = 16384, DIMENSION = 2, MANY = 8 };

/* Operations of a value, images of a Gaussian all counted: moves and differences of two coordinates
 * 12, a weight and a sum 8; an exponential or a cosine counts as 20, ten steps of a polynomial. */
typedef struct bench_case {
    const char *text;
    bench_plain_numbers numbers;
    bench_plain_single *single;
    bench_plain_double *exact;
    double flops;
} bench_case;

static const bench_case CASES[] = {
    {"gaussian:sigma=0.0625",
     {{0.5, 0.5}, {128, 1}},
     bench_plain_gaussian_single,
     bench_plain_gaussian_double,
     20 + 6 * 24},
    {"gaussian:sigma=0.05",
     {{0.5, 0.5}, {200, 0}},
     bench_plain_gaussian_single,
     bench_plain_gaussian_double,
     20 + 24},
    {"disk:radius=0.25",
     {{0.5, 0.5}, {0.25, 0}},
     bench_plain_disk_single,
     bench_plain_disk_double,
     20 + 5},
    {"box", {{0.5, 0.5}, {0.5, 0.5}}, bench_plain_box_single, bench_plain_box_double, 20 + 4},
    {"wave:k=3x1", {{3, 1}, {0, 0}}, bench_plain_wave_single, bench_plain_wave_double, 14 + 27},
};
enum { NUM_CASES = sizeof CASES / sizeof CASES[0] };

typedef struct given {
    size_t num_sets;
    double *points, *moves; /* moves of MANY trials of each set */
    float *singles;
    pspec_pattern *patterns;
    ps_device *device;
} given;

/* Of all threads. */
static double cpu_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Values per second of a processor, and by the clock. */
typedef struct rates {
    double cpu, clock;
} rates;

static rates rates_of(double num, double begin_cpu, double begin_clock) {
    return (rates){num / (cpu_seconds() - begin_cpu), num / (bench_seconds() - begin_clock)};
}

static rates run_plain(const given *at, const bench_case *what, ps_precision precision,
                       double *estimates) {
    const double cpu = cpu_seconds(), clock = bench_seconds();
    for (size_t r = 0; r < at->num_sets; r++) {
        const size_t first = r * NUM_POINTS * DIMENSION;
        const double sum = precision == PS_SINGLE
                               ? what->single(at->singles + first, NUM_POINTS, what->numbers)
                               : what->exact(at->points + first, NUM_POINTS, what->numbers);
        estimates[r] = sum / NUM_POINTS;
    }
    return rates_of((double)(at->num_sets * NUM_POINTS), cpu, clock);
}

static rates run_trials(const given *at, ps_trials *trials, const double *moves, size_t num_trials,
                        double *estimates) {
    const double cpu = cpu_seconds(), clock = bench_seconds();
    BENCH_TRY(ps_trials_run(trials, at->patterns, at->num_sets, moves, estimates, error));
    return rates_of((double)(at->num_sets * NUM_POINTS * num_trials), cpu, clock);
}

static double cpu_of_peak(const ps_peak *peak) {
    const double begin = cpu_seconds(), clock = bench_seconds();
    const double flops = bench_peak_run(peak) * (bench_seconds() - clock);
    return flops / (cpu_seconds() - begin);
}

static double difference(const double *a, const double *b, size_t num) {
    double largest = 0;
    for (size_t i = 0; i < num; i++) {
        largest = fmax(largest, fabs(a[i] - b[i]));
    }
    return largest;
}

/* Of every repeat. */
typedef struct measured {
    double plain[REPEATS], once[REPEATS], many[REPEATS];
    double once_ratio[REPEATS], many_ratio[REPEATS], clock[REPEATS], share[REPEATS];
    double differs;
} measured;

static void measure(const given *at, const bench_case *what, ps_precision precision,
                    ps_trials *trials[2], const ps_peak *peak, measured *found) {
    double *const plain = calloc(at->num_sets, sizeof *plain);
    double *const other = calloc(at->num_sets * MANY, sizeof *other);
    if (plain == NULL || other == NULL) {
        bench_die("no memory for estimates");
    }
    run_trials(at, trials[1], at->moves, MANY, other);
    for (int i = 0; i < REPEATS; i++) {
        const rates loop = run_plain(at, what, precision, plain);
        const rates many = run_trials(at, trials[1], at->moves, MANY, other);
        const double most = cpu_of_peak(peak);
        const rates once = run_trials(at, trials[0], NULL, 1, other);
        found->plain[i] = loop.cpu;
        found->once[i] = once.cpu;
        found->many[i] = many.cpu;
        found->once_ratio[i] = once.cpu / loop.cpu;
        found->many_ratio[i] = many.cpu / loop.cpu;
        found->clock[i] = many.clock / loop.clock;
        found->share[i] = many.cpu * what->flops / most;
    }
    found->differs = difference(plain, other, at->num_sets);
    free(plain);
    free(other);
}

static void run_case(const given *at, const bench_case *what, ps_precision precision) {
    const ps_integrand_place place = {PS_SAMPLES_TORUS, DIMENSION};
    ps_integrand *integrand = NULL;
    ps_trials *trials[2] = {NULL, NULL};
    ps_peak peak;
    measured found;
    BENCH_TRY(ps_integrand_parse(&integrand, what->text, place, error));
    BENCH_TRY(ps_peak_create(&peak, at->device, precision, error));
    for (size_t i = 0; i < 2; i++) {
        const ps_trials_options options = {precision, at->num_sets, NUM_POINTS, i == 0 ? 1 : MANY};
        BENCH_TRY(ps_trials_create(&trials[i], integrand, &options, at->device, error));
    }
    measure(at, what, precision, trials, &peak, &found);
    printf("%-22s %-6s %8.1f %8.1f %8.1f %7.1f %7.1f %7.1f %8.2f %9.1e\n", what->text,
           precision == PS_SINGLE ? "single" : "double", 1e-6 * bench_median(found.plain, REPEATS),
           1e-6 * bench_median(found.once, REPEATS), 1e-6 * bench_median(found.many, REPEATS),
           bench_median(found.once_ratio, REPEATS), bench_median(found.many_ratio, REPEATS),
           bench_median(found.clock, REPEATS), bench_median(found.share, REPEATS), found.differs);
    fflush(stdout);
    ps_trials_destroy(trials[0]);
    ps_trials_destroy(trials[1]);
    ps_peak_destroy(&peak);
    ps_integrand_destroy(integrand);
}

static given make_sets(size_t num_sets, ps_device *device) {
    const size_t num = num_sets * NUM_POINTS * DIMENSION;
    given made = {.num_sets = num_sets,
                  .points = bench_uniform(num, 1),
                  .moves = bench_uniform(num_sets * MANY * DIMENSION, 2),
                  .singles = calloc(num, sizeof(float)),
                  .patterns = calloc(num_sets, sizeof(pspec_pattern)),
                  .device = device};
    if (made.singles == NULL || made.patterns == NULL) {
        bench_die("no memory for points");
    }
    for (size_t i = 0; i < num; i++) {
        made.singles[i] = (float)made.points[i];
    }
    for (size_t r = 0; r < num_sets; r++) {
        made.patterns[r] =
            (pspec_pattern){DIMENSION, NUM_POINTS, made.points + r * NUM_POINTS * DIMENSION, NULL};
    }
    return made;
}

int main(int argc, char **argv) {
    const size_t default_sets = 64;
    ps_device *device = NULL;
    BENCH_TRY(ps_device_open(&device, getenv("POINTSPEC_DEVICE"), false, error));
    const given sets = make_sets(argc > 1 ? strtoul(argv[1], NULL, 10) : default_sets, device);
    printf("# %zu sets of %d points; million values per second of a processor; ratios to the loop, "
           "clock: of %u processors to its one\n",
           sets.num_sets, NUM_POINTS, ps_device_get_limits(device)->compute_units);
    printf("%-22s %-6s %8s %8s %8s %7s %7s %7s %8s %9s\n", "", "", "loop", "once", "8 times",
           "ratio", "ratio", "clock", "of peak", "differs");
    for (size_t i = 0; i < NUM_CASES; i++) {
        run_case(&sets, &CASES[i], PS_SINGLE);
        if (ps_device_get_limits(device)->has_fp64) {
            run_case(&sets, &CASES[i], PS_DOUBLE);
        }
    }
    ps_device_close(device);
    free(sets.points);
    free(sets.moves);
    free(sets.singles);
    free(sets.patterns);
    return 0;
}
