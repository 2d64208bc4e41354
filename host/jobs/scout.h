/* A second reader of a file, ahead of the one that reads it: it counts a set that is too large to
 * be in memory, and of which weights and number of points are to be known before the first block.
 */
#ifndef PS_JOBS_SCOUT_H
#define PS_JOBS_SCOUT_H

#include "jobs/source.h"

typedef struct ps_scout {
    ps_point_reader *reader; /* NULL: none yet */
    uint64_t num_sets;       /* passed by it */
} ps_scout;

/* Counts the set with that number, from 1 on, of the file, whose earlier ones it may have passed.
 * count->realization is kept. */
pspec_status ps_scout_count(ps_scout *scout, const char *path, const ps_source_options *options,
                            uint64_t number, ps_pattern_count *count,
                            ps_error *error) PS_MUST_CHECK;

/* Leaves the file; the next set is one of another. */
void ps_scout_close(ps_scout *scout);

#endif
