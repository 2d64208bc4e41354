/* The question of `check`: that of the saved spectrum. */
#ifndef PS_ANSWERS_CHECK_CHECK_QUESTION_H
#define PS_ANSWERS_CHECK_CHECK_QUESTION_H

#include "answers/check/saved_spectrum.h"
#include "answers/spectra/question.h"

/* The question is that of the saved spectrum, but for the seed: realizations must be independent of
 * those that were saved. */
ps_request ps_check_request(const ps_request *arguments, const ps_saved_spectrum *saved);

/* Does the option say what the saved spectrum says itself: where points lie, and which frequencies
 * or degrees? Then it does not go with one. */
bool ps_check_is_of_spectrum(ps_option_id id);

/* One question, of what ps_check_request gave; it borrows from `own`. */
pspec_status ps_check_question_make(ps_question_list *out, const ps_request *own,
                                    const ps_saved_spectrum *saved, ps_error *error) PS_MUST_CHECK;

#endif
