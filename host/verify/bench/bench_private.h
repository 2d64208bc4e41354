/* What the files of the benchmark share: an engine timed on the realizations of a case. */
#ifndef PS_VERIFY_BENCH_BENCH_PRIVATE_H
#define PS_VERIFY_BENCH_BENCH_PRIVATE_H

#include "plan/choose.h"
#include "verify/bench/bench.h"
#include "verify/stress_sample.h"

/* Realizations of the case, in host memory. */
typedef struct ps_bench_sets {
    const ps_stress_case *what;
    size_t num, capacity;
    pspec_pattern *patterns;
    double *scales;
} ps_bench_sets;

/* Room for num realizations; points are made when they are asked for. */
pspec_status ps_bench_sets_create(ps_bench_sets *out, const ps_stress_case *what, uint64_t num,
                                  ps_error *error) PS_MUST_CHECK;
void ps_bench_sets_free(ps_bench_sets *sets);

/* Neighbours of a machine come and go within seconds: every row of a case has a round before the
 * next one begins, so that they fall upon all of them. */
enum { PS_BENCH_ROUNDS = 3, PS_BENCH_RUNS = 3 };
static inline size_t ps_bench_num_rounds(const ps_suite_options *options) {
    return options->quick ? 1 : PS_BENCH_ROUNDS;
}

typedef struct ps_bench_time {
    size_t num;
    double seconds[PS_BENCH_ROUNDS * PS_BENCH_RUNS]; /* of a realization, of each run */
    double flops;                                    /* of a realization, as the launches count */
} ps_bench_time;

/* Returns the median of num numbers, and leaves them sorted. */
double ps_bench_median(double *numbers, size_t num);

/* Would a realization take so long that the row is left out? */
bool ps_bench_is_affordable(const ps_suite_options *options, const ps_candidate *candidate,
                            const ps_problem *problem);

/* A round of a candidate that applies: the times of its runs go behind those that are there. */
pspec_status ps_bench_measure_round(ps_bench_sets *sets, const ps_problem *problem,
                                    const ps_candidate *candidate, ps_device *device,
                                    const ps_suite_options *options, ps_bench_time *out,
                                    ps_error *error) PS_MUST_CHECK;

#endif
