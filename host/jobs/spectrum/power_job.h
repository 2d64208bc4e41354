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
#include "jobs/estimator.h"
#include "jobs/source.h"
#include "jobs/spectrum/empty_axis.h"
#include "plan/needs.h"
#include "plan/specs.h"
#include "points/weights_spec.h"
#include "spectra/sequential.h"

typedef struct ps_power_question {
    /* realizations: a sampler, or files */
    const ps_sampler_request *sampler; /* NULL: files */
    uint64_t num_realizations;         /* of the sampler */
    const char *const *paths;
    size_t num_paths;
    ps_point_options point_options;
    ps_weights_spec weights; /* never optimal */
    uint64_t whole_bytes;    /* of a set of a file, see ps_source_options */
    ps_source *source;       /* borrowed, of the files, at their first set; NULL: opened here */
    uint64_t num_sets;       /* the first of the files alone; 0: all */

    /* degrees, where points are on the sphere; frequencies are then not looked at */
    bool on_sphere;
    bool on_hemisphere; /* even degrees only */
    int64_t max_degree; /* 0: ceil(4 sqrt N) */

    /* frequencies */
    ps_frequencies_spec frequencies;
    /* rings, and K, are of the wave vectors of the first set's box, where it is no cube */
    bool has_rings_of_box;
    double reach; /* the largest frequency is this times N^(1/d) unless it is given; 0: 5 */
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
    bool fills_boxes; /* on the torus, coefficients of every set are handed on as boxes */
    bool keeps_sums;  /* somebody will ask for ps_power_job_sums, and keep them */
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

/* A job that is planned but not yet run. */
typedef struct ps_power_job ps_power_job;

/* Reads the first set, opens the device unless no engine that may be chosen needs it, and plans.
 * The question must outlive the job. With nothing feasible the job exists all the same, and only
 * ps_power_job_run fails: `plan` shows why. */
pspec_status ps_power_job_create(ps_power_job **out, const ps_power_question *question,
                                 ps_error *error) PS_MUST_CHECK;
void ps_power_job_destroy(ps_power_job *job);

pspec_status ps_power_job_run(ps_power_job *job, ps_error *error) PS_MUST_CHECK;

/* For who shows the shares of skips: makes those that depend on the plan better than from counts,
 * by planning again, which takes milliseconds. Before run. */
void ps_power_job_rate_skips(ps_power_job *job);

/* Gives the memory back that only realizations need; after run. */
void ps_power_job_release(ps_power_job *job);

/* What is known after create. */
const ps_plan *ps_power_job_plan(const ps_power_job *job);
const ps_needs *ps_power_job_needs(const ps_power_job *job);
const ps_problem *ps_power_job_problem(const ps_power_job *job);
const ps_device_limits *ps_power_job_limits(const ps_power_job *job); /* NULL: no device */
ps_device *ps_power_job_device(const ps_power_job *job);              /* NULL: none; borrowed */
size_t ps_power_job_num_files(const ps_power_job *job);               /* 0: a sampler */
bool ps_power_job_takes_part(const ps_power_job *job); /* only the first of the files' sets */
const char *ps_power_job_source_format(const ps_power_job *job);
const char *ps_power_job_source_columns(const ps_power_job *job);
const ps_boxes *ps_power_job_boxes(const ps_power_job *job); /* after run: of all sets */
const ps_sampler_request *ps_power_job_sampler(const ps_power_job *job); /* NULL: files */

/* What is known after run. Borrowed. */
const ps_spectrum *ps_power_job_spectrum(const ps_power_job *job);
/* A piece of an axis that the first set of files leaves empty, unlike uniform points; false: none,
 * or nobody looked (samplers, the sphere, with --box). */
bool ps_power_job_empty_axis(const ps_power_job *job, ps_empty_axis *out);
/* The points of the first set, as they came; NULL unless question.keeps_first, and of sets of more
 * than PS_MOST_POINTS_KEPT. */
const ps_point_set *ps_power_job_first_set(const ps_power_job *job);
/* The sums that the spectrum, and C_l^2, were made of; freed by the caller. */
pspec_status ps_power_job_sums(const ps_power_job *job, ps_spectrum_sums *out,
                               ps_error *error) PS_MUST_CHECK;
const ps_accuracy *ps_power_job_accuracy(const ps_power_job *job);
/* "(torus_direct ...)" */
const char *ps_power_job_description(const ps_power_job *job);
/* c_lm as ps_engine.coefficients has them, [ps_num_coefficients(L)]; NULL unless they were asked
 * for. */
const double *ps_power_job_coefficients(const ps_power_job *job);
/* S(k) on the torus, [*num_sets][1 + number of frequencies][2], S(0) = W first; with
 * question.keeps_sets c_lm on the sphere, [*num_sets][ps_num_coefficients(L)]. NULL unless asked
 * for. */
const double *ps_power_job_amplitudes(const ps_power_job *job, size_t *num_sets);
/* The bin of the largest standard error when the realizations ended; NULL unless
 * question.accuracy.standard_error was asked for, and with one realization that stands for all. */
const ps_sequential_look *ps_power_job_look(const ps_power_job *job);
/* What was wrong with kept sets (sets/sets.h), "" where nothing was. Not while the job runs. */
const char *ps_power_job_trouble(const ps_power_job *job);
/* [question.num_weighted]; NULL: none were asked for. */
const ps_mean *ps_power_job_weighted(const ps_power_job *job);
/* The same by blocks of realizations, in another unit. */
const ps_block_sums *ps_power_job_weighted_blocks(const ps_power_job *job);
/* C_l^2 of pair sums, [number of degrees]; NULL unless they were asked for. */
const ps_mean *ps_power_job_c2(const ps_power_job *job);
/* True when the first run missed the tolerance and the plan was made again. */
bool ps_power_job_was_replanned(const ps_power_job *job);
/* The most bytes that buffers of the device had at a time. */
uint64_t ps_power_job_buffer_bytes(const ps_power_job *job);
const ps_profile_row *ps_power_job_profile(const ps_power_job *job, size_t *num_rows);

#endif
