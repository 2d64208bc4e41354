#include "plan/choose.h"

#include "base/memory.h"
#include "base/round.h"
#include "base/text.h"
#include "plan/cost_model.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static pspec_status check_engine_name(const char *name, unsigned domain, ps_error *error) {
    const char *nearest = ps_engines[0]->name;
    for (const ps_engine *const *engine = ps_engines; name != NULL && *engine != NULL; engine++) {
        if (strcmp((*engine)->name, name) == 0) {
            return (*engine)->domains & domain
                       ? PSPEC_OK
                       : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                                 "the engine %s is not for points on the %s", name,
                                 domain == PS_ON_SPHERE ? "sphere" : "torus");
        }
        if (ps_text_distance((*engine)->name, name) < ps_text_distance(nearest, name)) {
            nearest = (*engine)->name;
        }
    }
    return name == NULL ? PSPEC_OK
                        : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                                  "there is no engine \"%s\"; the nearest is %s", name, nearest);
}

/* Memory of a batch, on the device and on the host: that of the engine, and what else a job keeps
 * (job/estimator, analysis/accumulate, bins, spectrum). */
typedef struct memory {
    double device, host;
} memory;

/* Realizations side by side in sums of pieces of bins: whole vectors, shorter ones where most lanes would be empty
 * (analysis/accumulate_device). */
static double padded_rows(const ps_device_limits *limits, ps_precision precision, size_t batch) {
    unsigned lanes = ps_engine_lanes(limits, precision);
    while (lanes > 1 && lanes >= 4 * batch) {
        lanes /= 2;
    }
    return (double)ps_round_up(batch, lanes);
}

/* Of rows of powers on the device: their sums and sums of squares in pairs, also read back; members of bins, and
 * the pieces of bins in the blocks of 512 slots of a row: 3 numbers for each, and its sum in pairs. In one dimension
 * all frequencies of a block are one piece; else rings cross a block in about 36. */
static void add_accumulator(memory *sum, const ps_work *work, const ps_problem *problem,
                            double rows, double real_bytes) {
    const double block = 512;
    const double pieces_of_block = problem->frequencies->dimension == 1 ? 1 : 36;
    const double num = (double)problem->frequencies->num;
    const double blocks = ceil(work->row_bytes / real_bytes / block);
    const double pieces = fmin(num, blocks * pieces_of_block);
    sum->device += 4 * work->row_bytes + num * (double)sizeof(uint16_t) +
                   pieces * (2 * rows * real_bytes + 3 * (double)sizeof(uint32_t));
    sum->host += 4 * work->row_bytes;
}

/* Coordinates and weights of a set on the host, or of a block. */
static double set_bytes(const ps_problem *problem, const ps_work *work) {
    const unsigned columns = problem->frequencies->dimension + (problem->has_weights ? 1 : 0);
    const uint64_t points = work->takes_blocks && problem->block_points > 0 ? problem->block_points
                                                                            : problem->num_points;
    return (double)points * columns * (double)sizeof(double);
}

static memory count_memory(const ps_candidate *candidate, const ps_problem *problem,
                           const ps_work *work, const ps_device_limits *limits, size_t batch) {
    const unsigned dimension = problem->frequencies->dimension;
    const double num = (double)problem->frequencies->num;
    const double moved = limits != NULL && limits->has_unified_memory ? work->coordinate_bytes : 0;
    /* of every frequency twice its vector and its slot, its place in a bin, mean and standard error */
    memory sum = {.device =
                      work->fixed_bytes - work->host_bytes +
                      (work->bytes_per_realization + work->point_bytes + moved) * (double)batch,
                  .host = work->host_bytes +
                          (set_bytes(problem, work) + work->point_bytes - moved) * (double)batch +
                          num * (2 * dimension * (double)sizeof(int32_t) +
                                 3 * (double)sizeof(uint32_t) + 2 * (double)sizeof(double))};
    if (limits == NULL || candidate->engine->rows_on_host) {
        sum.host += num * 4 * (double)sizeof(double); /* the sums of the accumulator */
    }
    if (limits == NULL) {
        sum.host += sum.device;
        sum.device = 0;
    }
    if (limits == NULL || candidate->engine->rows_on_host) {
        return sum;
    }
    add_accumulator(&sum, work, problem, padded_rows(limits, candidate->precision, batch),
                    candidate->precision == PS_SINGLE ? sizeof(float) : sizeof(double));
    return sum;
}

