#include "plan/choose.h"

#include "base/memory.h"
#include "base/text.h"
#include "engines/error_units.h"
#include "plan/cost_model.h"
#include "plan/memory_model.h"

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

/* Seconds, bytes and error of a candidate that applies. A realization of a batch is kept on the host,
 * too, as coordinates and weights. A limit that somebody set makes batches smaller. */
static void estimate(ps_candidate *candidate, const ps_problem *asked, const ps_survey *survey,
                     const ps_device_limits *limits, uint64_t memory_limit) {
    const ps_problem own = ps_engine_problem(candidate->engine, asked);
    const ps_problem *problem = &own;
    const ps_device_limits *used = candidate->engine->needs_device ? limits : NULL;
    const ps_work work = survey->work;
    const ps_memory one =
        ps_memory_count(candidate->engine, candidate->precision, problem, &work, used, 1);
    ps_work whole = work; /* with host memory */
    whole.bytes_per_realization += ps_memory_of_set(problem, &work);
    whole.fixed_bytes = one.device + one.host - whole.bytes_per_realization - work.point_bytes;
    candidate->batch = ps_cost_batch(&whole, used, problem->num_realizations);
    ps_memory sum = ps_memory_count(candidate->engine, candidate->precision, problem, &work, used,
                                    candidate->batch);
    while (memory_limit > 0 && candidate->batch > 1 &&
           sum.device + sum.host > (double)memory_limit) {
        candidate->batch /= 2;
        sum = ps_memory_count(candidate->engine, candidate->precision, problem, &work, used,
                              candidate->batch);
    }
    candidate->seconds = ps_cost_seconds(&work, used, candidate->precision) *
                         ps_figures_scale(limits != NULL ? limits->figures : NULL,
                                          candidate->engine->name, candidate->precision);
    candidate->device_bytes = sum.device;
    candidate->bytes = sum.device + sum.host;
    candidate->error = ps_engine_error_in(candidate->engine, asked, survey->error);
    candidate->floor_error = ps_engine_floor_error(candidate->engine, asked, survey->error);
}

