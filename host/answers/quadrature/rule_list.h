/* The rules that a request names, and their jobs, for kinds that integrate with them: quadrature
 * and shade. */
#ifndef PS_ANSWERS_QUADRATURE_RULE_LIST_H
#define PS_ANSWERS_QUADRATURE_RULE_LIST_H

#include "answers/kind.h"
#include "jobs/quadrature/quadrature_job.h"
#include "request/file_list.h"

/* One question for each sampler or set and number of points, or one for the files, as the request
 * counts them. The questions borrow from it, and from here. */
typedef struct ps_rule_list {
    ps_brdf *brdf;
    size_t num;
    ps_quadrature_question *questions; /* [num] */
    ps_sampler_request *requests;      /* [num] */
    ps_file_list *files;               /* [num] */
    ps_quadrature_job **jobs;          /* [num], NULL before run */
    ps_device *device; /* of all of them, where they share one that was opened for them */
} ps_rule_list;

/* Checks that the options of the taker fit together. *out is {0} before, and freed by
 * ps_rule_list_free, also after an error. */
pspec_status ps_rule_list_make(ps_rule_list *out, const ps_request *arguments, ps_command_id taker,
                               ps_error *error) PS_MUST_CHECK;
void ps_rule_list_free(ps_rule_list *list);

/* Plans of all jobs, and all of their work. */
pspec_status ps_rule_list_plan(ps_rule_list *self, ps_planner *planner, const ps_request *request,
                               ps_error *error) PS_MUST_CHECK;
pspec_status ps_rule_list_run(ps_rule_list *self, const ps_request *request,
                              const ps_answer_hooks *hooks, ps_error *error) PS_MUST_CHECK;

#endif
