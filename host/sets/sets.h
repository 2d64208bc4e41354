/* The realizations of a sampler, one after the other: expensive ones from the store, or made and
 * then kept there (set_store.c), by all processors ahead of who takes them.
 *
 * Every realization depends on its number alone, so that nothing of this can be seen in points.
 */
#ifndef PS_SETS_SETS_H
#define PS_SETS_SETS_H

#include "samplers/sampler.h"

/* ---- the store --------------------------------------------------------------------------- */

/* Sets of samplers that take long to make, kept on the disk (store/result_cache.h).
 *
 * A set is found by all that its bits depend on: sampler, version of the algorithm, parameters,
 * number of points, dimension, seed and realization. What is kept are the sampler's own points as
 * float64, bit for bit, before they are lifted, homogenized or morphed. A set that is damaged is
 * made anew. Several threads may use one handle.
 */

/* Where sets are kept. */
typedef struct ps_set_place {
    const char
        *cache_folder;  /* of ours, in which there is a folder of sets; NULL: nothing is kept */
    uint64_t max_bytes; /* of all sets; 0: nothing is kept */
} ps_set_place;

typedef struct ps_set_store ps_set_store;

/* Does a set of the request take so long that it is worth keeping? */
bool ps_sets_are_expensive(const ps_sampler_request *request);
/* Are sets of the request kept there? Not those that are cheap, or alone above the limit. */
bool ps_set_place_takes(const ps_set_place *place, const ps_sampler_request *request);

/* The request must outlive the store. Makes the folder unless it is there. */
pspec_status ps_set_store_open(ps_set_store **out, const ps_sampler_request *request,
                               const ps_set_place *place, ps_error *error) PS_MUST_CHECK;
/* NULL is allowed. */
void ps_set_store_close(ps_set_store *store);

/* The sampler's own points of a realization, as ps_sampler_make gives them: kept ones, or made and
 * then kept. What is wrong with the store is no error. */
pspec_status ps_set_store_make(ps_set_store *store, uint64_t realization, double *points,
                               size_t *num_points, const ps_watch *watch,
                               ps_error *error) PS_MUST_CHECK;

/* What ps_set_store_make has done so far. */
typedef struct ps_set_counts {
    uint64_t num_read, num_kept; /* taken from the store, put there */
    uint64_t num_lost;           /* made, and refused by the store */
    unsigned num_damaged;        /* and made anew */
} ps_set_counts;
ps_set_counts ps_set_store_counts(const ps_set_store *store);
/* The first thing that was wrong with the store; "" where nothing was. For who has waited until no
 * other thread uses it. */
const char *ps_set_store_trouble(const ps_set_store *store);

/* How many of the first num realizations of a request are kept, by the names of the files; of more
 * than ten thousand as many as those let expect. Makes no folder. */
uint64_t ps_sets_count_kept(const ps_sampler_request *request, const ps_set_place *place,
                            uint64_t num);
/* Seconds in which a kept set is read. */
double ps_set_store_seconds(const ps_sampler_request *request);
/* What a set takes on the disk, about. */
uint64_t ps_set_store_bytes(const ps_sampler_request *request);

/* ---- the realizations -------------------------------------------------------------------- */

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
/* Leaves out so many of the next ones, of which none is made. */
void ps_sets_skip(ps_sets *sets, uint64_t num);

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
