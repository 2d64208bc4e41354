/* From options as callers of the library give them, names and texts, to a request, by the table of
 * options. */
#ifndef PS_API_PUBLIC_WORDS_H
#define PS_API_PUBLIC_WORDS_H

#include "api/public_objects.h"
#include "base/text.h"
#include "commands/plan.h"

/* The command of that name in the table, ps_kinds, ps_plannable or ps_with_fields, or the sentence
 * that names the nearest one. */
pspec_status ps_public_find_command(const ps_command **out, const char *name,
                                    const ps_command *const *table, ps_error *error) PS_MUST_CHECK;

/* Not those of how a program shows its work, nor the device, which is that of the context. */
bool ps_public_takes(const ps_command *row, ps_option_id id);

/* A request, and what it borrows besides the caller's texts. */
typedef struct ps_public_words {
    ps_request request;
    ps_text command, folder; /* the command line that asks the same; the folder of caches */
    const char **files;      /* [request.num_files] */
} ps_public_words;

/* Device and limit of memory are those of the context. before: what the command line has before the
 * name of the command, "" or "plan ". Freed by ps_public_words_free, also after an error; it must not
 * be moved. */
pspec_status ps_public_words_make(ps_public_words *out, pspec_context *context, const char *before,
                                  const ps_command *row, const pspec_option *options,
                                  size_t num_options) PS_MUST_CHECK;
void ps_public_words_free(ps_public_words *words);

/* Callbacks of the context, and its device if it is open. */
ps_answer_hooks ps_public_hooks(pspec_context *context);

#endif