/* Seconds, bytes and error of a candidate that applies. A realization of a batch is kept on the host,
 * too, as coordinates and weights. A limit that somebody set makes batches smaller. */
static void estimate(ps_candidate *candidate, const ps_problem *problem,
                     const ps_device_limits *limits, uint64_t memory_limit) {
    const ps_device_limits *used = candidate->engine->needs_device ? limits : NULL;
    const ps_work work = candidate->engine->work(problem, used, candidate->precision);
    const memory one = count_memory(candidate, problem, &work, used, 1);
    ps_work whole = work; /* with host memory */
    whole.bytes_per_realization += set_bytes(problem, &work);
    whole.fixed_bytes = one.device + one.host - whole.bytes_per_realization - work.point_bytes;
    candidate->batch = ps_cost_batch(&whole, used, problem->num_realizations);
    memory sum = count_memory(candidate, problem, &work, used, candidate->batch);
    while (memory_limit > 0 && candidate->batch > 1 &&
           sum.device + sum.host > (double)memory_limit) {
        candidate->batch /= 2;
        sum = count_memory(candidate, problem, &work, used, candidate->batch);
    }
    candidate->seconds = ps_cost_seconds(&work, used, candidate->precision);
    candidate->device_bytes = sum.device;
    candidate->bytes = sum.device + sum.host;
    candidate->error =
        candidate->engine->error(problem, used, candidate->precision, ps_expected_power(problem));
}

/* Does the user's choice of engine or precision rule it out? */
static bool exclude(ps_candidate *candidate, const ps_plan_constraints *constraints) {
    if (constraints->engine != NULL && strcmp(constraints->engine, candidate->engine->name) != 0) {
        snprintf(candidate->reason, sizeof candidate->reason, "--engine %s excludes it",
                 constraints->engine);
        return true;
    }
    if (constraints->precision >= 0 && constraints->precision != (int)candidate->precision) {
        snprintf(candidate->reason, sizeof candidate->reason, "--precision %s excludes it",
                 ps_precision_name((ps_precision)constraints->precision));
        return true;
    }
    return false;
}

/* The user's limit, else the smaller of what the device and the machine have. */
static uint64_t find_memory_limit(const ps_candidate *candidate, const ps_device_limits *limits,
                                  const ps_plan_constraints *constraints) {
    uint64_t limit = ps_memory_installed();
    if (constraints->memory_limit > 0) {
        return constraints->memory_limit;
    }
    if (limits != NULL && candidate->engine->needs_device &&
        (limit == 0 || limits->global_bytes < limit)) {
        limit = limits->global_bytes;
    }
    return limit;
}

static void judge(ps_candidate *candidate, const ps_problem *problem,
                  const ps_device_limits *limits, const ps_plan_constraints *constraints) {
    const char *why_not = NULL;
    const uint64_t limit = find_memory_limit(candidate, limits, constraints);
    candidate->is_excluded = exclude(candidate, constraints);
    candidate->is_applicable =
        candidate->engine->applicable(problem, limits, candidate->precision, &why_not);
    if (candidate->is_applicable) {
        estimate(candidate, problem, limits, constraints->memory_limit);
    }
    if (candidate->is_excluded) {
        return;
    }
    if (!candidate->is_applicable) {
        snprintf(candidate->reason, sizeof candidate->reason, "%s", why_not);
    } else if (candidate->error > problem->tolerance) {
        snprintf(candidate->reason, sizeof candidate->reason, "error above the tolerance %g",
                 problem->tolerance);
    } else if (limit > 0 && candidate->bytes > (double)limit) {
        snprintf(candidate->reason, sizeof candidate->reason,
                 "needs %.3g bytes of memory, above the limit of %.3g", candidate->bytes,
                 (double)limit);
    } else {
        candidate->is_feasible = true;
    }
}

static void choose_cheapest(ps_plan *plan) {
    ps_candidate *best = NULL;
    for (size_t i = 0; i < plan->num_candidates; i++) {
        ps_candidate *candidate = &plan->candidates[i];
        if (candidate->is_feasible && (best == NULL || candidate->seconds < best->seconds)) {
            best = candidate;
        }
    }
    for (size_t i = 0; best != NULL && i < plan->num_candidates; i++) {
        ps_candidate *candidate = &plan->candidates[i];
        if (candidate->is_feasible && candidate != best) {
            snprintf(candidate->reason, sizeof candidate->reason, "%.3g times slower",
                     candidate->seconds / best->seconds);
        }
    }
    if (best != NULL) {
        best->is_chosen = true;
        snprintf(best->reason, sizeof best->reason, "cheapest within the tolerance");
    }
    plan->chosen = best;
}

