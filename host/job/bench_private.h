/* What the files job/bench*.c share: an engine timed on the realizations of a case. */
#ifndef PS_JOB_BENCH_PRIVATE_H
#define PS_JOB_BENCH_PRIVATE_H

#include "job/bench.h"
#include "job/stress_sample.h"
#include "plan/choose.h"

/* Realizations of the case, in host memory. */
typedef struct ps_bench_sets {
    const ps_bench_case *what;
    size_t num, capacity;
    pspec_pattern *patterns;
    double *scales;
} ps_bench_sets;

/* Room for num realizations; points are made when they are asked for. */
pspec_status ps_bench_sets_create(ps_bench_sets *out, const ps_bench_case *what, uint64_t num,
                                  ps_error *error) PS_MUST_CHECK;
void ps_bench_sets_free(ps_bench_sets *sets);

/* What a user would ask: all realizations of the case. The tolerance is the caller's. */
ps_problem ps_bench_problem(const ps_bench_case *what, const ps_stress_sample *sample,
                            const ps_device_limits *limits);

typedef struct ps_bench_time {
    double seconds; /* of a realization */
    double flops;   /* of a realization, as the launches count */
} ps_bench_time;

/* Would a realization take so long that the row is left out? */
bool ps_bench_is_affordable(const ps_bench_options *options, const ps_candidate *candidate,
                            const ps_problem *problem);

/* The median of some runs of a candidate that applies. */
pspec_status ps_bench_measure_time(ps_bench_sets *sets, const ps_problem *problem,
                                   const ps_candidate *candidate, ps_device *device,
                                   const ps_bench_options *options, ps_bench_time *out,
                                   ps_error *error) PS_MUST_CHECK;

bool ps_bench_wants_case(const ps_bench_options *options, const ps_bench_case *what);
bool ps_bench_wants(const ps_bench_options *options, const ps_candidate *candidate);
pspec_status ps_bench_go_on(const ps_bench_options *options, ps_error *error) PS_MUST_CHECK;

#endif
