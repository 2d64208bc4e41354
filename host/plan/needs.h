/* What a question does not need: every skip with its reason and its share of the work. */
#ifndef PS_PLAN_NEEDS_H
#define PS_PLAN_NEEDS_H

#include "base/text.h"

#include <stdbool.h>
#include <stdint.h>

/* The question, as far as skipping goes. */
typedef struct ps_needs_question {
    unsigned dimension;
    int32_t max_frequency;         /* of a grid; 0 for a list of frequencies */
    bool on_sphere, on_hemisphere; /* degrees instead of frequencies */
    bool wants_full_array;         /* every frequency of the box, corners too */
    double share_not_drawn;    /* of the frequencies of the rings, when a random subset is to do */
    bool has_constant_power;   /* all realizations have the same power: deterministic, or shifted */
    bool is_homogenized;       /* a random shift of every realization was asked for */
    uint64_t num_realizations; /* 0: not known */
    double standard_error;     /* realizations are to stop at it; 0: all of them are wanted */
    double expected_realizations; /* that white noise takes to it */
    bool no_skip;                 /* the user wants everything done; symmetries stay */
} ps_needs_question;

typedef struct ps_skip {
    const char *what, *why;
    double share; /* of the work that would be done without this skip */
} ps_skip;

enum { PS_MAX_SKIPS = 8 };

typedef struct ps_needs {
    bool only_ball;       /* leave the corners of the box out */
    bool one_realization; /* one stands for all */
    bool sequential;      /* no more realizations than the standard error takes */
    bool no_shift;
    size_t num_skips;
    ps_skip skips[PS_MAX_SKIPS];
} ps_needs;

ps_needs ps_needs_find(const ps_needs_question *question);

/* "what (why)" of every skip, separated by "; ", or "nothing". */
void ps_needs_describe(const ps_needs *needs, ps_text *text);

#endif
