/* The rules that a request names, for kinds that integrate with them: quadrature and shade. */
#ifndef PS_ANSWERS_QUADRATURE_RULE_LIST_H
#define PS_ANSWERS_QUADRATURE_RULE_LIST_H

#include "jobs/quadrature/quadrature_job.h"
#include "request/file_list.h"
#include "request/options.h"

/* One question for each sampler or set and number of points, or one for the files, as the request
 * counts them. The questions borrow from it, and from here. */
typedef struct ps_rule_list {
    ps_brdf *brdf;
    size_t num;
    ps_quadrature_question *questions; /* [num] */
    ps_sampler_request *requests;      /* [num] */
    ps_file_list *files;               /* [num] */
} ps_rule_list;

/* Checks that the options of the taker fit together. *out is {0} before, and freed by
 * ps_rule_list_free, also after an error. */
pspec_status ps_rule_list_make(ps_rule_list *out, const ps_request *arguments, ps_command_id taker,
                               ps_error *error) PS_MUST_CHECK;
void ps_rule_list_free(ps_rule_list *list);

#endif
