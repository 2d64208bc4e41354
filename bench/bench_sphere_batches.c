/* Time per realization of sphere_grid and sphere_nufft on batches of white sets, in turn: the least
 * of several runs. Arguments: N L R TOLERANCE, else those of docs/developer/peers.md.
 */
#include "bench.h"

#include "engines/engine.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { REPEATS = 7 };

static const double single_suffices = 1e-6;

static void run_both(ps_device *device, size_t num_points, int32_t max_degree, size_t sets,
                     double tolerance) {
    static const ps_engine *const engines[] = {&ps_sphere_grid, &ps_sphere_nufft};
    enum { NUM = sizeof engines / sizeof engines[0] };
    const ps_precision precision = tolerance >= single_suffices ? PS_SINGLE : PS_DOUBLE;
    bench_job jobs[NUM];
    double best[NUM];
    ps_rows rows = {0};
    for (int i = 0; i < NUM; i++) {
        ps_frequencies degrees = {0};
        BENCH_TRY(ps_frequencies_degrees(&degrees, max_degree, false, error));
        bench_job_create(&jobs[i], engines[i], precision, tolerance, device, degrees, num_points,
                         sets);
        best[i] = bench_job_run(&jobs[i], &rows);
    }
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        for (int i = 0; i < NUM; i++) {
            best[i] = fmin(best[i], bench_job_run(&jobs[i], &rows));
        }
    }
    printf("%6zu, %4d, %5zu %8.0e", num_points, (int)max_degree, sets, tolerance);
    for (int i = 0; i < NUM; i++) {
        printf(" %12.1f", best[i] / (double)sets * 1e6);
        bench_job_destroy(&jobs[i]);
    }
    printf(" %7.2f\n", best[1] / best[0]);
}

int main(int num_words, char **words) {
    static const struct {
        size_t points;
        int32_t degree;
        size_t sets;
    } cases[] = {{256, 64, 2000}, {1024, 128, 500}, {4096, 256, 100}};
    static const double tolerances[] = {1e-5, 1e-12};
    enum { NUM_ARGUMENTS = 4 };
    ps_device *device = NULL;
    BENCH_TRY(ps_device_open(&device, getenv("POINTSPEC_DEVICE"), false, error));
    printf("N, L, R                 tol  sphere_grid sphere_nufft   ratio   us per realization\n");
    if (num_words > NUM_ARGUMENTS) {
        run_both(device, strtoul(words[1], NULL, 10), (int32_t)strtol(words[2], NULL, 10),
                 strtoul(words[3], NULL, 10), strtod(words[4], NULL));
    } else {
        for (size_t t = 0; t < sizeof tolerances / sizeof tolerances[0]; t++) {
            for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
                run_both(device, cases[i].points, cases[i].degree, cases[i].sets, tolerances[t]);
            }
        }
    }
    ps_device_close(device);
    return 0;
}
