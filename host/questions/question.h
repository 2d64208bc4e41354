/* From a request to what the jobs are asked: what samplers make, how point files are read, and the
 * question of a power job, shared by power, angular, pairs and plan. */
#ifndef PS_QUESTIONS_QUESTION_H
#define PS_QUESTIONS_QUESTION_H

#include "jobs/spectrum/power_job.h"
#include "questions/request.h"

/* One question per sampler, or one for the files. The questions borrow from the arguments. */
typedef struct ps_question_list {
    size_t num;
    ps_power_question questions[PS_MAX_SAMPLERS];
    ps_sampler_request requests[PS_MAX_SAMPLERS];
} ps_question_list;

/* Whose question: power, on the torus, or angular or pairs, on the sphere. */
typedef enum ps_question_kind {
    PS_QUESTION_POWER,
    PS_QUESTION_ANGULAR,
    PS_QUESTION_PAIRS
} ps_question_kind;

/* Checks that the options fit together. *out must not be moved afterwards. */
pspec_status ps_questions_make(ps_question_list *out, const ps_request *arguments,
                               ps_question_kind kind, ps_error *error) PS_MUST_CHECK;

/* What sampler number i_sampler is asked for: parsed, options that were not given left open,
 * resolved and checked. */
pspec_status ps_sampler_request_make(ps_sampler_request *out, const ps_request *arguments,
                                     size_t i_sampler, ps_error *error) PS_MUST_CHECK;

/* Returns how many realizations a sampler makes: as many as were given, or with a standard error
 * alone the most that it may take. */
uint64_t ps_num_realizations_asked(const ps_request *arguments);

/* What kind of points an option is about. */
typedef enum ps_option_source { PS_OF_BOTH, PS_OF_SAMPLERS, PS_OF_FILES } ps_option_source;
ps_option_source ps_option_source_of(ps_option_id id);

/* How point files are read. */
ps_point_options ps_point_options_make(const ps_request *arguments);
/* Refuses options about the other of samplers and files, and what does not go together in how files
 * are read. */
pspec_status ps_point_options_check(const ps_request *arguments, ps_error *error) PS_MUST_CHECK;

#endif
