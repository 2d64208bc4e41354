/* Inside of ps_variance_job, for the files variance_*.c only. */
#ifndef PS_JOBS_VARIANCE_VARIANCE_JOB_PRIVATE_H
#define PS_JOBS_VARIANCE_VARIANCE_JOB_PRIVATE_H

#include "jobs/variance/variance_job.h"
#include "jobs/variance/variance_sets.h"

struct ps_variance_job {
    const ps_variance_question *question;
    ps_power_question spectrum_question;
    ps_power_job *spectrum;
    ps_integrand **integrands;      /* [num] */
    double *held;                   /* [num] of the energy, up to the cut-off */
    ps_mean *measured;              /* [num] */
    ps_block_sums *measured_blocks; /* [num] */
    ps_variance_row *rows;          /* [num] */
    double reach;                   /* the largest frequency or degree that matters */
    ps_power_beyond beyond;
    ps_shape shape;            /* where bounds were asked for */
    ps_variance_sets files;    /* {0} of a sampler */
    ps_variance_trials trials; /* num_shifts 0: none */
    double trial_bytes;
    double image_seconds; /* of the powers of integrands that are points; 0: there are none */
};

/* What is measured, once the spectrum is planned, and does it fit into the memory? */
pspec_status ps_variance_trials_prepare(ps_variance_job *job, ps_error *error) PS_MUST_CHECK;
/* Fills measured; nan where nothing is. */
pspec_status ps_variance_trials_measure(ps_variance_job *job, ps_error *error) PS_MUST_CHECK;
/* The check of a single set: fills pairwise of the rows; nan where there is none. */
pspec_status ps_variance_trials_sum_pairs(ps_variance_job *job, ps_error *error) PS_MUST_CHECK;

#endif
