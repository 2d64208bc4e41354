/* What benchmark programs share: a clock, random points, the device's measured peak, and engines
 * run by hand with the error measured beside the time.
 */
#ifndef BENCH_H
#define BENCH_H

#include "engines/engine.h"
#include "verify/bench/bench.h"

#include <stddef.h>
#include <stdint.h>

/* Ends the program with the sentence when a call fails: benchmarks have nothing to go on with. */
#define BENCH_TRY(call)                                                                            \
    do {                                                                                           \
        ps_error bench_error = {0};                                                                \
        ps_error *const error = &bench_error;                                                      \
        if ((call) != PSPEC_OK) {                                                                  \
            bench_die(error->message);                                                             \
        }                                                                                          \
    } while (0)

void bench_die(const char *message);
/* Prints the cases of a program, a line each, where "--cases" is the only argument; else false. */
bool bench_lists_cases(int argc, char **argv, const char *const *cases, size_t num);
double bench_seconds(void);
/* Of the processor, of this thread alone: others may be busy. */
double bench_thread_seconds(void);

/* count numbers in [0,1), the same for the same seed. The caller frees them. */
double *bench_uniform(size_t count, uint64_t seed);

/* One run, flop/s: verify/bench/device_peaks.h. */
double bench_peak_run(const ps_peak *peak);

/* One engine on R realizations of N white points with scale 1/N. */
typedef struct bench_job {
    const ps_engine *engine;
    ps_precision precision;
    ps_device *device;
    ps_frequencies frequencies;
    size_t num_points, num_realizations, batch;
    double *points;
    pspec_pattern *patterns;
    double *scales;
    void *state;
    uint32_t *slots;
} bench_job;

/* Why the engine cannot do it, or NULL. */
const char *bench_why_not(const ps_engine *engine, ps_precision precision,
                          const ps_problem *problem, ps_device *device);
void bench_job_create(bench_job *job, const ps_engine *engine, ps_precision precision,
                      double tolerance, ps_device *device, ps_frequencies frequencies,
                      size_t num_points, size_t num_realizations);
/* The same for a problem, whose frequencies the job takes over. */
void bench_job_create_for(bench_job *job, const ps_engine *engine, ps_precision precision,
                          const ps_problem *problem, ps_device *device);
/* All realizations once; seconds. rows are those of the last batch. */
double bench_job_run(bench_job *job, ps_rows *rows);
/* Root mean square of | |S| - |S_referee| | over some frequencies of the first realization, in
 * units of sqrt(N). */
double bench_job_error(bench_job *job);
void bench_job_destroy(bench_job *job);

/* The median of num numbers (which are sorted). */
double bench_median(double *numbers, size_t num);

#endif
