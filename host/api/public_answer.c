/* The public library: answers of every kind of answer. */
#include "api/public_words.h"
#include "request/option_help.h"
#include "request/options.h"

const char *pspec_answer_kind(size_t i) {
    size_t num = 0;
    while (ps_kinds[num] != NULL) {
        num++;
    }
    return i < num ? ps_kinds[i]->name : NULL;
}

/* ---- options ----------------------------------------------------------------------------- */

static ps_cell text_or_missing(const char *text) {
    return text != NULL && text[0] != '\0' ? PS_TEXT(text) : PS_MISSING;
}

/* Kinds of answers that take the option, with commas. */
static void list_kinds(ps_text *out, ps_option_id id) {
    for (size_t i = 0; ps_kinds[i] != NULL; i++) {
        if (ps_command_takes(ps_kinds[i], id)) {
            ps_text_append(out, "%s%s", out->length > 0 ? "," : "", ps_kinds[i]->name);
        }
    }
}

static pspec_status add_option(ps_table *table, const ps_command *row, ps_option_id id,
                               ps_error *error) {
    const char *const words = ps_command_words(row, id);
    char help[PS_OPTION_HELP_BYTES];
    ps_option_facts facts;
    ps_text kinds = {0};
    ps_option_help(help, ps_options[id].help, row->name);
    ps_option_find_facts(&facts, id, words, help);
    list_kinds(&kinds, id);
    pspec_status status = ps_text_check(&kinds, error);
    const ps_cell cells[] = {PS_TEXT(ps_options[id].name),
                             text_or_missing(words),
                             PS_TEXT(facts.type),
                             text_or_missing(facts.unit),
                             text_or_missing(facts.initial),
                             PS_TEXT(facts.is_repeatable ? "yes" : "no"),
                             text_or_missing(facts.file),
                             text_or_missing(ps_text_string(&kinds)),
                             PS_TEXT(help)};
    if (status == PSPEC_OK) {
        status = ps_table_add_row(table, cells, error);
    }
    ps_text_free(&kinds);
    return status;
}

static pspec_status fill_options(ps_table *table, const ps_command *row, ps_error *error) {
    for (int i = 0; i < PS_NUM_OPTIONS; i++) {
        if (ps_public_takes(row, (ps_option_id)i)) {
            PS_TRY(add_option(table, row, (ps_option_id)i, error));
        }
    }
    return PSPEC_OK;
}

pspec_status pspec_options_table(pspec_table **out, pspec_context *context, const char *command) {
    static const char *const columns[] = {"option",   "values", "type",  "unit", "default",
                                          "repeated", "file",   "kinds", "help"};
    ps_table *table = NULL;
    const ps_command *row = NULL;
    if (out == NULL || context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    ps_error *const error = &context->error;
    *out = NULL;
    PS_TRY(ps_public_find_command(&row, command, ps_plannable, error));
    PS_TRY(ps_table_create(&table, "options", columns, sizeof columns / sizeof columns[0], error));
    const pspec_status status = fill_options(table, row, error);
    if (status != PSPEC_OK) {
        ps_table_destroy(table);
        return status;
    }
    return ps_public_table(out, table, "", error);
}

/* ---- fields ------------------------------------------------------------------------------ */

static pspec_status add_field(const ps_field_row *row, void *table, ps_error *error) {
    const ps_cell cells[] = {PS_TEXT(row->name),         PS_TEXT(ps_field_groups[row->group]),
                             text_or_missing(row->unit), PS_TEXT(row->is_repeated ? "yes" : "no"),
                             text_or_missing(row->when), PS_TEXT(row->meaning)};
    return ps_table_add_row(table, cells, error);
}

pspec_status pspec_fields_table(pspec_table **out, pspec_context *context, const char *kind) {
    static const char *const columns[] = {"field", "group", "unit", "repeated", "when", "meaning"};
    ps_table *table = NULL;
    const ps_command *row = NULL;
    if (out == NULL || context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    ps_error *const error = &context->error;
    *out = NULL;
    PS_TRY(ps_public_find_command(&row, kind, ps_with_fields, error));
    PS_TRY(ps_table_create(&table, "fields", columns, sizeof columns / sizeof columns[0], error));
    const pspec_status status = ps_kind_visit_fields(row, add_field, table, error);
    if (status != PSPEC_OK) {
        ps_table_destroy(table);
        return status;
    }
    return ps_public_table(out, table, "", error);
}

/* ---- answers ----------------------------------------------------------------------------- */

static pspec_status answer(pspec_table **out, pspec_context *context, const ps_kind *kind,
                           const ps_request *request) {
    ps_answer made = {0};
    ps_error *const error = &context->error;
    PS_TRY(kind->check_question(request, error)); /* before a device is opened for nothing */
    if (!kind->is_of_host && ps_plan_may_need_device(&request->limits.constraints)) {
        PS_TRY(ps_context_open_device(context));
    }
    const ps_answer_hooks hooks = ps_public_hooks(context);
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
    const ps_command *row = NULL;
    ps_public_words words;
    if (out == NULL || context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    *out = NULL;
    PS_TRY(ps_public_find_command(&row, kind, ps_kinds, &context->error));
    pspec_status status = ps_public_words_make(&words, context, "", row, options, num_options);
    if (status == PSPEC_OK) {
        status = answer(out, context, row, &words.request);
    }
    ps_public_words_free(&words);
    return status;
}
