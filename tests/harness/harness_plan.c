#include "harness_plan.h"

#include <stdio.h>
#include <string.h>

/* ---- machines that do not exist ------------------------------------------------------------ */

ps_device_limits test_cpu(void) {
    return (ps_device_limits){.name = "a CPU",
                              .is_cpu = true,
                              .has_fp64 = true,
                              .compute_units = 8,
                              .clock_mhz = 3000,
                              .native_float_lanes = 8,
                              .native_double_lanes = 4,
                              .max_work_group_size = 4096,
                              .global_bytes = (uint64_t)16 << 30,
                              .max_allocation_bytes = (uint64_t)4 << 30,
                              .local_bytes = 32 << 10,
                              .cache_bytes = 16 << 20};
}

ps_device_limits test_gpu(bool has_fp64) {
    return (ps_device_limits){.name = "a GPU",
                              .is_gpu = true,
                              .has_fp64 = has_fp64,
                              .has_dedicated_local_memory = true,
                              .compute_units = 40,
                              .clock_mhz = 1500,
                              .native_float_lanes = 1,
                              .native_double_lanes = has_fp64 ? 1 : 0,
                              .max_work_group_size = 1024,
                              .global_bytes = (uint64_t)8 << 30,
                              .max_allocation_bytes = (uint64_t)2 << 30,
                              .local_bytes = 64 << 10,
                              .cache_bytes = 4 << 20};
}

/* As NVIDIA's driver has it, which takes some of the 48 KB of local memory. */
ps_device_limits test_h200(void) {
    ps_device_limits limits = test_gpu(true);
    snprintf(limits.name, sizeof limits.name, "NVIDIA H200");
    limits.compute_units = 132;
    limits.clock_mhz = 1980;
    limits.global_bytes = (uint64_t)139 << 30;
    limits.max_allocation_bytes = limits.global_bytes / 4;
    limits.local_bytes = (48 << 10) - 16;
    limits.double_cost = 2;
    return limits;
}

/* ---- problems ------------------------------------------------------------------------------ */

ps_frequencies test_lattice(unsigned dimension, int32_t max_frequency) {
    ps_frequencies set = {0};
    assert_ok(ps_frequencies_lattice(&set, dimension, max_frequency, true, error));
    return set;
}

ps_problem test_problem(const ps_frequencies *set, uint64_t num_points, double tolerance) {
    return (ps_problem){.frequencies = set,
                        .num_points = num_points,
                        .num_realizations = 100,
                        .tolerance = tolerance};
}

const ps_plan_constraints test_any_plan = {.precision = -1};

void test_make_plan(ps_plan *plan, const ps_problem *problem, const ps_device_limits *limits,
                    const ps_plan_constraints *constraints) {
    assert_ok(ps_plan_make(plan, problem, limits, constraints, error));
}

const ps_candidate *test_candidate(const ps_plan *plan, const char *engine,
                                   ps_precision precision) {
    for (size_t i = 0; i < plan->num_candidates; i++) {
        if (strcmp(plan->candidates[i].engine->name, engine) == 0 &&
            plan->candidates[i].precision == precision) {
            return &plan->candidates[i];
        }
    }
    fail_msg("no candidate %s %s", engine, ps_precision_name(precision));
    return NULL;
}
