/* The averaged power spectrum, on the torus or on the sphere, as one job: source of realizations ->
 * plan -> batches -> spectrum.
 *
 * The tolerance is a contract. The plan predicts the error for sets like white noise; afterwards
 * the error formula is evaluated again with the powers that were measured
 * (docs/user/conventions.md). When it then exceeds the tolerance, the job runs once more with what
 * the plan chooses for those powers, or fails with PSPEC_ERROR_TOLERANCE when nothing reaches it or
 * the input cannot be read twice.
 */
#ifndef PS_JOBS_SPECTRUM_POWER_JOB_H
#define PS_JOBS_SPECTRUM_POWER_JOB_H

#include "base/watch.h"
#include "frequencies/frequencies_spec.h"
#include "jobs/rows/row_stream.h"
#include "jobs/runner.h"
#include "jobs/spectrum/power_sets.h"
#include "plan/needs.h"
#include "points/weights_spec.h"

typedef struct ps_power_question {
    /* realizations: a sampler, or files */
    const ps_sampler_request *sampler; /* NULL: files */
    uint64_t num_realizations;         /* of the sampler */
    const char *const *paths;
    size_t num_paths;
    ps_point_options point_options;
    ps_weights_spec weights;    /* never optimal */
    uint64_t whole_bytes;       /* of a set of a file, see ps_source_options */
    ps_source *source;          /* borrowed, of the files, at their first set; NULL: opened here */
    uint64_t num_sets;          /* the first of the files alone; 0: all */
    ps_realization_range range; /* the others are left to other jobs; not with num_sets */
    ps_replan replan;           /* of a range: what the plan of all of them is for */

    /* degrees, where points are on the sphere; frequencies are then not looked at */
    bool on_sphere;
    bool on_hemisphere; /* even degrees only */
    int64_t max_degree; /* 0: ceil(4 sqrt N) */

    /* frequencies */
    ps_frequencies_spec frequencies;
    /* rings, and K, are of the wave vectors of the first set's box, where it is no cube */
    bool has_rings_of_box;
    /* the largest frequency is this times N^(1/d) unless it is given, 0: 5; or less, but at least
     * twice N^(1/d), where a box has more frequencies than most_reached; 0: any */
    double reach, most_reached;
    /* The largest |k_i| or degree that matters to whoever asks: without accuracy.no_skip those
     * beyond are left out, and why says what nobody needs of them; 0: all matter */
    int32_t useful;
    const char *useful_why;
    uint64_t per_ring_seed;
    bool wants_full_array;

    /* result */
    bool wants_pair_sums; /* on the sphere: Q(l) itself, weights 1/N unless given, and C_l^2 */
    /* whose coefficients are wanted: on the sphere of the only set, on the torus of every one */
    ps_harmonics harmonics;
    /* Averages of bins, and weighted sums, are all that is wanted: members of a team share them.
     * What --per-ring leaves out has an error that is of single frequencies */
    bool bins_alone;
    bool fills_boxes; /* on the torus, coefficients of every set are handed on as boxes */
    bool keeps_sums;  /* somebody will ask the estimator for its sums, and keep them */
    bool keeps_sets;  /* on the sphere, too, those of every set are wanted */
    bool keeps_first; /* a copy of the first set, for a picture */
    bool is_turned;   /* on the sphere: about the x axis, see ps_source_turn */
    /* Weighted sums of the powers, see ps_estimator_weighted: weigh fills weights
     * [num_weighted][frequencies->num] once the frequencies are known; 0: none */
    size_t num_weighted;
    pspec_status (*weigh)(void *payload, const ps_frequencies *frequencies, double *weights,
                          ps_error *error);
    void *weigh_payload;
    pspec_normalization normalization;
    ps_accuracy_spec accuracy; /* the tolerance is of S, or of Q(l) */
    bool may_loosen; /* the tolerance, to what standard error and floor need; not for pair sums */
    ps_limits_spec limits;
    bool may_lack_device;   /* to be planned only: without a device, with the host's engines */
    ps_device *open_device; /* borrowed; NULL: the one that limits.device selects is opened */
    ps_watch watch;         /* told of realizations and other phases; {0}: nobody */
} ps_power_question;

