/* The realizations of a sampler, one after the other: expensive ones from the store, or made and
 * then kept there (sets/set_store.h), by all processors ahead of who takes them.
 *
 * Every realization depends on its number alone, so that nothing of this can be seen in points.
 */
#ifndef PS_SETS_SETS_H
#define PS_SETS_SETS_H

#include "sets/set_store.h"

typedef struct ps_sets ps_sets;

typedef struct ps_sets_options {
    ps_set_place place;
    uint64_t memory_limit; /* of the job, of which sets made ahead take a 16th; 0: none */
    uint64_t first;        /* realization */
    const char *device; /* selector of the one that makes sets, opened when one must be made by it,
                            * and kept as long as the sets; NULL: the first */
    uint64_t taken;     /* of the limit, by the rest of the job: what is left bounds makers */
} ps_sets_options;

/* Realizations first .. first + num_realizations - 1; request is resolved, and copied, and so are
 * options, but for the names of folder and device. PSPEC_ERROR_MEMORY where the limit is less than
 * one set takes while it is made. */
pspec_status ps_sets_create(ps_sets **out, const ps_sampler_request *request,
                            uint64_t num_realizations, const ps_sets_options *options,
                            ps_error *error) PS_MUST_CHECK;
/* NULL is allowed. */
void ps_sets_destroy(ps_sets *sets);

/* The next realization, of which there must be one left, as ps_sampler_generate makes it. watch,
 * which may be NULL, is told at least ten times a second of work that takes long. Where it asks to
 * stop, the sentence says in which set that was, and what ps_sets_say_kept says. */
pspec_status ps_sets_next(ps_sets *sets, double *points, size_t *num_points, const ps_watch *watch,
                          ps_error *error) PS_MUST_CHECK;
/* Adds to the sentence of an interruption that sets are kept, where some are, and returns status.
 * Ends what is made ahead, until the next call of ps_sets_next. */
pspec_status ps_sets_say_kept(ps_sets *sets, pspec_status status, ps_error *error);
/* Back to the first. */
void ps_sets_rewind(ps_sets *sets);

/* Before the first is asked for: so much of the limit the rest of the job takes. */
void ps_sets_leave(ps_sets *sets, uint64_t taken);

/* Processors that make num realizations of the request: fewer where there is no memory for more. */
unsigned ps_sets_makers(const ps_sampler_request *request, const ps_sets_options *options,
                        uint64_t num);

/* What was wrong with the store, in a sentence, or "": sets that were damaged, a full disk. Ends
 * what is made ahead, until the next call of ps_sets_next. */
const char *ps_sets_trouble(ps_sets *sets);
/* What the store gave and took; nothing where sets are not kept. */
ps_set_counts ps_sets_counts(const ps_sets *sets);

#endif
