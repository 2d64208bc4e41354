/* The variance of Monte Carlo integration of several integrands by the sets of one sampler, or of
 * point files: predicted from their spectrum, and measured by moved sets beside it.
 *
 * Realizations 0 .. M - 1 predict, M .. 2M - 1 are measured, so that the two are independent; of
 * files the first half predicts and the second is measured. A single set, and that of a sampler
 * without randomness, is both, and its sum over pairs is the check. The formulas are in
 * docs/user/variance.md; N is the mean number of points.
 */
#ifndef PS_JOBS_VARIANCE_VARIANCE_JOB_H
#define PS_JOBS_VARIANCE_VARIANCE_JOB_H

#include "jobs/variance/prediction.h"
#include "jobs/variance/rates.h"
#include "jobs/variance/variance_sets.h"
#include "plan/phases.h"
#include "spectra/shape/shape.h"

typedef struct ps_variance_question {
    /* Of the prediction, under the normalization of integrals: a sampler, or files, with where
     * their points are; its weighted sums, and the sets of files, are set here. The measurement of
     * a sampler has as many realizations, and the same watch and device. */
    ps_power_question spectrum;
    const char *const *texts;  /* of the integrands */
    ps_given_integrands given; /* those that some of them may name; borrowed */
    ps_made_integrands *made;  /* of all questions that share them, and outlives their jobs */
    size_t num_integrands;
    /* The sum is over the exact shells of a ball instead of a box: of isotropic integrands */
    bool over_shells;
    bool wants_paper; /* (E-13) beside it, of radial integrands (jobs/variance/formulas.h) */
    ps_bounds_spec bounds;
    uint64_t num_shifts;    /* trials of each set that is measured; 0: nothing is */
    uint64_t single_shifts; /* the same of a single set of a file */
    uint64_t seed;          /* of the trials of files; a sampler has its own */
    const char *name;       /* of a set among others, whose trials are its own; NULL: files alone */
    unsigned trials_part;   /* that the checkpoint of the trials is, beside that of the spectrum */
    bool is_moved; /* trials are shifted or rotated at random; else sets stay where they are */
} ps_variance_question;

/* Of one integrand. nan: there is none; of the prediction of one that is given, too. */
typedef struct ps_variance_row {
    ps_prediction prediction;
    double best_bound, worst_bound;  /* by the profiles below and above; nan unless asked for */
    double paper;                    /* (E-13); nan unless it was asked for */
    double measured, measured_error; /* about the known integral; error over sets */
    double z_score;                  /* nan: sets are not moved, or what varies is rounding */
    double pairwise;                 /* of a single set, exactly: (V2), (S1'), (H1'); nan: none */
} ps_variance_row;

/* Larger single sets are not summed over pairs, which takes N^2/2 steps of the host. */
enum { PS_MOST_PAIRWISE_POINTS = 1024 };

/* Nothing of its sets is random but where they are moved to: there is one set, and one spectrum. */
bool ps_variance_has_one_set(const ps_sampler_request *sampler);

/* What is measured. */
typedef struct ps_variance_trials {
    bool is_one_set;
    uint64_t num_sets;   /* of one set 1 */
    uint64_t num_shifts; /* trials of each */
} ps_variance_trials;

typedef struct ps_variance_job {
    const ps_variance_question *question;
    ps_power_question spectrum_question;
    ps_power_job *spectrum;         /* of the prediction: its plan, and what it found */
    ps_integrand **integrands;      /* [num], of question->made */
    double *held;                   /* [num] of the energy, up to the cut-off */
    ps_mean *measured;              /* [num] */
    ps_block_sums *measured_blocks; /* [num] */
    ps_variance_row *rows;          /* [num], after run */
    double reach;                   /* the largest frequency or degree that matters */
    ps_power_beyond beyond;         /* the power that `upper` has beyond the cut-off, after run */
    ps_shape shape;                 /* profiles of bounds, where they were asked for, after run */
    ps_variance_sets files;         /* {0} of a sampler */
    ps_variance_trials trials;      /* num_shifts 0: none */
    ps_sampler_request measured_sampler; /* whose sets are moved by trials alone; {0} of files */
    double trial_bytes;
    double image_seconds; /* of the powers of integrands that are points; 0: there are none */
} ps_variance_job;

/* Are there such integrands where the points are? Of files on the torus, whose dimension is not
 * known yet, the job says so. */
pspec_status ps_variance_question_check(const ps_variance_question *question,
                                        ps_error *error) PS_MUST_CHECK;

/* Parses the integrands and plans the spectrum. The question must outlive the job. */
pspec_status ps_variance_job_create(ps_variance_job **out, const ps_variance_question *question,
                                    ps_error *error) PS_MUST_CHECK;
void ps_variance_job_destroy(ps_variance_job *job); /* NULL is allowed */
pspec_status ps_variance_job_run(ps_variance_job *job, ps_error *error) PS_MUST_CHECK;

/* Adds what the measurement comes to: its points, and trials. */
void ps_variance_job_phases(const ps_variance_job *job, ps_phases *phases);
/* The logarithm of a number of a row, after run. */
typedef enum ps_variance_number {
    PS_VARIANCE_PREDICTED,
    PS_VARIANCE_LOWER,
    PS_VARIANCE_UPPER,
    PS_VARIANCE_MEASURED
} ps_variance_number;
void ps_variance_job_log(const ps_variance_job *job, size_t integrand, ps_variance_number number,
                         ps_log_variance *out);

/* ---- the parts of create and run that are in variance_trials.c ------------------------------- */

/* What is measured, once the spectrum is planned, and does it fit into the memory? */
pspec_status ps_variance_trials_prepare(ps_variance_job *job, ps_error *error) PS_MUST_CHECK;
/* Fills measured; nan where nothing is. */
pspec_status ps_variance_trials_measure(ps_variance_job *job, ps_error *error) PS_MUST_CHECK;
/* The check of a single set: fills pairwise of the rows; nan where there is none. */
pspec_status ps_variance_trials_sum_pairs(ps_variance_job *job, ps_error *error) PS_MUST_CHECK;

#endif
