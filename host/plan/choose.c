#include "plan/choose.h"

#include "base/memory.h"
#include "base/text.h"
#include "engines/error_units.h"
#include "frequencies/frequency_sample.h"
#include "plan/cost_model.h"
#include "plan/memory_model.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

pspec_status ps_plan_check_engine(const char *name, unsigned domain, ps_error *error) {
    const char *nearest = NULL;
    for (const ps_engine *const *engine = ps_engines; name != NULL && *engine != NULL; engine++) {
        if (strcmp((*engine)->name, name) == 0) {
            return (*engine)->domains & domain
                       ? PSPEC_OK
                       : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                                 "the engine %s is not for points on the %s", name,
                                 domain == PS_ON_SPHERE ? "sphere" : "torus");
        }
        if ((*engine)->domains & domain) {
            ps_text_keep_nearest(name, (*engine)->name, &nearest);
        }
    }
    return name == NULL
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "there is no engine \"%s\"%s", name,
                         ps_text_suggest(name, nearest, ps_text_distance(name, nearest),
                                         "; the nearest is ", "")
                             .text);
}

/* Is the device's memory that of the machine? Its size then says nothing of the kind of device. */
static bool shares_memory(const ps_device_limits *limits) {
    return limits->is_cpu || limits->has_unified_memory;
}

static double room_of(const ps_candidate *candidate, const ps_memory_room *room) {
    const double kept =
        candidate->engine->needs_device ? PS_MEMORY_OF_DRIVER : PS_MEMORY_OF_PROGRAM;
    return room == NULL || room->bytes == UINT64_MAX ? INFINITY
                                                     : fmax((double)room->bytes - kept, 0);
}

/* limits: NULL for an engine of the host. */
static void set_bytes(ps_candidate *candidate, const ps_memory *sum, const ps_device_limits *limits,
                      const ps_memory_room *room) {
    const bool is_shared = limits != NULL && shares_memory(limits);
    candidate->device_bytes = sum->device;
    candidate->bytes = sum->device + sum->host;
    candidate->host_bytes = is_shared ? candidate->bytes : sum->host;
    candidate->host_room = room_of(candidate, room);
    candidate->is_crowded = candidate->host_bytes > candidate->host_room;
}

/* Where rows stay on the device, a program averages them there (spectra/accumulate/). */
static double programs_of_averages(const ps_engine *engine) {
    return engine->needs_device && !engine->rows_on_host ? 1 : 0;
}

/* Seconds, bytes and error of a candidate that applies. A realization of a batch is kept on the
 * host, too, as coordinates and weights. Limits make batches smaller. */
