/* From a request to what variance jobs are asked. */
#ifndef PS_ANSWERS_VARIANCE_VARIANCE_QUESTION_H
#define PS_ANSWERS_VARIANCE_VARIANCE_QUESTION_H

#include "jobs/variance/variance_job.h"
#include "request/file_list.h"

/* One question for each sampler or set and number of points, as the request counts them. The
 * questions borrow from it, and from here. */
typedef struct ps_variance_list {
    size_t num;
    ps_variance_question *questions; /* [num] */
    ps_sampler_request *requests;    /* [num] */
    ps_file_list *files;             /* [num] */
} ps_variance_list;

/* Checks that the options fit together. *out is freed by ps_variance_list_free, also after an
 * error. */
pspec_status ps_variance_list_make(ps_variance_list *out, const ps_request *arguments,
                                   ps_error *error) PS_MUST_CHECK;
void ps_variance_list_free(ps_variance_list *list);

#endif
