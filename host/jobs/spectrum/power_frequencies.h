/* Which frequencies a power job looks at. */
#ifndef PS_JOBS_SPECTRUM_POWER_FREQUENCIES_H
#define PS_JOBS_SPECTRUM_POWER_FREQUENCIES_H

#include "jobs/spectrum/power_job.h"

/* The list that the question names, or the box, ball or random subset of rings up to its largest
 * frequency (default: 5 N^(1/d) for d <= 3). num_points, dimension and box are those of the first
 * set.
 */
pspec_status ps_power_frequencies(ps_frequencies *out, const ps_power_question *question,
                                  unsigned dimension, size_t num_points, const ps_box *box,
                                  ps_error *error) PS_MUST_CHECK;

/* The largest frequency or degree that there would be if question->useful did not cut; 0: nothing
 * is cut, or nobody can tell. */
int32_t ps_power_frequencies_uncut(const ps_power_question *question, unsigned dimension,
                                   size_t num_points);

#endif