static void estimate(ps_candidate *candidate, const ps_problem *asked, const ps_survey *survey,
                     const ps_device_limits *limits, const ps_plan_constraints *constraints) {
    const ps_problem own = ps_engine_problem(candidate->engine, asked);
    const ps_problem *problem = &own;
    const ps_device_limits *used = candidate->engine->needs_device ? limits : NULL;
    const double limit = (double)constraints->memory_limit;
    const ps_work work = survey->work;
    ps_memory sum =
        ps_memory_count(candidate->engine, candidate->precision, problem, &work, used, 1);
    ps_work whole = work; /* with host memory */
    whole.bytes_per_realization += ps_memory_of_set(problem, &work);
    whole.fixed_bytes = sum.device + sum.host - whole.bytes_per_realization - work.point_bytes;
    const bool is_one_by_one = problem->harmonics != PS_NO_HARMONICS; /* coefficients are */
    candidate->batch =
        2 * ps_cost_batch(&whole, used, is_one_by_one ? 1 : problem->num_realizations);
    do {
        candidate->batch /= 2;
        sum = ps_memory_count(candidate->engine, candidate->precision, problem, &work, used,
                              candidate->batch);
        set_bytes(candidate, &sum, used, constraints->room);
    } while (candidate->batch > 1 &&
             (candidate->is_crowded || (limit > 0 && candidate->bytes > limit)));
    candidate->programs = work.programs + programs_of_averages(candidate->engine);
    candidate->cost = ps_cost_typical(&work, used, candidate->precision);
    candidate->seconds = ps_cost_seconds(&work, used, candidate->precision) *
                         ps_figures_scale(limits != NULL ? limits->figures : NULL,
                                          candidate->engine->name, candidate->precision);
    candidate->error = ps_engine_error_in(candidate->engine, asked, survey->error);
    candidate->floor_error = ps_engine_floor_error(candidate->engine, asked, survey->error);
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

/* The user's limit is for all of it; buffers must fit into a device that has memory of its own.
 * Writes the reason where it does not fit. */
static bool fits_memory(ps_candidate *candidate, const ps_device_limits *limits,
                        const ps_plan_constraints *constraints) {
    const double limit = (double)constraints->memory_limit;
    const bool has_own_memory =
        limits != NULL && candidate->engine->needs_device && !shares_memory(limits);
    if (has_own_memory && candidate->device_bytes > (double)limits->global_bytes) {
        snprintf(candidate->reason, sizeof candidate->reason,
                 "needs %.3g bytes of memory on the device, above its limit of %.3g",
                 candidate->device_bytes, (double)limits->global_bytes);
        return false;
    }
    if (limit > 0 && candidate->bytes > limit) {
        snprintf(candidate->reason, sizeof candidate->reason,
                 "needs %.3g bytes of memory, above the limit of %.3g", candidate->bytes, limit);
        return false;
    }
    return true;
}

static void judge(ps_candidate *candidate, const ps_problem *problem,
                  const ps_device_limits *limits, const ps_plan_constraints *constraints) {
    const ps_problem own = ps_engine_problem(candidate->engine, problem);
    const ps_survey survey = candidate->engine->survey(&own, limits, candidate->precision);
    candidate->is_excluded = exclude(candidate, constraints);
    candidate->is_applicable = survey.why_not == NULL;
    if (candidate->is_applicable) {
        estimate(candidate, problem, &survey, limits, constraints);
    }
    if (candidate->is_excluded) {
        return;
    }
    if (!candidate->is_applicable) {
        snprintf(candidate->reason, sizeof candidate->reason, "%s", survey.why_not);
    } else if (candidate->error > problem->tolerance) {
        snprintf(candidate->reason, sizeof candidate->reason, "error above the tolerance %g",
                 problem->tolerance);
    } else if (ps_plan_misses_floor(candidate)) {
        snprintf(candidate->reason, sizeof candidate->reason,
                 "%s has a floor: powers of %g would be off by %.2g of themselves",
                 candidate->engine->sums_pairs ? "a sum over pairs" : "a sum of squares",
                 problem->floor, candidate->floor_error);
    } else {
        candidate->is_feasible = fits_memory(candidate, limits, constraints);
    }
}

const ps_candidate *ps_plan_cheapest(const ps_plan *plan, int precision) {
    const ps_candidate *best = NULL;
    for (size_t i = 0; i < plan->num_candidates; i++) {
        const ps_candidate *candidate = &plan->candidates[i];
        const bool is_asked = precision < 0 || precision == (int)candidate->precision;
        if (candidate->is_feasible && is_asked && (best == NULL || candidate->cost < best->cost)) {
            best = candidate;
        }
    }
    return best;
}

static void choose_cheapest(ps_plan *plan, bool prefers_double) {
    const ps_candidate *best = prefers_double ? ps_plan_cheapest(plan, PS_DOUBLE) : NULL;
    best = best != NULL ? best : ps_plan_cheapest(plan, -1);
    for (size_t i = 0; best != NULL && i < plan->num_candidates; i++) {
        ps_candidate *candidate = &plan->candidates[i];
        if (candidate->is_feasible && candidate != best) {
            const bool is_faster = candidate->cost < best->cost;
            snprintf(candidate->reason, sizeof candidate->reason, "%.3g times %s",
                     is_faster ? best->cost / candidate->cost : candidate->cost / best->cost,
                     is_faster ? "faster, but --no-skip takes double precision" : "slower");
        }
    }
    if (best != NULL) {
        ps_candidate *const chosen = &plan->candidates[best - plan->candidates];
        chosen->is_chosen = true;
        snprintf(chosen->reason, sizeof chosen->reason, "cheapest within the tolerance%s",
                 chosen->is_crowded ? ", but there is no room for it now" : "");
    }
    plan->chosen = best;
}

/* Nothing is feasible, or there is room for nothing, and it is not the tolerance that stands in the
 * way. */
static bool is_too_large(const ps_plan *plan, const ps_problem *problem) {
    bool has_exact = false;
    bool has_any = false;
    for (size_t i = 0; i < plan->num_candidates; i++) {
        const ps_candidate *candidate = &plan->candidates[i];
        const bool is_asked = !candidate->is_excluded && candidate->is_applicable;
        has_any = has_any || is_asked;
        has_exact = has_exact || (is_asked && candidate->error <= problem->tolerance);
    }
    return ps_plan_fitting(plan) == NULL && (has_exact || !has_any);
}

/* Would the problem fit with these frequencies instead of its own? */
static bool would_do(const ps_problem *problem, const ps_frequencies *frequencies,
                     const ps_device_limits *limits, const ps_plan_constraints *constraints) {
    ps_problem smaller = *problem;
    smaller.frequencies = frequencies;
    for (const ps_engine *const *engine = ps_engines; *engine != NULL; engine++) {
        for (int precision = PS_SINGLE; precision <= PS_EXTENDED; precision++) {
            ps_candidate candidate = {.engine = *engine, .precision = (ps_precision)precision};
            if ((*engine)->domains & ps_problem_domain(problem) &&
                (*engine)->has_precision[precision]) {
                judge(&candidate, &smaller, limits, constraints);
            }
            if (candidate.is_feasible && !candidate.is_crowded) {
                return true;
            }
        }
    }
    return false;
}

/* With this largest degree instead of the problem's. */
static bool would_do_to(const ps_problem *problem, int32_t max_degree,
                        const ps_device_limits *limits, const ps_plan_constraints *constraints) {
    ps_frequencies degrees;
    const bool only_even = problem->frequencies->degree_step > 1;
    return ps_frequencies_degrees(&degrees, max_degree, only_even, NULL) == PSPEC_OK &&
           would_do(problem, &degrees, limits, constraints);
}

/* With the smallest subset of every ring, or as many other frequencies up to K: points may be what
 * there is too much of. */
static bool would_do_of_rings(const ps_problem *problem, const ps_device_limits *limits,
                              const ps_plan_constraints *constraints) {
    const ps_frequencies *const whole = problem->frequencies;
    const size_t num = (size_t)PS_MIN_PER_RING * (size_t)whole->max_frequency;
    ps_frequencies subset = {0};
    int32_t *vectors = NULL;
    if ((constraints->offers & PS_OFFER_RINGS) == 0 ||
        !ps_frequencies_can_sample(whole->dimension, whole->max_frequency) ||
        PS_NEW(&vectors, num * whole->dimension, "frequencies", NULL) != PSPEC_OK) {
        return false;
    }
    for (size_t i = 0; i < num; i++) {
        vectors[i * whole->dimension] = (int32_t)(i / PS_MIN_PER_RING) + 1;
    }
    const bool would_fit =
        ps_frequencies_list(&subset, whole->dimension, num, vectors, NULL) == PSPEC_OK &&
        would_do(problem, &subset, limits, constraints);
    ps_frequencies_free(&subset);
    return would_fit;
}

/* Memory grows with the degree. */
static int32_t find_largest_degree(const ps_problem *problem, const ps_device_limits *limits,
                                   const ps_plan_constraints *constraints) {
    int32_t good = 0;
    int32_t bad = problem->frequencies->max_frequency;
    while (bad - good > 1) {
        const int32_t middle = good + (bad - good) / 2;
        if (would_do_to(problem, middle, limits, constraints)) {
            good = middle;
        } else {
            bad = middle;
        }
    }
    return good;
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
    const double by_floor = ps_floor_amplitude(floor);
    return floor > 0 && by_floor < tolerance ? by_floor : tolerance;
}

double ps_plan_statistical_tolerance(double standard_error, double floor) {
    const double part = 3; /* numerical error and standard error add up like squares: 5 % at most */
    const double loosest = 1e-2; /* of S: far below the noise of any one realization */
    const double relative = fmin(PS_FLOOR_ERROR, standard_error / part);
    return fmin(loosest, ps_floor_amplitude(floor) * relative / PS_FLOOR_ERROR);
}

pspec_status ps_plan_make(ps_plan *plan, const ps_problem *problem, const ps_device_limits *limits,
                          const ps_plan_constraints *constraints, ps_error *error) {
    *plan = (ps_plan){.room = {.bytes = UINT64_MAX}};
    if (constraints->room != NULL) {
        plan->room = *constraints->room;
    }
    PS_TRY(ps_plan_check_engine(constraints->engine, ps_problem_domain(problem), error));
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
    choose_cheapest(plan, constraints->prefers_double);
    if (!is_too_large(plan, problem)) {
        return PSPEC_OK;
    }
    if (ps_problem_domain(problem) == PS_ON_SPHERE) {
        plan->largest_degree = find_largest_degree(problem, limits, constraints);
    } else if (problem->frequencies->kind != PS_FREQUENCIES_LIST) {
        plan->would_fit_subset = would_do_of_rings(problem, limits, constraints);
    }
    return PSPEC_OK;
}
