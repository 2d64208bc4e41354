/* Measures of point sets (measures.h), averaged over realizations, with standard errors: those of
 * their mean spectrum, then those of sets one after the other.
 */
#ifndef PS_JOBS_MEASURE_MEASURE_JOB_H
#define PS_JOBS_MEASURE_MEASURE_JOB_H

#include "jobs/measure/measures.h"
#include "jobs/spectrum/power_job.h"
#include "plan/phases.h"

typedef struct ps_measure_question {
    /* Of the spectrum, and of the points; open_device must be there, with doubles */
    ps_power_question spectrum;
    ps_checkpoint_spec checkpoint; /* of the sets */
    ps_measure_set wanted;
    bool are_named; /* measures that take long are made of large sets, too */
} ps_measure_question;

/* Is anything wanted that the spectrum says? */
bool ps_measure_has_spectrum(const ps_measure_question *question);
/* Adds what is done beside the spectrum; num_points of a set of a sampler, 0: nobody knows. */
void ps_measure_phases(const ps_measure_question *question, ps_phases *phases);

typedef struct ps_measure_result {
    uint64_t num_realizations, smallest_points, largest_points;
    double mean_points;
    unsigned dimension;
    ps_measure_set known;    /* those of such points that were wanted */
    ps_measure_set left_out; /* of these, since a set has too many points */
    ps_mean values[PS_NUM_MEASURES];
    ps_mean correlation[NEAR_BINS]; /* g; nan: unknown */
    ps_mean number_variance[NEAR_WINDOWS];
    double reach;           /* of both, in units of N^(-1/d), on the sphere of sqrt(4 pi / N) */
    ps_source *source;      /* of files, which the spectrum read, too */
    ps_power_job *spectrum; /* NULL: nothing that is wanted is of it */
    ps_error no_exponent;   /* why the spectrum has no exponent; else PSPEC_OK */
} ps_measure_result;

/* *out is {0} before, and freed by ps_measure_result_free, also after an error. The question must
 * outlive it. */
pspec_status ps_measure_run(ps_measure_result *out, ps_measure_question *question,
                            ps_error *error) PS_MUST_CHECK;
void ps_measure_result_free(ps_measure_result *result);

#endif
