/* Optimal weights of spherical Fibonacci points by Cholesky and by conjugate gradients on the
 * device: seconds by the clock and of all processors, those of the kernel form beside them (check),
 * E^2 and how far both are from each other, condition, steps, bytes announced.
 *
 *     bench_weights [both|cholesky|gradients] [N...]          default both 1024 4096
 */
#include "bench.h"

#include "rules/optimal_weights.h"
#include "rules/worst_case_error.h"
#include "samplers/sampler.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { REPEATS = 5, MOST_REPEATED = 5000 };
static const double smoothnesses[] = {1.1, 1.5, 1.9};

static double *make_points(size_t num) {
    ps_sampler_request request = {.num_points = num, .seed = 1};
    double *points = calloc(3 * num, sizeof *points);
    if (points == NULL) {
        bench_die("no memory for points");
    }
    BENCH_TRY(ps_sampler_parse(&request, "fibonacci-hemisphere:morph=diffuse", error));
    BENCH_TRY(ps_sampler_resolve(&request, error));
    BENCH_TRY(ps_sampler_generate(&request, 0, points, NULL, NULL, error));
    return points;
}

/* Of all threads: on a shared machine it says more than the clock. */
static double cpu_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

typedef struct taken {
    double seconds[REPEATS], cpu[REPEATS];
} taken;

static ps_optimal_weights find(const ps_representer *of, size_t num, const double *points,
                               const ps_kernel_options *options, double *weights, double *seconds,
                               double *cpu) {
    ps_optimal_weights found;
    const double begin = bench_seconds();
    const double cpu_begin = cpu_seconds();
    BENCH_TRY(
        ps_optimal_weights_find(of, num, points, NULL, false, options, weights, &found, error));
    *seconds = bench_seconds() - begin;
    *cpu = cpu_seconds() - cpu_begin;
    return found;
}

/* One line of N and s. */
static void measure(ps_device *device, const ps_brdf *brdf, size_t num, double smoothness,
                    bool is_dense, int repeats) {
    ps_representer of;
    ps_optimal_weights found = {0};
    taken took;
    double *const points = make_points(num);
    double *const weights = calloc(num, sizeof *weights);
    const ps_kernel_options options = {.device = device, .memory_limit = is_dense ? 0 : 1};
    BENCH_TRY(ps_representer_create(&of, brdf, smoothness, 1e-13, 0, error));
    for (int r = 0; r < repeats; r++) {
        found = find(&of, num, points, &options, weights, &took.seconds[r], &took.cpu[r]);
    }
    const ps_rule rule = {num, points, weights};
    ps_kernel_error e;
    const double begin = bench_seconds();
    BENCH_TRY(ps_kernel_error_of(&of, &rule, NULL, NULL, NULL, &e, error));
    const double check = bench_seconds() - begin;
    printf("%-9s %7zu %4g %9.3f %9.3f %9.3f %9.3g %9.2g %9.2g %6zu %9.2g %9.1f\n",
           found.facts.is_dense ? "cholesky" : "gradients", num, smoothness,
           bench_median(took.seconds, (size_t)repeats), bench_median(took.cpu, (size_t)repeats),
           check, found.squared, found.squared - e.squared, found.facts.condition,
           found.facts.num_steps, found.facts.residual, 1e-6 * (double)found.facts.bytes);
    fflush(stdout);
    ps_representer_destroy(&of);
    free(points);
    free(weights);
}

int main(int argc, char **argv) {
    static const char *const defaults[] = {"", "1024", "4096"};
    ps_brdf *brdf = NULL;
    ps_device *device = NULL;
    const bool has_nums = argc > 2;
    const char *const way = argc > 1 ? argv[1] : "both";
    BENCH_TRY(ps_brdf_parse(&brdf, "diffuse", error));
    BENCH_TRY(ps_device_open(&device, getenv("POINTSPEC_DEVICE"), false, error));
    printf("way             N    s   seconds   of CPUs     check       E^2    differs condition "
           "steps  "
           "residual        MB\n");
    for (int i = has_nums ? 2 : 1; i < (has_nums ? argc : 3); i++) {
        const size_t num = strtoul(has_nums ? argv[i] : defaults[i], NULL, 10);
        const int repeats = num > MOST_REPEATED ? 1 : REPEATS;
        for (size_t k = 0; k < sizeof smoothnesses / sizeof smoothnesses[0]; k++) {
            if (strcmp(way, "gradients") != 0) {
                measure(device, brdf, num, smoothnesses[k], true, repeats);
            }
            if (strcmp(way, "cholesky") != 0) {
                measure(device, brdf, num, smoothnesses[k], false, repeats);
            }
        }
    }
    ps_device_close(device);
    ps_brdf_destroy(brdf);
    return 0;
}
