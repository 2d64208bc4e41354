/* The public library: scenes, plans, and what there is on this machine. */
#include "api/public_words.h"
#include "commands/doctor.h"
#include "request/options.h"

/* A table that was made, or nothing. */
static pspec_status give(pspec_table **out, ps_answer *made, pspec_status status, ps_error *error) {
    if (status == PSPEC_OK) {
        status = ps_public_table(out, made->table, made->verdict.message, error);
        made->table = NULL; /* taken over */
    }
    ps_answer_free(made);
    return status;
}

/* ---- scenes and plans -------------------------------------------------------------------- */

pspec_status pspec_run(pspec_table **out, pspec_context *context, const pspec_option *options,
                       size_t num_options) {
    ps_public_words words;
    ps_answer made = {0};
    if (out == NULL || context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    ps_error *const error = &context->error;
    *out = NULL;
    pspec_status status =
        ps_public_words_make(&words, context, "", &ps_command_run, options, num_options);
    if (status == PSPEC_OK) {
        const ps_answer_hooks hooks = ps_public_hooks(context);
        status = ps_command_run.run(&made, &words.request, &hooks, error);
    }
    ps_public_words_free(&words);
    return give(out, &made, status, error);
}

pspec_status pspec_plan_table(pspec_table **out, pspec_context *context, const char *command,
                              const pspec_option *options, size_t num_options) {
    const ps_command *row = NULL;
    ps_public_words words;
    ps_answer made = {0};
    if (out == NULL || context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    ps_error *const error = &context->error;
    *out = NULL;
    PS_TRY(ps_public_find_command(&row, command, ps_plannable, error));
    pspec_status status = ps_public_words_make(&words, context, "plan ", row, options, num_options);
    if (status == PSPEC_OK) {
        const ps_answer_hooks hooks = ps_public_hooks(context);
        status = ps_plan_command(&made.table, row, &words.request, &hooks, error);
    }
    ps_public_words_free(&words);
    return give(out, &made, status, error);
}

/* ---- the machine ------------------------------------------------------------------------- */

pspec_status pspec_devices(pspec_table **out, pspec_context *context) {
    ps_public_words words;
    ps_answer made = {0};
    if (out == NULL || context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    ps_error *const error = &context->error;
    *out = NULL;
    pspec_status status = ps_public_words_make(&words, context, "", &ps_command_devices, NULL, 0);
    if (status == PSPEC_OK) {
        const ps_answer_hooks hooks = ps_public_hooks(context);
        status = ps_command_devices.run(&made, &words.request, &hooks, error);
    }
    ps_public_words_free(&words);
    return give(out, &made, status, error);
}

pspec_status pspec_doctor(pspec_table **out, pspec_context *context) {
    ps_answer made = {0};
    if (out == NULL || context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    ps_error *const error = &context->error;
    *out = NULL;
    const pspec_status status = ps_doctor_tabulate(&made, context->selector, error);
    return give(out, &made, status, error);
}
