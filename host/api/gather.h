/* Small calls gathered into batches: patterns are checked and copied until there is a batch for the
 * estimator. What is handed over in whole batches passes through without a copy.
 */
#ifndef PS_API_GATHER_H
#define PS_API_GATHER_H

#include "jobs/estimator.h"

typedef struct ps_gather ps_gather;

typedef struct ps_gather_options {
    ps_estimator *estimator; /* must outlive the gatherer */
    unsigned dimension;
    size_t num_points; /* of a pattern, as far as known: how much to allocate */
    /* Called after each batch that the estimator took; a failure ends the call. May be NULL. */
    pspec_status (*after_batch)(void *payload, ps_error *error);
    void *payload;
} ps_gather_options;

/* Allocates all that it will ever need, at most 64 MiB of coordinates and weights. */
pspec_status ps_gather_create(ps_gather **out, const ps_gather_options *options,
                              ps_error *error) PS_MUST_CHECK;
void ps_gather_destroy(ps_gather *gather);

/* Adds realizations, in order. After a failure reset comes first. */
pspec_status ps_gather_add(ps_gather *gather, const pspec_pattern *patterns, size_t num_patterns,
                           ps_error *error) PS_MUST_CHECK;
/* Runs what is pending. */
pspec_status ps_gather_flush(ps_gather *gather, ps_error *error) PS_MUST_CHECK;
/* Forgets what is pending. */
void ps_gather_reset(ps_gather *gather);

#endif
