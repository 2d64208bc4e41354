/* Values of integrands at points of the plane in memory (host/trials), and of a map of light at
 * points of the sphere, beside a plain C loop of one thread (integrands/plain.c): sets of 16384
 * points, one trial of each, and eight, for which the points go to the device once.
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
#include "math/pi.h"
#include "math/random/random.h"
#include "math/random/rotation.h"
#include "trials/trials.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { REPEATS = 9, NUM_POINTS = 16384, MANY = 8 };

/* A map of random light, as large as those that people have. */
#define MAP_FILE "/tmp/bench_integrands.pfm"
#define WIDTH 1024
#define HEIGHT 512

/* Operations of a value, images of a Gaussian all counted: moves and differences of two coordinates
 * 12, a weight and a sum 8; an exponential or a cosine counts as 20, ten steps of a polynomial, and
 * so does an arc tangent; a rotation 15. */
typedef struct bench_case {
    const char *text;
    bench_plain_numbers numbers;
    bench_plain_single *single;
    bench_plain_double *exact;
    double flops;
    bool on_sphere;
} bench_case;

#define PLAIN(name) .single = bench_plain_##name##_single, .exact = bench_plain_##name##_double
static const bench_case CASES[] = {
    {.text = "gaussian:sigma=0.0625",
     .numbers = {.a = {0.5, 0.5}, .b = {128, 1}},
     PLAIN(gaussian),
     .flops = 20 + 6 * 24},
    {.text = "gaussian:sigma=0.05",
     .numbers = {.a = {0.5, 0.5}, .b = {200, 0}},
     PLAIN(gaussian),
     .flops = 20 + 24},
    {.text = "disk:radius=0.25",
     .numbers = {.a = {0.5, 0.5}, .b = {0.25, 0}},
     PLAIN(disk),
     .flops = 20 + 5},
    {.text = "box", .numbers = {.a = {0.5, 0.5}, .b = {0.5, 0.5}}, PLAIN(box), .flops = 20 + 4},
    {.text = "wave:k=3x1", .numbers = {.a = {3, 1}, .b = {0, 0}}, PLAIN(wave), .flops = 14 + 27},
    {.text = "map:file=" MAP_FILE,
     .numbers = {.a = {WIDTH, HEIGHT}, .b = {0, 0}},
     PLAIN(map),
     .flops = 15 + 8 + 2 * 20 + 24,
     .on_sphere = true},
};
enum { NUM_CASES = sizeof CASES / sizeof CASES[0] };

