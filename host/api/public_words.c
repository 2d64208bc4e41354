#include "api/public_words.h"

#include "base/memory.h"
#include "request/option_text.h"
#include "store/cache_trust.h"
#include "store/result_cache.h"

#include <stdlib.h>
#include <string.h>

/* ---- names ------------------------------------------------------------------------------- */

pspec_status ps_public_find_command(const ps_command **out, const char *name,
                                    const ps_command *const *table, ps_error *error) {
    const char *const what = table == ps_plannable ? "command" : "kind of answer";
    size_t distance = 0;
    if (name == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "there is no name of a %s", what);
    }
    *out = ps_command_nearest(table, name, &distance);
    return distance == 0
               ? PSPEC_OK
               : ps_fail(
                     error, PSPEC_ERROR_INVALID_ARGUMENT, "there is no %s \"%s\"%s", what, name,
                     ps_text_suggest(name, (*out)->name, distance, "; did you mean ", "?").text);
}

/* ---- what is taken ----------------------------------------------------------------------- */

bool ps_public_takes(const ps_command *row, ps_option_id id) {
    static const ps_option_id of_program[] = {PS_OPTION_DEVICE, PS_OPTION_PROFILE, PS_OPTION_QUIET,
                                              PS_OPTION_VERBOSE, PS_OPTION_HELP};
    bool is_of_program = false;
    for (size_t i = 0; i < sizeof of_program / sizeof of_program[0]; i++) {
        is_of_program = is_of_program || of_program[i] == id;
    }
    return !is_of_program && ps_command_takes(row, id);
}

static bool takes(const void *row, ps_option_id id) {
    return ps_public_takes(row, id);
}

/* ---- one option -------------------------------------------------------------------------- */

static const char files_name[] = "files";

static pspec_status refuse_stream(const char *name, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                   "%s: the library reads and writes files, and - is none", name);
}

static bool is_stream(const char *value) {
    return value != NULL && strcmp(value, "-") == 0;
}

static pspec_status take_file(ps_public_words *out, const char *path, ps_error *error) {
    if (path == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s: there is no name of a file",
                       files_name);
    }
    out->files[out->request.num_files++] = path;
    return is_stream(path) ? refuse_stream(files_name, error) : PSPEC_OK;
}

static pspec_status take_option(ps_public_words *out, const ps_command *row,
                                const pspec_option *option, ps_error *error) {
    ps_option_id id = PS_NUM_OPTIONS;
    if (option->name == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "an option has no name");
    }
    if (strcmp(option->name, files_name) == 0) {
        return take_file(out, option->value, error);
    }
    PS_TRY(ps_option_find(&id, option->name, takes, row, row->name, error));
    const char *const words = ps_command_words(row, id);
    const char *const value = option->value != NULL || words != NULL ? option->value : "true";
    if (value == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s needs a value: %s", option->name,
                       words);
    }
    if (id == PS_OPTION_OUTPUT && is_stream(value)) {
        return refuse_stream(option->name, error);
    }
    ps_option_append(&out->command, id, value);
    return ps_option_apply(&out->request, id, words, value, error);
}

/* ---- all of them ------------------------------------------------------------------------- */

/* As POINTSPEC_MEMORY for the program: it counts as if it had been said, and so results keep it. */
static void take_memory(ps_public_words *out, const pspec_context *context, const ps_command *row,
                        const pspec_option *options, size_t num) {
    const char *const name = ps_options[PS_OPTION_MEMORY].name;
    bool is_said = !ps_public_takes(row, PS_OPTION_MEMORY) || context->memory_limit == 0;
    for (size_t i = 0; i < num && !is_said; i++) {
        is_said = options[i].name != NULL && strcmp(options[i].name, name) == 0;
    }
    if (!is_said) {
        out->request.limits.constraints.memory_limit = context->memory_limit;
        out->request.is_memory_of_environment = true;
        ps_text_append(&out->command, " --%s %llu", name,
                       (unsigned long long)context->memory_limit);
    }
}

/* A folder that others can write is as good as none, and there need not be one. */
static pspec_status find_folder(ps_public_words *out, const pspec_context *context) {
    ps_error reason = {0};
    const pspec_status status = ps_cache_default_directory(&out->folder, &reason);
    if (status == PSPEC_OK &&
        ps_cache_check_folder(ps_text_string(&out->folder), &reason) == PSPEC_OK) {
        out->request.limits.cache_folder = ps_text_string(&out->folder);
    } else if (status == PSPEC_OK) {
        ps_log_say(&context->warnings, "no cache: %s", reason.message);
    }
    return status == PSPEC_ERROR_MEMORY ? status : PSPEC_OK;
}

static pspec_status take_all(ps_public_words *out, pspec_context *context, const char *before,
                             const ps_command *row, const pspec_option *options, size_t num) {
    ps_error *const error = &context->error;
    PS_TRY(PS_NEW(&out->files, num, "names of files", error));
    ps_text_append(&out->command, "pointspec %s%s", before, row->name);
    take_memory(out, context, row, options, num);
    for (size_t i = 0; i < num; i++) {
        PS_TRY(take_option(out, row, &options[i], error));
    }
    for (size_t i = 0; i < out->request.num_files; i++) {
        ps_text_append_word(&out->command, out->files[i]);
    }
    out->request.files = out->files;
    out->request.limits.device = context->selector;
    out->request.command_line = ps_text_string(&out->command);
    PS_TRY(find_folder(out, context));
    return ps_text_check(&out->command, error);
}

pspec_status ps_public_words_make(ps_public_words *out, pspec_context *context, const char *before,
                                  const ps_command *row, const pspec_option *options,
                                  size_t num_options) {
    *out = (ps_public_words){.request = ps_request_default};
    return options != NULL || num_options == 0
               ? take_all(out, context, before, row, options, num_options)
               : ps_fail(&context->error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%zu options at the address NULL", num_options);
}

void ps_public_words_free(ps_public_words *words) {
    free(words->files);
    ps_text_free(&words->command);
    ps_text_free(&words->folder);
}

/* ---- who hears of the work --------------------------------------------------------------- */

static void warn(void *payload, const char *sentence) {
    const pspec_context *const context = payload;
    ps_log_say(&context->warnings, "%s", sentence);
}

static void say_plan(void *payload, const ps_plan *plan) {
    const pspec_context *const context = payload;
    if (plan->chosen != NULL) {
        ps_log_say(&context->log, "plan: %s in %s precision: %s", plan->chosen->engine->name,
                   ps_precision_name(plan->chosen->precision), plan->chosen->reason);
    }
}

ps_answer_hooks ps_public_hooks(pspec_context *context) {
    return (ps_answer_hooks){.watch = context->watch,
                             .device = context->device,
                             .payload = context,
                             .warn = warn,
                             .tell_missing = warn,
                             .tell_plan = say_plan};
}
