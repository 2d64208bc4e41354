/* May the realizations of a job be shared in parts (parts.h), and how many are there? */
#ifndef PS_ANSWERS_PARTS_SHARING_H
#define PS_ANSWERS_PARTS_SHARING_H

#include "answers/kind.h"

typedef struct ps_sharing {
    uint64_t num_realizations; /* that the request asks for: of its range, if it names one */
    unsigned num_jobs;         /* of a part, one after the other */
    ps_error why;              /* they may not: a sentence's end; "": they may */
} ps_sharing;

/* What the request says is wrong with its outputs is an error here, too, as are inputs that cannot
 * be read. hooks hear of the reading. */
pspec_status ps_sharing_find(ps_sharing *out, const ps_command *command, const ps_request *request,
                             const ps_answer_hooks *hooks, ps_error *error) PS_MUST_CHECK;

#endif
