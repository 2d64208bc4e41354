/* Questions to the planner and machines that do not exist, to answer them for. */
#ifndef PS_TESTS_HARNESS_PLAN_H
#define PS_TESTS_HARNESS_PLAN_H

#include "harness.h"

#include "plan/choose.h"

ps_device_limits test_cpu(void);
ps_device_limits test_gpu(bool has_fp64);
ps_device_limits test_h200(void);

/* A ball, not enumerated. */
ps_frequencies test_lattice(unsigned dimension, int32_t max_frequency);
/* A hundred realizations. */
ps_problem test_problem(const ps_frequencies *set, uint64_t num_points, double tolerance);

extern const ps_plan_constraints test_any_plan; /* nothing is forced */
void test_make_plan(ps_plan *plan, const ps_problem *problem, const ps_device_limits *limits,
                    const ps_plan_constraints *constraints);
const ps_candidate *test_candidate(const ps_plan *plan, const char *engine, ps_precision precision);

#endif