/* What the engine says of it, asked once or part by part. */
static ps_survey survey_of(const ps_candidate *candidate, const ps_problem *problem,
                           const ps_device_limits *limits) {
    const ps_engine *engine = candidate->engine;
    const ps_precision precision = candidate->precision;
    const ps_device_limits *used = engine->needs_device ? limits : NULL;
    ps_survey survey = {0};
    if (engine->survey != NULL) {
        return engine->survey(problem, limits, precision);
    }
    if (engine->applicable(problem, limits, precision, &survey.why_not)) {
        survey.why_not = NULL;
        survey.work = engine->work(problem, used, precision);
        survey.error = engine->error(problem, used, precision, ps_expected_power(problem));
    }
    return survey;
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

/* The user's limit is for all of it; else buffers must fit into the device, and all of it into the machine. Writes the
 * reason where it does not fit. */
static bool fits_memory(ps_candidate *candidate, const ps_device_limits *limits,
                        const ps_plan_constraints *constraints) {
    const double limit = constraints->memory_limit > 0 ? (double)constraints->memory_limit
                                                       : (double)ps_memory_installed();
    const bool is_on_device =
        constraints->memory_limit == 0 && limits != NULL && candidate->engine->needs_device;
    if (is_on_device && candidate->device_bytes > (double)limits->global_bytes) {
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

static bool misses_floor(const ps_candidate *candidate) {
    return candidate->floor_error > PS_FLOOR_ERROR;
}

static void judge(ps_candidate *candidate, const ps_problem *problem,
                  const ps_device_limits *limits, const ps_plan_constraints *constraints) {
    const ps_problem own = ps_engine_problem(candidate->engine, problem);
    const ps_survey survey = survey_of(candidate, &own, limits);
    candidate->is_excluded = exclude(candidate, constraints);
    candidate->is_applicable = survey.why_not == NULL;
    if (candidate->is_applicable) {
        estimate(candidate, problem, &survey, limits, constraints->memory_limit);
    }
    if (candidate->is_excluded) {
        return;
    }
    if (!candidate->is_applicable) {
        snprintf(candidate->reason, sizeof candidate->reason, "%s", survey.why_not);
    } else if (candidate->error > problem->tolerance) {
        snprintf(candidate->reason, sizeof candidate->reason, "error above the tolerance %g",
                 problem->tolerance);
    } else if (misses_floor(candidate)) {
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
        if (candidate->is_feasible && is_asked &&
            (best == NULL || candidate->seconds < best->seconds)) {
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
            const bool is_faster = candidate->seconds < best->seconds;
            snprintf(candidate->reason, sizeof candidate->reason, "%.3g times %s",
                     is_faster ? best->seconds / candidate->seconds
                               : candidate->seconds / best->seconds,
                     is_faster ? "faster, but --no-skip takes double precision" : "slower");
        }
    }
    if (best != NULL) {
        ps_candidate *const chosen = &plan->candidates[best - plan->candidates];
        chosen->is_chosen = true;
        snprintf(chosen->reason, sizeof chosen->reason, "cheapest within the tolerance");
    }
    plan->chosen = best;
}

/* Nothing is feasible, and it is not the tolerance that stands in the way. */
static bool is_too_large(const ps_plan *plan, const ps_problem *problem) {
    bool has_exact = false;
    bool has_any = false;
    for (size_t i = 0; i < plan->num_candidates; i++) {
        const ps_candidate *candidate = &plan->candidates[i];
        const bool is_asked = !candidate->is_excluded && candidate->is_applicable;
        has_any = has_any || is_asked;
        has_exact = has_exact || (is_asked && candidate->error <= problem->tolerance);
    }
    return plan->chosen == NULL && (has_exact || !has_any);
}

/* With this largest degree instead of the problem's. */
static bool would_do(const ps_problem *problem, int32_t max_degree, const ps_device_limits *limits,
                     const ps_plan_constraints *constraints) {
    ps_frequencies degrees;
    ps_problem smaller = *problem;
    const bool only_even = problem->frequencies->degree_step > 1;
    if (ps_frequencies_degrees(&degrees, max_degree, only_even, NULL) != PSPEC_OK) {
        return false;
    }
    smaller.frequencies = &degrees;
    for (const ps_engine *const *engine = ps_engines; *engine != NULL; engine++) {
        for (int precision = PS_SINGLE; precision <= PS_EXTENDED; precision++) {
            ps_candidate candidate = {.engine = *engine, .precision = (ps_precision)precision};
            if ((*engine)->domains & PS_ON_SPHERE && (*engine)->has_precision[precision]) {
                judge(&candidate, &smaller, limits, constraints);
            }
            if (candidate.is_feasible) {
                return true;
            }
        }
    }
    return false;
}

/* Memory grows with the degree. */
static int32_t find_largest_degree(const ps_problem *problem, const ps_device_limits *limits,
                                   const ps_plan_constraints *constraints) {
    int32_t good = 0;
    int32_t bad = problem->frequencies->max_frequency;
    while (bad - good > 1) {
        const int32_t middle = good + (bad - good) / 2;
        if (would_do(problem, middle, limits, constraints)) {
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
    choose_cheapest(plan, constraints->prefers_double);
    if (ps_problem_domain(problem) == PS_ON_SPHERE && is_too_large(plan, problem)) {
        plan->largest_degree = find_largest_degree(problem, limits, constraints);
    }
    return PSPEC_OK;
}

/* The candidate that is exact enough and needs the least memory; there is one. */
static const ps_candidate *find_smallest(const ps_plan *plan, double tolerance) {
    const ps_candidate *smallest = NULL;
    for (size_t i = 0; i < plan->num_candidates; i++) {
        const ps_candidate *candidate = &plan->candidates[i];
        if (!candidate->is_excluded && candidate->is_applicable && candidate->error <= tolerance &&
            !misses_floor(candidate) && (smallest == NULL || candidate->bytes < smallest->bytes)) {
            smallest = candidate;
        }
    }
    return smallest;
}

/* What would need less than there is, as the end of a sentence. */
static void say_what_fits(char *out, size_t out_bytes, const ps_plan *plan,
                          const ps_problem *problem) {
    const ps_frequency_kind kind = problem->frequencies->kind;
    out[0] = '\0';
    if (kind == PS_FREQUENCIES_BOX || kind == PS_FREQUENCIES_BALL) {
        snprintf(out, out_bytes,
                 "; a random subset of the frequencies of every ring (--per-ring) needs less");
    } else if (kind == PS_FREQUENCIES_DEGREES && plan->largest_degree > 0) {
        snprintf(out, out_bytes, "; the largest degree that fits%s is %d",
                 problem->harmonics != PS_NO_HARMONICS ? ", with coefficients," : "",
                 (int)plan->largest_degree);
    }
}

pspec_status ps_plan_require(const ps_plan *plan, const ps_problem *problem, ps_error *error) {
    const ps_candidate *best = NULL;  /* the most exact one that the user's choice leaves */
    const ps_candidate *other = NULL; /* any that it leaves */
    const bool is_on_sphere = ps_problem_domain(problem) == PS_ON_SPHERE;
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
    char fitting[128];
    say_what_fits(fitting, sizeof fitting, plan, problem);
    if (best == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "no engine can do this; %s (%s): %s%s",
                       other->engine->name, ps_precision_name(other->precision), other->reason,
                       is_on_sphere ? fitting : "");
    }
    if (best->error > problem->tolerance) {
        return ps_fail(error, PSPEC_ERROR_TOLERANCE,
                       "tolerance %g cannot be reached: the smallest error is %.2g (%s, %s)",
                       problem->tolerance, best->error, best->engine->name,
                       ps_precision_name(best->precision));
    }
    const ps_candidate *smallest = find_smallest(plan, problem->tolerance);
    if (smallest == NULL) {
        return ps_fail(error, PSPEC_ERROR_TOLERANCE,
                       "powers of %g cannot be right to 10 %% with the engines left; %s (%s): %s",
                       problem->floor, best->engine->name, ps_precision_name(best->precision),
                       best->reason);
    }
    return ps_fail(error, PSPEC_ERROR_MEMORY, "%s (%s) %s%s", smallest->engine->name,
                   ps_precision_name(smallest->precision), smallest->reason, fitting);
}
