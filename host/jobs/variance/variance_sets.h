/* The sets of point files whose variance is asked for: the first half of them predicts, the second
 * is measured; where nothing is to be measured all of them predict. A single set is both: nothing
 * of it is random but where it is moved to. */
#ifndef PS_JOBS_VARIANCE_VARIANCE_SETS_H
#define PS_JOBS_VARIANCE_VARIANCE_SETS_H

#include "jobs/spectrum/power_job.h"

typedef struct ps_variance_sets {
    ps_source *source;
    unsigned dimension;
    uint64_t num, num_predicting; /* sets; the first of them */
    size_t most_points;           /* of any set */
    double *weights;              /* of a file of their own; NULL: sets have theirs */
    size_t num_weights;
    double white; /* mean of V/W^2 over those that predict: 1/N of unit weights */
    double size;  /* (sum |w|)^2 / W^2 of the first set */
} ps_variance_sets;

/* Opens the files of a question, counts and checks all sets, and goes back to the first.
 * ps_variance_sets_close also after an error. */
pspec_status ps_variance_sets_open(ps_variance_sets *sets, const ps_power_question *question,
                                   bool measures, ps_error *error) PS_MUST_CHECK;
void ps_variance_sets_close(ps_variance_sets *sets);

/* Sets that are measured; those of a single one are moves of it. */
uint64_t ps_variance_sets_measured(const ps_variance_sets *sets);
/* To the first set that is measured. */
pspec_status ps_variance_sets_seek(ps_variance_sets *sets, ps_error *error) PS_MUST_CHECK;
/* The next set of a source, whole, whatever its size is. It must be there. */
pspec_status ps_variance_sets_next(ps_source *source, ps_point_set *set,
                                   ps_error *error) PS_MUST_CHECK;

#endif
