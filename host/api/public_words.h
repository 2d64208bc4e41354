/* From options as callers of the library give them, names and texts, to a request, by the table of
 * options. */
#ifndef PS_API_PUBLIC_WORDS_H
#define PS_API_PUBLIC_WORDS_H

#include "api/public_objects.h"
#include "base/text.h"
#include "results/kind.h"

/* Who takes options: a kind of result, or another command. */
typedef struct ps_public_taker {
    const char *name;
    ps_takers taker;               /* its bit in the table of options */
    const ps_result_kind *kind;    /* NULL: it is none */
    const char *formats, *weights; /* words of these options; NULL: those of the kind or table */
} ps_public_taker;

/* Commands that are no kinds of results. */
extern const ps_public_taker ps_public_taker_sample, ps_public_taker_convert, ps_public_taker_run;

/* Not those of how a program shows its work, nor the device, which is that of the context. */
bool ps_public_takes(const ps_public_taker *taker, ps_option_id id);
const char *ps_public_words_of(const ps_public_taker *taker, ps_option_id id);

/* A request, and what it borrows besides the caller's texts. */
typedef struct ps_public_words {
    ps_request request;
    ps_text command, folder; /* the command line that asks the same; the folder of caches */
    const char **files;      /* [request.num_files] */
} ps_public_words;

/* Device and limit of memory are those of the context. Freed by ps_public_words_free, also after
 * an error; it must not be moved. */
pspec_status ps_public_words_make(ps_public_words *out, pspec_context *context,
                                  const ps_public_taker *taker, const pspec_option *options,
                                  size_t num_options) PS_MUST_CHECK;
void ps_public_words_free(ps_public_words *words);

/* Callbacks of the context for work on a request, and its device, which is opened if the request
 * may need one. */
pspec_status ps_public_hooks(ps_answer_hooks *out, pspec_context *context,
                             const ps_request *request, bool is_of_host) PS_MUST_CHECK;

#endif
