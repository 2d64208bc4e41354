/* The public library: answers of every kind of result. */
#include "api/public_words.h"
#include "questions/options.h"

#include <string.h>

const char *pspec_result_kind(size_t i) {
    size_t num = 0;
    while (ps_result_kinds[num] != NULL) {
        num++;
    }
    return i < num ? ps_result_kinds[i]->name : NULL;
}

/* ---- names ------------------------------------------------------------------------------- */

static pspec_status find_kind(const ps_result_kind **out, const char *name, ps_error *error) {
    size_t best = SIZE_MAX;
    if (name == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "there is no name of a kind of result");
    }
    for (size_t i = 0; ps_result_kinds[i] != NULL; i++) {
        const size_t distance = ps_name_distance(name, ps_result_kinds[i]->name);
        if (distance < best) {
            best = distance;
            *out = ps_result_kinds[i];
        }
    }
    return best == 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "there is no kind of result \"%s\"%s",
                         name,
                         ps_text_suggest(name, (*out)->name, best, "; did you mean ", "?").text);
}

/* ---- options ----------------------------------------------------------------------------- */

static pspec_status fill_options(ps_table *table, const ps_public_taker *taker, ps_error *error) {
    for (int i = 0; i < PS_NUM_OPTIONS; i++) {
        const ps_option_id id = (ps_option_id)i;
        if (ps_public_takes(taker, id)) {
            const char *const words = ps_public_words_of(taker, id);
            const ps_cell cells[] = {PS_TEXT(ps_options[id].name),
                                     words != NULL ? PS_TEXT(words) : PS_MISSING,
                                     PS_TEXT(ps_options[id].help)};
            PS_TRY(ps_table_add_row(table, cells, error));
        }
    }
    return PSPEC_OK;
}

pspec_status pspec_options_table(pspec_table **out, pspec_context *context, const char *command) {
    static const char *const columns[] = {"option", "values", "help"};
    ps_table *table = NULL;
    const ps_result_kind *kind = NULL;
    if (out == NULL || context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    ps_error *const error = &context->error;
    *out = NULL;
    PS_TRY(find_kind(&kind, command, error));
    PS_TRY(ps_table_create(&table, "options", columns, sizeof columns / sizeof columns[0], error));
    const ps_public_taker taker = {kind->name, kind->taker, kind, NULL, NULL};
    const pspec_status status = fill_options(table, &taker, error);
    if (status != PSPEC_OK) {
        ps_table_destroy(table);
        return status;
    }
    return ps_public_table(out, table, "", error);
}

/* ---- answers ----------------------------------------------------------------------------- */

static pspec_status answer(pspec_table **out, pspec_context *context, const ps_result_kind *kind,
                           const ps_request *request) {
    ps_answer_hooks hooks;
    ps_answer made = {0};
    ps_error *const error = &context->error;
    PS_TRY(kind->check_question(request, error)); /* before a device is opened for nothing */
    PS_TRY(ps_public_hooks(&hooks, context, request, kind->is_of_host));
    pspec_status status = ps_answer_produce(&made, kind, request, &hooks, error);
    if (status == PSPEC_OK) {
        status = ps_public_table(out, made.table, made.verdict.message, error);
        made.table = NULL; /* taken over */
    }
    ps_answer_free(&made);
    return status;
}

pspec_status pspec_answer(pspec_table **out, pspec_context *context, const char *kind,
                          const pspec_option *options, size_t num_options) {
    const ps_result_kind *found = NULL;
    ps_public_words words;
    if (out == NULL || context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    *out = NULL;
    PS_TRY(find_kind(&found, kind, &context->error));
    const ps_public_taker taker = {found->name, found->taker, found, NULL, NULL};
    pspec_status status = ps_public_words_make(&words, context, &taker, options, num_options);
    if (status == PSPEC_OK) {
        status = answer(out, context, found, &words.request);
    }
    ps_public_words_free(&words);
    return status;
}
