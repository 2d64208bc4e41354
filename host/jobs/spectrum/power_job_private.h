/* Inside of ps_power_job, for the files power_job*.c only. */
#ifndef PS_JOBS_SPECTRUM_POWER_JOB_PRIVATE_H
#define PS_JOBS_SPECTRUM_POWER_JOB_PRIVATE_H

#include "jobs/estimator.h"
#include "jobs/runner.h"
#include "jobs/source.h"
#include "jobs/spectrum/empty_axis.h"
#include "jobs/spectrum/power_job.h"

/* The point sets of a power job on their way from the source to the estimator: batches of sets that
 * are in memory, and sets that are not, in blocks.
 */

/* Of more nobody sees single points in a panel of a picture. */
enum { PS_MOST_POINTS_KEPT = 16384 };

typedef struct ps_power_sets {
    ps_source *source;
    bool is_borrowed;         /* the source */
    const char *weights_path; /* NULL: none; the same weights for every set */
    double *weights;
    size_t num_weights;
    ps_point_set next; /* read, but not yet taken: a set or the first block of one */
    ps_source_part part;
    bool has_next;
    ps_point_set after; /* next, where it was read to learn whether there is one */
    ps_source_part after_part;
    bool has_after;
    ps_point_set *sets; /* [capacity] a batch */
    pspec_pattern *patterns;
    size_t capacity;
    size_t used; /* points of next that the estimator has had */
    uint64_t num_streamed;
    ps_boxes boxes; /* of all sets that were read */
    /* Where the points of the first set are; only with looks_at_axes */
    bool looks_at_axes, has_looked;
    ps_axis_cells first_cells;
    /* A copy of the first set, without weights, if it has no more than PS_MOST_POINTS_KEPT points
     * and came whole; only with keeps_first */
    bool keeps_first, has_kept;
    ps_point_set first;
} ps_power_sets;

void ps_power_sets_free(ps_power_sets *sets);
pspec_status ps_power_sets_read_weights(ps_power_sets *sets, const char *path, uint64_t num_points,
                                        ps_error *error) PS_MUST_CHECK;
/* Room for batches of so many. */
pspec_status ps_power_sets_allocate(ps_power_sets *sets, size_t capacity,
                                    ps_error *error) PS_MUST_CHECK;
/* Gives back what sets take; they are to be read again. */
void ps_power_sets_release(ps_power_sets *sets);
/* Back to the first set. */
pspec_status ps_power_sets_rewind(ps_power_sets *sets, ps_error *error) PS_MUST_CHECK;

/* Reads ahead: *has_set tells whether sets->next is a set, which sets->part describes. */
pspec_status ps_power_sets_peek(ps_power_sets *sets, bool *has_set, ps_error *error) PS_MUST_CHECK;
/* Whether no set comes after sets->next, which is one. Of a set that is not whole nobody knows. */
pspec_status ps_power_sets_is_last(ps_power_sets *sets, bool *is_last,
                                   ps_error *error) PS_MUST_CHECK;
uint64_t ps_power_sets_next_points(const ps_power_sets *sets);

/* Fills patterns[*num] with the next sets, `most` at most. The batch ends before a set that comes
 * in blocks, if the estimator can stream. Where *num is 0 and has_next is true, the next set is
 * such a one, for ps_power_sets_stream; where has_next is false, there are no more. */
pspec_status ps_power_sets_fill(ps_power_sets *sets, bool can_stream, uint64_t most, size_t *num,
                                ps_error *error) PS_MUST_CHECK;
/* Gives the estimator the next set in blocks. */
pspec_status ps_power_sets_stream(ps_power_sets *sets, ps_estimator *estimator,
                                  pspec_normalization normalization, ps_error *error) PS_MUST_CHECK;

struct ps_power_job {
    const ps_power_question *question;
    ps_power_sets sets;          /* of files, the first is read for planning */
    ps_device_sets *device_sets; /* instead, where the device makes them; else NULL */
    unsigned dimension;
    uint64_t num_points;  /* of the first set, or that a sampler is asked for */
    uint64_t most_points; /* of any set, as far as it is known */
    ps_frequencies frequencies;
    ps_needs needs;
    char useless[48];           /* the skip of frequencies that do not matter; "": there is none */
    ps_sampler_request request; /* what is really sampled: without a shift nobody needs */
    uint64_t num_realizations;  /* that are computed; 0: unknown */
    ps_problem problem;
    ps_device *device;
    bool owns_device;
    ps_plan plan;
    ps_runner runner;
    ps_spectrum spectrum;
    double *coefficients; /* of a realization */
    /* On the torus [num_kept][1 + number of frequencies][2], S(0) first; room for so many */
    double *kept;
    size_t num_kept, kept_room;
    ps_mean *c2;
    double *weights;                /* [num_weighted][number of frequencies] */
    ps_mean *weighted;              /* [num_weighted] */
    ps_block_sums *weighted_blocks; /* the same */
    ps_text description;
    ps_mean *means; /* [all bins] for looks at the standard error */
    ps_sequential_look look;
};

/* Does the device make the sampler's points, as the plan is? */
bool ps_power_job_leaves_points(const ps_power_job *job);
/* Then tells the estimator, before the first realization; and ps_runner_kind.give. */
pspec_status ps_power_device_sets_begin(ps_power_job *job, ps_error *error) PS_MUST_CHECK;
pspec_status ps_power_device_sets_give(ps_power_job *job, uint64_t most, size_t *num,
                                       ps_error *error) PS_MUST_CHECK;

/* Memory for the coefficients that were asked for, if any; frequencies are enumerated. */
pspec_status ps_power_coefficients_begin(ps_power_job *job, ps_error *error) PS_MUST_CHECK;
/* ps_estimator_options.keep on the torus; payload is the job. */
pspec_status ps_power_coefficients_keep(void *payload, const double *coefficients,
                                        double weight_sum, ps_error *error) PS_MUST_CHECK;
/* Are so many sets not too many? */
pspec_status ps_power_coefficients_check(const ps_power_job *job, uint64_t num_sets,
                                         ps_error *error) PS_MUST_CHECK;

/* What it does not need. This fills job->needs from the question, once dimension and frequencies
 * are known. */
void ps_power_needs_find(ps_power_job *job);
/* The tolerance that the problem gets: what tolerance, standard error and floor ask for
 * together. */
double ps_power_needs_tolerance(const ps_power_question *question);
/* That the plan is made for. */
uint64_t ps_power_needs_realizations(const ps_power_job *job);
/* Fills job->plan for job->problem, and the rest of job->needs. */
pspec_status ps_power_needs_plan(ps_power_job *job, ps_error *error) PS_MUST_CHECK;

#endif
