/* check --homogeneous: have realizations the law of their own translates, or rotations? */
#ifndef PS_ANSWERS_HOMOGENEITY_HOMOGENEITY_H
#define PS_ANSWERS_HOMOGENEITY_HOMOGENEITY_H

#include "answers/kind.h"

typedef struct ps_homogeneity ps_homogeneity;

/* As the calls of ps_kind do. */
pspec_status ps_homogeneity_check(const ps_request *request, ps_error *error) PS_MUST_CHECK;
pspec_status ps_homogeneity_plan(ps_planner *planner, const ps_request *request,
                                 ps_error *error) PS_MUST_CHECK;
pspec_status ps_homogeneity_compute(ps_homogeneity **out, const ps_request *request,
                                    const ps_answer_hooks *hooks, ps_error *error) PS_MUST_CHECK;
pspec_status ps_homogeneity_tabulate(ps_answer *out, const ps_homogeneity *computed,
                                     ps_error *error) PS_MUST_CHECK;
void ps_homogeneity_discard(ps_homogeneity *computed);

#endif
