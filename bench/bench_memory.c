/* Largest resident memory and seconds per realization of whole jobs against the number of
 * realizations: memory must not grow with it. Then what plan announces against what there was:
 * buffers of the device, and all memory.
 *
 *     bench_memory [M...]          default 100 1000 10000 of jittered, N = 256, K = 32
 *     bench_memory plan            announced against measured only
 *
 * Every job runs in a process of its own, so that its largest memory is its own.
 */
#include "bench.h"

#include "jobs/spectrum/power_job.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

static void run_job(uint64_t num_realizations) {
    ps_sampler_request request = {.num_points = 256, .dimension = 2, .seed = 1};
    BENCH_TRY(ps_sampler_parse(&request, "jittered", error));
    const ps_power_question question = {.sampler = &request,
                                        .num_realizations = num_realizations,
                                        .frequencies.max_frequency = 32,
                                        .accuracy.tolerance = 1e-6,
                                        .limits.constraints = {.precision = -1},
                                        .limits.device = getenv("POINTSPEC_DEVICE")};
    ps_power_job *job = NULL;
    struct rusage usage;
    const double begin = bench_seconds();
    BENCH_TRY(ps_power_job_create(&job, &question, error));
    BENCH_TRY(ps_power_job_run(job, error));
    const double seconds = bench_seconds() - begin;
    const ps_spectrum_bin *bin = &job->spectrum.bins[0];
    getrusage(RUSAGE_SELF, &usage);
    printf("%12llu %12ld %14.2f %10.3f %12.6f %12.6f\n", (unsigned long long)num_realizations,
           usage.ru_maxrss / 1024, seconds / (double)num_realizations * 1e6, seconds, bin->power,
           bin->standard_error);
    fflush(stdout);
    ps_power_job_destroy(job);
}

/* ---- announced and measured -------------------------------------------------------------- */

typedef struct memory_case {
    unsigned dimension; /* 0: the sphere, k is the largest degree */
    size_t num_points;
    int32_t k;
    ps_harmonics harmonics; /* with coefficients of one set; else there are 4 */
} memory_case;

static const memory_case cases[] = {{2, 256, 32, PS_NO_HARMONICS},
                                    {2, 1024, 128, PS_NO_HARMONICS},
                                    {2, 4096, 256, PS_NO_HARMONICS},
                                    {2, 16384, 512, PS_NO_HARMONICS},
                                    {3, 4096, 32, PS_NO_HARMONICS},
                                    {1, 65536, 32768, PS_NO_HARMONICS},
                                    {2, 10000000, 1024, PS_NO_HARMONICS},
                                    {0, 16384, 512, PS_NO_HARMONICS},
                                    {0, 16384, 512, PS_SPHERICAL_HARMONICS},
                                    {0, 16384, 2000, PS_SPHERICAL_HARMONICS},
                                    {0, 1000000, 1000, PS_HEMISPHERICAL_HARMONICS}};

static long resident_kibibytes(void) {
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

/* What the driver and its compiler take shows in a job of nothing: it is left out. */
static void compare_memory(const memory_case *what) {
    const bool on_sphere = what->dimension == 0;
    ps_sampler_request request = {.num_points = what->num_points,
                                  .dimension = on_sphere ? PS_VECTOR_DIMENSION : what->dimension,
                                  .seed = 1};
    BENCH_TRY(ps_sampler_parse(&request, on_sphere ? "white-hemisphere" : "white", error));
    const ps_power_question question = {.sampler = &request,
                                        .num_realizations =
                                            what->harmonics != PS_NO_HARMONICS ? 1 : 4,
                                        .on_sphere = on_sphere,
                                        .max_degree = what->k,
                                        .harmonics = what->harmonics,
                                        .frequencies.max_frequency = what->k,
                                        .accuracy.tolerance = 1e-6,
                                        .limits.constraints = {.precision = -1},
                                        .limits.device = getenv("POINTSPEC_DEVICE")};
    ps_power_job *job = NULL;
    BENCH_TRY(ps_power_job_create(&job, &question, error));
    const long before = resident_kibibytes();
    BENCH_TRY(ps_power_job_run(job, error));
    const ps_candidate *chosen = job->plan.chosen;
    const double mega = 1e6;
    const double buffers = (double)ps_device_most_buffer_bytes(job->device);
    printf("%2u %9zu %6d %-13s %10.3f %10.3f %6.3f %10.1f %10.1f\n", what->dimension,
           what->num_points, (int)what->k, chosen->engine->name, chosen->device_bytes / mega,
           buffers / mega, chosen->device_bytes / buffers, chosen->bytes / mega,
           (double)(resident_kibibytes() - before) * 1024 / mega);
    fflush(stdout);
    ps_power_job_destroy(job);
}

static void compare_all(void) {
    printf("\n%2s %9s %6s %-13s %10s %10s %6s %10s %10s\n", "d", "N", "K", "engine", "announced",
           "buffers", "ratio", "all MB", "grown by");
    fflush(stdout);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const pid_t child = fork();
        if (child == 0) {
            compare_memory(&cases[i]);
            _exit(0);
        }
        waitpid(child, NULL, 0);
    }
}

int main(int argc, char **argv) {
    if (argc == 2 && strcmp(argv[1], "plan") == 0) {
        compare_all();
        return 0;
    }
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
    compare_all();
    return 0;
}
