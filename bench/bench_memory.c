/* Largest resident memory and seconds per realization of whole jobs against the number of realizations:
 * memory must not grow with it.
 *
 *     bench_memory [M...]          default 100 1000 10000 of jittered, N = 256, K = 32
 *
 * Every job runs in a process of its own, so that its largest memory is its own.
 */
#include "bench.h"

#include "job/power_job.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

static void run_job(uint64_t num_realizations) {
    ps_sampler_request request = {.num_points = 256, .dimension = 2, .seed = 1};
    BENCH_TRY(ps_sampler_parse(&request, "jittered", error));
    const ps_power_question question = {.sampler = &request,
                                        .num_realizations = num_realizations,
                                        .max_frequency = 32,
                                        .tolerance = 1e-6,
                                        .constraints = {.precision = -1},
                                        .device = getenv("POINTSPEC_DEVICE")};
    ps_power_job *job = NULL;
    struct rusage usage;
    const double begin = bench_seconds();
    BENCH_TRY(ps_power_job_create(&job, &question, error));
    BENCH_TRY(ps_power_job_run(job, error));
    const double seconds = bench_seconds() - begin;
    const ps_spectrum_bin *bin = &ps_power_job_spectrum(job)->bins[0];
    getrusage(RUSAGE_SELF, &usage);
    printf("%12llu %12ld %14.2f %10.3f %12.6f %12.6f\n", (unsigned long long)num_realizations,
           usage.ru_maxrss / 1024, seconds / (double)num_realizations * 1e6, seconds, bin->power,
           bin->standard_error);
    fflush(stdout);
    ps_power_job_destroy(job);
}

int main(int argc, char **argv) {
    static char *const defaults[] = {"100", "1000", "10000", "100000"};
    char *const *words = argc > 1 ? argv + 1 : defaults;
    const int num = argc > 1 ? argc - 1 : (int)(sizeof defaults / sizeof defaults[0]);
    printf("%12s %12s %14s %10s %12s %12s\n", "realizations", "largest MiB", "us/realization",
           "seconds", "P of ring 1", "std error");
    fflush(stdout);
    for (int i = 0; i < num; i++) {
        const pid_t child = fork();
        if (child == 0) {
            run_job((uint64_t)strtod(words[i], NULL));
            return 0;
        }
        waitpid(child, NULL, 0);
    }
    return 0;
}
