/* Options as keys with texts, as scenes and callers of the library say them. */
#ifndef PS_REQUEST_OPTION_TEXT_H
#define PS_REQUEST_OPTION_TEXT_H

#include "base/text.h"
#include "request/options.h"

/* Sets an option of a request to a text; flags are true or false, and false leaves all as it is.
 * words: the values that are admitted, "one|two|FILE". */
pspec_status ps_option_apply(ps_request *request, ps_option_id id, const char *words,
                             const char *text, ps_error *error) PS_MUST_CHECK;

/* Appends the option as a command line has it, " --points 64", " --homogenize", or nothing for a flag
 * that is false. */
void ps_option_append(ps_text *command, ps_option_id id, const char *text);

/* Refuses a name that is none of the options that takes() admits, and names the nearest of these.
 * name_of_taker: "power". */
typedef bool ps_option_taken(const void *taker, ps_option_id id);
pspec_status ps_option_find(ps_option_id *out, const char *name, ps_option_taken *takes,
                            const void *taker, const char *name_of_taker,
                            ps_error *error) PS_MUST_CHECK;

#endif
