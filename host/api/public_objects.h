/* What the files of the public library (pointspec/pointspec.h) know of each other's objects. */
#ifndef PS_API_PUBLIC_OBJECTS_H
#define PS_API_PUBLIC_OBJECTS_H

#include "answers/kind.h"
#include "base/log.h"

struct pspec_context {
    ps_error error;
    char *selector;
    ps_device *device; /* NULL until a question needs it */
    uint64_t memory_limit;
    ps_watch watch; /* the progress callback */
    ps_log log;
    ps_log warnings;
};

/* An answer that was made, which is taken over even when it fails: a table, or NULL, with its
 * verdict. fields: what its kind declares, ended by NULL, or NULL. */
pspec_status ps_public_answer(pspec_answer **out, ps_answer *made,
                              const ps_field_row *const *fields, ps_error *error) PS_MUST_CHECK;

/* Opens the context's device unless it is open. */
pspec_status ps_context_open_device(pspec_context *context) PS_MUST_CHECK;

/* The option belongs to the command, and is none of how a program shows its work, nor the device,
 * which is that of the context. */
bool ps_public_takes(const ps_command *row, ps_option_id id);

/* The row of that name in a table that NULL ends, or the sentence that names the nearest one; what:
 * "kind of answer". */
pspec_status ps_public_find(const ps_command **out, const ps_command *const *table,
                            const char *name, const char *what, ps_error *error) PS_MUST_CHECK;
/* All that can be asked by pspec_question_create; ended by NULL. */
extern const ps_command *const ps_public_commands[];

#endif
