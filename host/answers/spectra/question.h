/* From a request to what the jobs are asked: what samplers make, how point files are read, and the
 * question of a power job, shared by power, angular, pairs and plan. */
#ifndef PS_ANSWERS_SPECTRA_QUESTION_H
#define PS_ANSWERS_SPECTRA_QUESTION_H

#include "jobs/spectrum/power_job.h"
#include "request/request.h"

/* One question for each sampler and number of points, or one for the files, as the request counts
 * them. The questions borrow from it. */
typedef struct ps_question_list {
    size_t num;
    ps_power_question *questions; /* [num] */
    ps_sampler_request *requests; /* [num] */
} ps_question_list;

/* Whose question: power, on the torus, or angular or pairs, on the sphere. */
typedef enum ps_question_kind {
    PS_QUESTION_POWER,
    PS_QUESTION_ANGULAR,
    PS_QUESTION_PAIRS
} ps_question_kind;

/* Checks that the options fit together. *out is freed by ps_questions_free, also after an error. */
pspec_status ps_questions_make(ps_question_list *out, const ps_request *arguments,
                               ps_question_kind kind, ps_error *error) PS_MUST_CHECK;

void ps_questions_free(ps_question_list *list);

/* The picture of a request has at most so many curves; more are refused. */
enum { PS_MAX_CURVES = PS_MAX_SAMPLERS };

/* What the sampler of a question is asked for: parsed, options that were not given left open,
 * resolved and checked. */
pspec_status ps_sampler_request_make(ps_sampler_request *out, const ps_request *arguments,
                                     size_t question, ps_error *error) PS_MUST_CHECK;

/* Returns how many realizations a sampler makes: as many as were given, or with a standard error
 * alone the most that it may take. */
uint64_t ps_num_realizations_asked(const ps_request *arguments);

/* Refuses several numbers of points for the output of `sample`. */
pspec_status ps_sample_check_counts(const ps_request *arguments, ps_error *error) PS_MUST_CHECK;
/* Refuses weights of a file for several numbers of points. */
pspec_status ps_weights_check_counts(const ps_request *arguments, ps_error *error) PS_MUST_CHECK;

/* What kind of points an option is about. */
typedef enum ps_option_source { PS_OF_BOTH, PS_OF_SAMPLERS, PS_OF_FILES } ps_option_source;
ps_option_source ps_option_source_of(ps_option_id id);

/* How point files are read. */
ps_point_options ps_point_options_make(const ps_request *arguments);
/* Refuses options about the other of samplers and files, several numbers of points of files, and
 * what does not go together in how files are read. */
pspec_status ps_point_options_check(const ps_request *arguments, ps_error *error) PS_MUST_CHECK;

#endif
