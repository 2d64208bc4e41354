/* The question of `check --homogeneous`: amplitudes of every realization. */
#ifndef PS_ANSWERS_HOMOGENEITY_HOMOGENEITY_QUESTION_H
#define PS_ANSWERS_HOMOGENEITY_HOMOGENEITY_QUESTION_H

#include "answers/spectra/question.h"

/* What is asked with the defaults of this question. */
ps_request ps_homogeneity_request(const ps_request *arguments);

/* One question, of what ps_homogeneity_request gave; it borrows from `own`. What does not go
 * together is refused. */
pspec_status ps_homogeneity_question_make(ps_question_list *out, const ps_request *own,
                                          ps_error *error) PS_MUST_CHECK;

#endif
