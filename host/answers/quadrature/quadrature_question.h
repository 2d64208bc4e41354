/* From a request to what quadrature jobs are asked, for `quadrature` and `plan`. */
#ifndef PS_ANSWERS_QUADRATURE_QUADRATURE_QUESTION_H
#define PS_ANSWERS_QUADRATURE_QUADRATURE_QUESTION_H

#include "jobs/quadrature/quadrature_job.h"
#include "request/file_list.h"

/* One question for each sampler or set and number of points, or one for the files, as the request
 * counts them. The questions borrow from it, and from here. */
typedef struct ps_quadrature_list {
    ps_brdf *brdf;
    size_t num;
    ps_quadrature_question *questions; /* [num] */
    ps_sampler_request *requests;      /* [num] */
    ps_file_list *files;               /* [num] */
} ps_quadrature_list;

/* Checks that the options fit together. *out is freed by ps_quadrature_list_free, also after an
 * error. */
pspec_status ps_quadrature_list_make(ps_quadrature_list *out, const ps_request *arguments,
                                     ps_error *error) PS_MUST_CHECK;
void ps_quadrature_list_free(ps_quadrature_list *list);

#endif