typedef struct ps_power_job {
    const ps_power_question *question;
    /* Known after create. Of files the first set is read for planning; formats, columns and what
     * was wrong with kept sets are those of their source */
    ps_power_sets sets;
    ps_device_sets *device_sets; /* instead, where the device makes them; else NULL */
    unsigned dimension;
    uint64_t num_points;  /* of the first set, or that a sampler is asked for */
    uint64_t most_points; /* of any set, as far as it is known */
    ps_frequencies frequencies;
    ps_needs needs;
    char useless[48];           /* the skip of frequencies that do not matter; "": there is none */
    ps_sampler_request request; /* what is really sampled: without a shift nobody needs */
    uint64_t num_realizations;  /* that are computed; 0: unknown. With a range those of all jobs */
    uint64_t num_all;           /* the same, known after run, also of files */
    ps_problem problem;
    ps_device *device; /* NULL: none */
    bool owns_device;
    ps_plan plan;
    /* Known after run: with the accuracy, and whether the first run missed the tolerance and the
     * plan was made again */
    ps_runner runner;
    ps_row_stream stream; /* of realizations that a team shares */
    ps_spectrum spectrum;
    ps_text description; /* of the engine, "(torus_direct ...)" */
    /* c_lm of the only set as ps_engine.coefficients has them, [ps_num_coefficients(L)]; NULL
     * unless they were asked for */
    double *coefficients;
    /* Coefficients of every set, where they were asked for: S(k) on the torus, [num_kept][1 +
     * number of frequencies][2], S(0) = W first; with question.keeps_sets c_lm on the sphere,
     * [num_kept][ps_num_coefficients(L)]; room for so many */
    double *kept;
    size_t num_kept, kept_room;
    ps_mean *c2;       /* C_l^2 of pair sums, [number of degrees]; NULL: not asked for */
    double *weights;   /* [num_weighted][number of frequencies] */
    ps_mean *weighted; /* [num_weighted]; NULL: not asked for */
    ps_block_sums *weighted_blocks; /* the same by blocks of realizations, in another unit */
    ps_mean *means;                 /* [all bins] for looks at the standard error */
    /* The bin of the largest standard error when the realizations ended; not without
     * question.accuracy.standard_error, and with one realization that stands for all */
    ps_sequential_look look;
    bool has_look;
} ps_power_job;

/* Reads the first set, opens the device unless no engine that may be chosen needs it, and plans.
 * The question must outlive the job. With nothing feasible the job exists all the same, and only
 * ps_power_job_run fails: `plan` shows why. */
pspec_status ps_power_job_create(ps_power_job **out, const ps_power_question *question,
                                 ps_error *error) PS_MUST_CHECK;
void ps_power_job_destroy(ps_power_job *job);

pspec_status ps_power_job_run(ps_power_job *job, ps_error *error) PS_MUST_CHECK;

/* A job that has run is asked again, by a question that differs in sets of the caller alone. Where
 * they are as many as those before, and the first has the same shape, *is_ready: run will answer
 * with the plan and the estimator that there are, to the bit as a new job would. Else, and after an
 * error, the job is to be destroyed. */
pspec_status ps_power_job_renew(ps_power_job *job, const ps_power_question *question,
                                bool *is_ready, ps_error *error) PS_MUST_CHECK;

/* For who shows the shares of skips: makes those that depend on the plan better than from counts,
 * by planning again, which takes milliseconds. Before run. */
void ps_power_job_rate_skips(ps_power_job *job);

/* Sums of a job that has run, those of a range with what they are merged by; freed by the caller.
 */
pspec_status ps_power_job_sums(ps_power_job *job, ps_spectrum_sums *out,
                               ps_error *error) PS_MUST_CHECK;

/* Gives the memory back that only realizations need; after run. */
void ps_power_job_release(ps_power_job *job);

/* ---- which frequencies it looks at ----------------------------------------------------------- */

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
