/* Sentences for plans that nothing is left of: what stands in the way, and what would help. */
#include "engines/error_units.h"
#include "plan/choose.h"
#include "plan/memory_model.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

const ps_candidate *ps_plan_fitting(const ps_plan *plan) {
    const ps_candidate *best = NULL;
    for (size_t i = 0; i < plan->num_candidates; i++) {
        const ps_candidate *candidate = &plan->candidates[i];
        if (candidate->is_feasible && !candidate->is_crowded &&
            (best == NULL || candidate->cost < best->cost)) {
            best = candidate;
        }
    }
    return best;
}

bool ps_plan_misses_floor(const ps_candidate *candidate) {
    return candidate->floor_error > PS_FLOOR_ERROR;
}

/* The candidate that is exact enough and needs the least memory; there is one. */
static const ps_candidate *find_smallest(const ps_plan *plan, double tolerance) {
    const ps_candidate *smallest = NULL;
    for (size_t i = 0; i < plan->num_candidates; i++) {
        const ps_candidate *candidate = &plan->candidates[i];
        if (!candidate->is_excluded && candidate->is_applicable && candidate->error <= tolerance &&
            !ps_plan_misses_floor(candidate) &&
            (smallest == NULL || candidate->bytes < smallest->bytes)) {
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
    if (plan->would_fit_subset) {
        snprintf(out, out_bytes,
                 "; a random subset of the frequencies of every ring (--per-ring) needs less");
    } else if (kind == PS_FREQUENCIES_DEGREES && plan->largest_degree > 0) {
        snprintf(out, out_bytes, "; the largest degree that fits%s is %d",
                 problem->harmonics != PS_NO_HARMONICS ? ", with coefficients," : "",
                 (int)plan->largest_degree);
    }
}

/* What else there is room for, as the end of a sentence: a limit that chooses it, or its name where
 * it is not memory that tells it from the chosen one. */
static void say_what_is_smaller(char *out, size_t out_bytes, const ps_plan *plan) {
    const uint64_t megabyte = (uint64_t)1 << 20;
    const ps_candidate *const fitting = ps_plan_fitting(plan);
    char bytes[PS_SIZE_TEXT];
    char size[PS_SIZE_TEXT];
    out[0] = '\0';
    if (fitting == NULL) {
        return;
    }
    const uint64_t room = isfinite(fitting->host_room) ? (uint64_t)fitting->host_room : 0;
    const uint64_t limit = room / megabyte * megabyte;
    const bool is_told_apart =
        (double)limit >= fitting->bytes && (double)limit < plan->chosen->bytes;
    snprintf(size, sizeof size, "%lluM", (unsigned long long)(limit / megabyte));
    snprintf(out, out_bytes, "; %s %s takes %s (%s) instead, %s and about %.2g seconds",
             is_told_apart ? "--memory" : "--engine", is_told_apart ? size : fitting->engine->name,
             fitting->engine->name, ps_precision_name(fitting->precision),
             ps_size_show(bytes, fitting->bytes), fitting->seconds);
}

/* Is there an engine of the host for it that would find room where no driver is loaded? */
static bool has_host_engine(const ps_plan *plan, const ps_problem *problem) {
    for (size_t i = 0; i < plan->num_candidates; i++) {
        const ps_candidate *const one = &plan->candidates[i];
        if (!one->is_excluded && one->is_applicable && !one->engine->needs_device &&
            one->error <= problem->tolerance && one->host_bytes <= PS_MEMORY_OF_DRIVER) {
            return true;
        }
    }
    return false;
}

/* The limit of the process that would do, where it is one that is in the way, and an engine that
 * needs no driver; as the end of a sentence. */
static void say_what_would_do(char *out, size_t out_bytes, const ps_plan *plan,
                              const ps_problem *problem) {
    const double step = 1e4; /* KiB: what is used changes by a little from start to start */
    /* Each thread of the driver takes so much of malloc's address space where there is room. */
    const double arena = 64.0 * 1024 * 1024;
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    const ps_candidate *const chosen = plan->chosen;
    const double kept = chosen->engine->needs_device ? PS_MEMORY_OF_DRIVER : PS_MEMORY_OF_PROGRAM;
    const double missing = chosen->host_bytes + kept - (double)plan->room.bytes;
    const char *const other = chosen->engine->needs_device && has_host_engine(plan, problem)
                                  ? "; --engine host_direct needs no driver"
                                  : "";
    ps_memory_limits limits;
    ps_memory_limits_find(&limits, "");
    const bool is_own = limits.least == PS_MEMORY_ADDRESS_SPACE || limits.least == PS_MEMORY_DATA;
    if (!is_own || strcmp(limits.bounds[limits.least].place, plan->room.by) != 0) {
        snprintf(out, out_bytes, "%s", other);
        return;
    }
    const double arenas =
        limits.least == PS_MEMORY_ADDRESS_SPACE && chosen->engine->needs_device && processors > 0
            ? (double)processors * arena
            : 0;
    const double kibibytes = ((double)limits.bounds[limits.least].limit + missing + arenas) / 1024;
    snprintf(out, out_bytes, "; %.16s %.0f would do%s", plan->room.by,
             ceil(kibibytes / step + 1) * step, other);
}

/* There is no room for the chosen one. */
static pspec_status fail_crowded(const ps_plan *plan, const ps_problem *problem, ps_error *error) {
    const ps_candidate *const chosen = plan->chosen;
    char needed[PS_SIZE_TEXT];
    char there[PS_SIZE_TEXT];
    char kept[PS_SIZE_TEXT];
    char advice[192];
    const double reserve = (double)plan->room.bytes - chosen->host_room;
    say_what_is_smaller(advice, sizeof advice, plan);
    if (advice[0] == '\0') {
        say_what_fits(advice, sizeof advice, plan, problem);
    }
    if (advice[0] == '\0') {
        say_what_would_do(advice, sizeof advice, plan, problem);
    }
    return ps_fail(error, PSPEC_ERROR_MEMORY,
                   "%s (%s) needs %s of memory, but %s leaves %s, and %s of them are kept for %s%s",
                   chosen->engine->name, ps_precision_name(chosen->precision),
                   ps_size_show(needed, chosen->host_bytes), plan->room.by,
                   ps_size_show(there, (double)plan->room.bytes), ps_size_show(kept, reserve),
                   chosen->engine->needs_device ? "the OpenCL driver" : "the program", advice);
}

pspec_status ps_plan_require(const ps_plan *plan, const ps_problem *problem, ps_error *error) {
    const ps_candidate *best = NULL;  /* the most exact one that the user's choice leaves */
    const ps_candidate *other = NULL; /* any that it leaves */
    const bool is_on_sphere = ps_problem_domain(problem) == PS_ON_SPHERE;
    if (plan->chosen != NULL) {
        return plan->chosen->is_crowded ? fail_crowded(plan, problem, error) : PSPEC_OK;
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