bool ps_plan_may_need_device(const ps_plan_constraints *constraints) {
    for (const ps_engine *const *engine = ps_engines; *engine != NULL; engine++) {
        const bool may_run =
            (constraints->engine == NULL || strcmp(constraints->engine, (*engine)->name) == 0) &&
            (constraints->precision < 0 || (*engine)->has_precision[constraints->precision]);
        if (may_run && (*engine)->needs_device) {
            return true;
        }
    }
    return false;
}

double ps_plan_tolerance(double tolerance, double floor) {
    const double relative_error = 0.1;
    const double deviations = 3;
    const double by_floor = relative_error / 2 * sqrt(floor) / deviations;
    return floor > 0 && by_floor < tolerance ? by_floor : tolerance;
}

pspec_status ps_plan_make(ps_plan *plan, const ps_problem *problem, const ps_device_limits *limits,
                          const ps_plan_constraints *constraints, ps_error *error) {
    *plan = (ps_plan){0};
    PS_TRY(check_engine_name(constraints->engine, ps_problem_domain(problem), error));
    for (const ps_engine *const *engine = ps_engines; *engine != NULL; engine++) {
        for (int precision = PS_SINGLE; precision <= PS_EXTENDED; precision++) {
            if (!((*engine)->domains & ps_problem_domain(problem)) ||
                !(*engine)->has_precision[precision] || plan->num_candidates == PS_MAX_CANDIDATES) {
                continue;
            }
            ps_candidate *candidate = &plan->candidates[plan->num_candidates++];
            candidate->engine = *engine;
            candidate->precision = (ps_precision)precision;
            judge(candidate, problem, limits, constraints);
        }
    }
    choose_cheapest(plan);
    return PSPEC_OK;
}

/* The candidate that is exact enough and needs the least memory; there is one. */
static const ps_candidate *find_smallest(const ps_plan *plan, double tolerance) {
    const ps_candidate *smallest = NULL;
    for (size_t i = 0; i < plan->num_candidates; i++) {
        const ps_candidate *candidate = &plan->candidates[i];
        if (!candidate->is_excluded && candidate->is_applicable && candidate->error <= tolerance &&
            (smallest == NULL || candidate->bytes < smallest->bytes)) {
            smallest = candidate;
        }
    }
    return smallest;
}

pspec_status ps_plan_require(const ps_plan *plan, const ps_problem *problem, ps_error *error) {
    const ps_candidate *best = NULL;  /* the most exact one that the user's choice leaves */
    const ps_candidate *other = NULL; /* any that it leaves */
    if (plan->chosen != NULL) {
        return PSPEC_OK;
    }
    for (size_t i = 0; i < plan->num_candidates; i++) {
        const ps_candidate *candidate = &plan->candidates[i];
        if (candidate->is_excluded) {
            continue;
        }
        other = candidate;
        if (candidate->is_applicable && (best == NULL || candidate->error < best->error)) {
            best = candidate;
        }
    }
    if (other == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "no engine is left: the engine asked for does not have that precision");
    }
    if (best == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "no engine can do this; %s (%s): %s",
                       other->engine->name, ps_precision_name(other->precision), other->reason);
    }
    if (best->error > problem->tolerance) {
        return ps_fail(error, PSPEC_ERROR_TOLERANCE,
                       "tolerance %g cannot be reached: the smallest error is %.2g (%s, %s)",
                       problem->tolerance, best->error, best->engine->name,
                       ps_precision_name(best->precision));
    }
    const ps_candidate *smallest = find_smallest(plan, problem->tolerance);
    return ps_fail(error, PSPEC_ERROR_MEMORY, "%s (%s) %s%s", smallest->engine->name,
                   ps_precision_name(smallest->precision), smallest->reason,
                   problem->frequencies->kind == PS_FREQUENCIES_BOX ||
                           problem->frequencies->kind == PS_FREQUENCIES_BALL
                       ? "; a random subset of the frequencies of every ring (--per-ring) needs "
                         "less"
                       : "");
}
