/* Checkpoints of answers: what question a checkpoint belongs to. */
#ifndef PS_ANSWERS_CHECKPOINTS_H
#define PS_ANSWERS_CHECKPOINTS_H

#include "answers/kind.h"

/* Where the request names a checkpoint: what its jobs need to know of it, with the key in an empty
 * text, which is to be freed in either case. Input that cannot be read again is
 * PSPEC_ERROR_INVALID_ARGUMENT. hooks outlive the jobs. */
pspec_status ps_answer_begin_checkpoints(ps_request *request, const ps_kind *kind, ps_text *key,
                                         const ps_answer_hooks *hooks,
                                         ps_error *error) PS_MUST_CHECK;
unsigned ps_answer_num_checkpoints(const ps_request *request, const ps_kind *kind);
/* Removes those that there are, for their answer is written. */
void ps_answer_end_checkpoints(const ps_request *request);

/* The program as a line of a key; an error where the system does not show it. */
pspec_status ps_answer_identify_program(ps_text *out, ps_error *error) PS_MUST_CHECK;

#endif
