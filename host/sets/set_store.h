/* Sets of samplers that take long to make, kept on the disk (store/result_cache.h).
 *
 * A set is found by all that its bits depend on: sampler, version of the algorithm, parameters,
 * number of points, dimension, seed and realization. What is kept are the sampler's own points as
 * float64, bit for bit, before they are lifted, homogenized or morphed. A set that is damaged is
 * made anew. Several threads may use one handle.
 */
#ifndef PS_SETS_SET_STORE_H
#define PS_SETS_SET_STORE_H

#include "samplers/sampler.h"

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

#endif