typedef struct given {
    size_t num_sets, dimension;
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

static rates run_plain(const given *at, const bench_case *what, bench_plain_numbers numbers,
                       ps_precision precision, double *estimates) {
    const double cpu = cpu_seconds(), clock = bench_seconds();
    for (size_t r = 0; r < at->num_sets; r++) {
        const size_t first = r * NUM_POINTS * at->dimension;
        const double sum = precision == PS_SINGLE
                               ? what->single(at->singles + first, NUM_POINTS, numbers)
                               : what->exact(at->points + first, NUM_POINTS, numbers);
        estimates[r] = sum / NUM_POINTS * (what->on_sphere ? PS_FOUR_PI : 1);
    }
    return rates_of((double)(at->num_sets * NUM_POINTS), cpu, clock);
}

static rates run_trials(const given *at, ps_trials *trials, const double *moves, size_t num_trials,
                        double *estimates) {
    const double cpu = cpu_seconds(), clock = bench_seconds();
    BENCH_TRY(ps_trials_run(trials,
                            &(ps_batch){.num_patterns = at->num_sets, .patterns = at->patterns},
                            moves, estimates, error));
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

static void measure(const given *at, const bench_case *what, bench_plain_numbers numbers,
                    ps_precision precision, ps_trials *trials[2], const ps_peak *peak,
                    measured *found) {
    double *const plain = calloc(at->num_sets, sizeof *plain);
    double *const other = calloc(at->num_sets * MANY, sizeof *other);
    if (plain == NULL || other == NULL) {
        bench_die("no memory for estimates");
    }
    run_trials(at, trials[1], at->moves, MANY, other);
    for (int i = 0; i < REPEATS; i++) {
        const rates loop = run_plain(at, what, numbers, precision, plain);
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
    const ps_integrand_place place = {what->on_sphere ? PS_SAMPLES_SPHERE : PS_SAMPLES_TORUS,
                                      (unsigned)at->dimension};
    bench_plain_numbers numbers = what->numbers;
    ps_integrand *integrand = NULL;
    ps_trials *trials[2] = {NULL, NULL};
    ps_peak peak;
    measured found;
    BENCH_TRY(ps_integrand_parse(&integrand, what->text, place, error));
    BENCH_TRY(ps_peak_create(&peak, at->device, precision, error));
    for (size_t i = 0; i < 2; i++) {
        const ps_trials_options options = {precision, at->num_sets, NUM_POINTS, i == 0 ? 1 : MANY,
                                           false};
        BENCH_TRY(ps_trials_create(&trials[i], integrand, &options, at->device, error));
    }
    float *const singles = calloc(integrand->num_table + 1, sizeof *singles);
    for (size_t i = 0; i < integrand->num_table; i++) {
        singles[i] = (float)integrand->table[i];
    }
    numbers.singles = singles;
    numbers.doubles = integrand->table;
    measure(at, what, numbers, precision, trials, &peak, &found);
    free(singles);
    printf("%-22s %-6s %8.1f %8.1f %8.1f %7.1f %7.1f %7.1f %8.2f %9.1e\n",
           what->on_sphere ? "map, 1024 x 512" : what->text,
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

/* Points of the plane in [0,1)^2, and shifts; unit vectors, and rotations. */
static given make_sets(size_t num_sets, bool on_sphere, ps_device *device) {
    const size_t dimension = on_sphere ? 3 : 2;
    const size_t num = num_sets * NUM_POINTS * dimension;
    given made = {.num_sets = num_sets,
                  .dimension = dimension,
                  .points = bench_uniform(num, 1),
                  .moves = bench_uniform(num_sets * MANY * PS_ROTATION_NUMBERS, 2),
                  .singles = calloc(num, sizeof(float)),
                  .patterns = calloc(num_sets, sizeof(pspec_pattern)),
                  .device = device};
    if (made.singles == NULL || made.patterns == NULL) {
        bench_die("no memory for points");
    }
    for (size_t i = 0; on_sphere && i < num; i += 3) {
        double *const u = made.points + i;
        const double z = 2 * u[0] - 1, phi = PS_TWO_PI * u[1], sine = sqrt(1 - z * z);
        u[0] = sine * cos(phi);
        u[1] = sine * sin(phi);
        u[2] = z;
    }
    ps_random random = ps_random_init(1, PS_STREAM_TRIALS, 0);
    for (size_t i = 0; on_sphere && i < num_sets * MANY; i++) {
        const ps_rotation rotation = ps_rotation_random(&random);
        memcpy(made.moves + i * PS_ROTATION_NUMBERS, rotation.matrix, sizeof rotation.matrix);
    }
    for (size_t i = 0; i < num; i++) {
        made.singles[i] = (float)made.points[i];
    }
    for (size_t r = 0; r < num_sets; r++) {
        made.patterns[r] = (pspec_pattern){(unsigned)dimension, NUM_POINTS,
                                           made.points + r * NUM_POINTS * dimension, NULL};
    }
    return made;
}

static void free_sets(given *sets) {
    free(sets->points);
    free(sets->moves);
    free(sets->singles);
    free(sets->patterns);
}

static void write_map(void) {
    FILE *const file = fopen(MAP_FILE, "wb");
    double *const light = bench_uniform((size_t)WIDTH * HEIGHT, 3);
    if (file == NULL) {
        bench_die("cannot write " MAP_FILE);
    }
    fprintf(file, "Pf %d %d -1\n", WIDTH, HEIGHT);
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
        const float one = (float)light[i];
        fwrite(&one, sizeof one, 1, file);
    }
    free(light);
    if (fclose(file) != 0) {
        bench_die("cannot write " MAP_FILE);
    }
}

int main(int argc, char **argv) {
    const size_t default_sets = 64;
    ps_device *device = NULL;
    BENCH_TRY(ps_device_open(&device, getenv("POINTSPEC_DEVICE"), false, error));
    const size_t num_sets = argc > 1 ? strtoul(argv[1], NULL, 10) : default_sets;
    given sets[] = {make_sets(num_sets, false, device), make_sets(num_sets, true, device)};
    write_map();
    printf("# %zu sets of %d points; million values per second of a processor; ratios to the loop, "
           "clock: of %u processors to its one\n",
           num_sets, NUM_POINTS, ps_device_get_limits(device)->compute_units);
    printf("%-22s %-6s %8s %8s %8s %7s %7s %7s %8s %9s\n", "", "", "loop", "once", "8 times",
           "ratio", "ratio", "clock", "of peak", "differs");
    for (size_t i = 0; i < NUM_CASES; i++) {
        run_case(&sets[CASES[i].on_sphere], &CASES[i], PS_SINGLE);
        if (ps_device_get_limits(device)->has_fp64) {
            run_case(&sets[CASES[i].on_sphere], &CASES[i], PS_DOUBLE);
        }
    }
    ps_device_close(device);
    free_sets(&sets[0]);
    free_sets(&sets[1]);
    remove(MAP_FILE);
    return 0;
}
