/* What a question does not need: every skip with its reason and its share of the work. */
#ifndef PS_PLAN_NEEDS_H
#define PS_PLAN_NEEDS_H

#include "base/text.h"
#include "plan/specs.h"

#include <stdbool.h>
#include <stdint.h>

/* The question, as far as skipping goes. */
typedef struct ps_needs_question {
    unsigned dimension;
    int32_t max_frequency;         /* of a grid; 0 for a list of frequencies */
    int64_t max_norm2;             /* of its bins (frequencies/frequencies.h) */
    bool on_sphere, on_hemisphere; /* degrees instead of frequencies */
    bool wants_full_array;         /* every frequency of the box, corners too */
    double share_not_drawn;    /* of the frequencies of the rings, when a random subset is to do */
    bool has_constant_power;   /* all realizations have the same power: deterministic, or shifted */
    bool is_homogenized;       /* a random shift of every realization was asked for */
    uint64_t num_realizations; /* 0: not known */
    ps_accuracy_spec accuracy;
    double expected_realizations; /* that white noise takes to it */
    bool wants_frequency_errors;  /* standard errors of single frequencies, of a grid */
} ps_needs_question;

typedef struct ps_skip {
    char what[80], why[160];
    double share;             /* of the work that would be done without this skip */
    bool is_matter_of_course; /* of any job: `plan` lists it, headers of results do not */
} ps_skip;

enum { PS_MAX_SKIPS = 16 };

typedef struct ps_needs {
    bool one_realization; /* one stands for all */
    bool sequential;      /* no more realizations than the standard error takes */
    bool no_shift;
    bool no_frequency_errors; /* only bins have standard errors */
    bool no_skip;             /* of the question */
    size_t num_skips;
    size_t num_of_question; /* of them, first, that do not depend on the plan */
    ps_skip skips[PS_MAX_SKIPS];
} ps_needs;

ps_needs ps_needs_find(const ps_needs_question *question);
/* One more skip of the question, before a plan is made. */
void ps_needs_add(ps_needs *needs, const char *what, const char *why, double share);

/* The share of a skip, once the plan tells more of it than the question does; nothing where there
 * is no such skip. */
void ps_needs_rate(ps_needs *needs, const char *what, double share);
#define PS_SKIP_CORNERS "corners of the box"

/* What a job would be without skips. */
typedef struct ps_needs_strict {
    double tolerance;     /* that holds without a statistical target */
    double other_seconds; /* of the job beside its engine */
} ps_needs_strict;

/* Makes the plan, and finds what of its precision and of the machine nobody needs. With
 * needs->no_skip it is a plan in double precision, where engines and device have it; that, at
 * strict->tolerance, is what shares are of. May be called again for the same needs, when powers
 * were measured: what it had found is found anew. */
pspec_status ps_needs_plan(ps_needs *needs, ps_plan *plan, const ps_problem *problem,
                           const ps_device_limits *limits, const ps_plan_constraints *constraints,
                           const ps_needs_strict *strict, ps_error *error) PS_MUST_CHECK;

/* "what (why)" of every skip that is no matter of course, separated by "; ", or "nothing". */
void ps_needs_describe(const ps_needs *needs, ps_text *text);

#endif
