/* Time per realization of sphere_direct on white sets, as a rate of (point, degree, order) triples
 * and as a share of the peak, which is measured in turn with it: on a shared machine only their
 * ratio means something.
 */
#include "bench.h"

#include "engines/engine.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { REPEATS = 15 };

/* Fused operations or products of sphere/sums.cl for a triple, in flop of a peak that counts two
 * for each: five for a degree and two for every eight. */
#define FLOPS_PER_HARMONIC 10.5

static void measure(ps_device *device, ps_precision precision, size_t num_points, int32_t degree,
                    bool only_even, size_t num_realizations) {
    ps_frequencies degrees = {0};
    bench_job job;
    ps_peak peak;
    ps_rows rows = {0};
    double best = HUGE_VAL;
    double best_peak = 0;
    BENCH_TRY(ps_frequencies_degrees(&degrees, degree, only_even, error));
    bench_job_create(&job, &ps_sphere_direct, precision, 1, device, degrees, num_points,
                     num_realizations);
    BENCH_TRY(ps_peak_create(&peak, device, precision, error));
    bench_job_run(&job, &rows);
    for (int i = 0; i < REPEATS; i++) {
        best = fmin(best, bench_job_run(&job, &rows));
        best_peak = fmax(best_peak, bench_peak_run(&peak));
    }
    const double harmonics =
        (double)num_points * (double)num_realizations * (degree + 1.0) * (degree + 2.0) / 2;
    printf("%-7s %-4s %7zu %5d %6zu %11.2f %9.3g %7.1f %6.2f %9.2g\n", ps_precision_name(precision),
           only_even ? "even" : "all", num_points, degree, num_realizations,
           1e6 * best / (double)num_realizations, harmonics / best, best_peak * 1e-9,
           FLOPS_PER_HARMONIC * harmonics / best / best_peak,
           ps_sphere_direct.error_of_state(job.state, 1, 0));
    ps_peak_destroy(&peak);
    bench_job_destroy(&job);
}

int main(void) {
    ps_device *device = NULL;
    BENCH_TRY(ps_device_open(&device, getenv("POINTSPEC_DEVICE"), false, error));
    printf("precision degrees   N     L      R   us/realiz. triples/s peak GF  share   error\n");
    for (int precision = PS_SINGLE; precision <= PS_DOUBLE; precision++) {
        if (precision == PS_DOUBLE && !ps_device_get_limits(device)->has_fp64) {
            continue;
        }
        measure(device, (ps_precision)precision, 64, 32, false, 2000);
        measure(device, (ps_precision)precision, 256, 64, false, 1000);
        measure(device, (ps_precision)precision, 256, 64, true, 1000);
        measure(device, (ps_precision)precision, 1024, 128, false, 100);
        measure(device, (ps_precision)precision, 4096, 256, false, 8);
    }
    ps_device_close(device);
    return 0;
}
