/* From a request to the questions of power jobs, shared by power, angular, pairs and plan. */
#ifndef PS_ANSWERS_SPECTRA_QUESTION_H
#define PS_ANSWERS_SPECTRA_QUESTION_H

#include "jobs/spectrum/power_job.h"
#include "request/file_list.h"

/* One question for each sampler or set and number of points, or one for the files, as the request
 * counts them. The questions borrow from it, and from here. */
typedef struct ps_question_list {
    size_t num;
    ps_power_question *questions; /* [num] */
    ps_sampler_request *requests; /* [num] */
    ps_file_list *files;          /* [num] */
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

/* Where the points of kinds are that take both: samplers say it; files are of the sphere when one
 * of --domain sphere, --lift, --hemisphere and --max-degree says so. */
pspec_status ps_questions_find_domain(bool *on_sphere, const ps_request *arguments,
                                      ps_error *error) PS_MUST_CHECK;

void ps_questions_free(ps_question_list *list);

/* The picture of a request has at most so many curves; more are refused. */
enum { PS_MAX_CURVES = PS_MAX_SAMPLERS };

#endif
