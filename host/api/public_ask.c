/* The public library: a question answered, or planned. */
#include "answers/devices/devices_work.h"
#include "api/question.h"
#include "base/memory.h"
#include "commands/plan.h"
#include "request/option_text.h"
#include "store/cache_trust.h"
#include "store/result_cache.h"

#include <stdlib.h>
#include <string.h>

/* A question at hand: its request, with the caller's patterns, and what that borrows. */
typedef struct asking {
    pspec_question *question;
    ps_request request;
    ps_text command, folder; /* the command line that asks the same; the folder of caches */
    ps_given_set *given;     /* [question->num_sets] */
} asking;

void ps_public_forget(pspec_question *question) {
    if (question->kept != NULL) {
        question->row->discard(question->kept);
        question->kept = NULL;
    }
}

/* ---- the caller's patterns --------------------------------------------------------------- */

static pspec_status next(void *payload, uint64_t realization, pspec_pattern *out, bool *has_set,
                         ps_error *error) {
    const ps_caller_set *const set = payload;
    if (set->give == NULL) {
        *has_set = realization < set->num_kept;
        *out = *has_set ? set->kept[realization] : *out;
        return PSPEC_OK;
    }
    const int given = set->give(realization, out, set->payload);
    *has_set = given > 0;
    return given >= 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT, "%s: the function gave no set %llu (%d)",
                         ps_text_string(&set->name), (unsigned long long)realization + 1, given);
}

/* Points of the caller are a file, or the files of a set, by the name that they are given under. */
static pspec_status take_set(asking *self, size_t i, ps_error *error) {
    pspec_question *const question = self->question;
    ps_caller_set *const set = &question->sets[i];
    void *files = question->files;
    const char *const name = ps_text_string(&set->name);
    ps_request *const request = &self->request;
    self->given[i] = (ps_given_set){.name = name,
                                    .next = next,
                                    .payload = set,
                                    .most = set->give != NULL ? set->num : 0,
                                    .num = set->num_kept,
                                    .stays = set->give == NULL};
    request->reading.given.num = i + 1;
    if (strcmp(name, PS_CALLER_POINTS) == 0) {
        PS_TRY(ps_grow(&files, &question->files_capacity, request->num_files + 1,
                       sizeof *question->files, "names of files", error));
        request->files = question->files = files;
        request->files[request->num_files++] = name;
        return PSPEC_OK;
    }
    const char *const word = ps_text_string(&set->word);
    if (set->count > 0) {
        return set->count < request->num_counts
                   ? PSPEC_OK
                   : ps_fail(
                         error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "the set %.*s has points of more than the %zu number%s that the option "
                         "%s names",
                         (int)strcspn(name, "="), name, request->num_counts,
                         request->num_counts > 1 ? "s" : "", ps_options[PS_OPTION_POINTS].name);
    }
    ps_option_append(&self->command, PS_OPTION_SET, word);
    return ps_option_apply(request, PS_OPTION_SET, ps_options[PS_OPTION_SET].metavar, word, error);
}

/* ---- the request ------------------------------------------------------------------------- */

/* As POINTSPEC_MEMORY for the program: it counts as if it had been said, and so results keep it. */
static void take_memory(asking *self) {
    const uint64_t limit = self->question->context->memory_limit;
    if (limit > 0 && ps_public_takes(self->question->row, PS_OPTION_MEMORY) &&
        !self->request.is_given[PS_OPTION_MEMORY]) {
        self->request.limits.constraints.memory_limit = limit;
        self->request.is_memory_of_environment = true;
        ps_text_append(&self->command, " --%s %llu", ps_options[PS_OPTION_MEMORY].name,
                       (unsigned long long)limit);
    }
}

/* A folder that others can write is as good as none, and there need not be one. */
static pspec_status find_folder(asking *self) {
    ps_error reason = {0};
    const pspec_status status = ps_cache_default_directory(&self->folder, &reason);
    if (status == PSPEC_OK &&
        ps_cache_check_folder(ps_text_string(&self->folder), &reason) == PSPEC_OK) {
        self->request.limits.cache_folder = ps_text_string(&self->folder);
    } else if (status == PSPEC_OK) {
        ps_log_say(&self->question->context->warnings, "no cache: %s", reason.message);
    }
    return status == PSPEC_ERROR_MEMORY ? status : PSPEC_OK;
}

/* before: what the command line has before the name of the command, "" or "plan ". */
static pspec_status begin(asking *self, pspec_question *question, const char *before,
                          ps_error *error) {
    ps_request *const request = &self->request;
    *self = (asking){.question = question, .request = question->request};
    request->num_files = question->num_files;
    request->files = question->files;
    request->limits.device = question->context->selector;
    PS_TRY(PS_NEW(&self->given, question->num_sets, "sets", error));
    request->reading.given.sets = self->given;
    ps_text_append(&self->command, "pointspec %s%s", before, question->row->name);
    take_memory(self);
    ps_text_append(&self->command, "%s", ps_text_string(&question->words));
    for (size_t i = 0; i < question->num_sets; i++) {
        PS_TRY(take_set(self, i, error));
    }
    for (size_t i = 0; i < request->num_files; i++) {
        ps_text_append_word(&self->command, request->files[i]);
    }
    PS_TRY(ps_text_check(&self->command, error));
    request->command_line = ps_text_string(&self->command);
    return find_folder(self);
}

static void end(asking *self) {
    free(self->given);
    ps_text_free(&self->command);
    ps_text_free(&self->folder);
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

/* Callbacks of the context, and its device if it is open. */
static ps_answer_hooks hooks_of(pspec_question *question) {
    pspec_context *const context = question->context;
    return (ps_answer_hooks){.watch = context->watch,
                             .device = context->device,
                             .kept = question->num_sets > 0 ? &question->kept : NULL,
                             .payload = context,
                             .warn = warn,
                             .tell_missing = warn,
                             .tell_plan = say_plan};
}

/* ---- answers ----------------------------------------------------------------------------- */

static pspec_status check_output(const ps_request *request, const ps_command *row,
                                 ps_error *error) {
    return row->makes_points && request->output == NULL && !ps_request_only_draws(request) &&
                   !request->prefetch
               ? ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s needs the option output, the file to write", row->name)
               : PSPEC_OK;
}

/* The points of a sampler that go to no file are an array. */
static const ps_command *choose(ps_request *request, const ps_command *row) {
    const bool is_array = row == &ps_command_sample && request->output == NULL &&
                          !ps_request_only_draws(request) && !request->prefetch;
    request->wants_array = request->wants_array || is_array;
    return is_array ? &ps_kind_points : row;
}

static pspec_status produce(ps_answer *out, const ps_command *row, pspec_question *question,
                            const ps_request *request, ps_error *error) {
    if (row->run != NULL) {
        const ps_answer_hooks hooks = hooks_of(question);
        PS_TRY(check_output(request, row, error));
        return row->run(out, request, &hooks, error);
    }
    PS_TRY(row->check_question(request, error)); /* before a device is opened for nothing */
    if (!row->is_of_host && ps_plan_may_need_device(&request->limits.constraints)) {
        PS_TRY(ps_kind_without_device(row, ps_context_open_device(question->context)));
    }
    const ps_answer_hooks hooks = hooks_of(question);
    return ps_devices_produce(out, row, request, &hooks, error);
}

static pspec_status answer(pspec_answer **out, asking *self, bool is_plan, ps_error *error) {
    const ps_command *const row = choose(&self->request, self->question->row);
    ps_answer made = {0};
    pspec_status status = PSPEC_OK;
    if (is_plan) {
        const ps_answer_hooks hooks = hooks_of(self->question);
        status =
            self->question->row->plan != NULL
                ? ps_plan_command(&made.table, self->question->row, &self->request, &hooks, error)
                : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s is not planned", row->name);
    } else {
        status = produce(&made, row, self->question, &self->request, error);
    }
    if (status != PSPEC_OK) {
        ps_answer_free(&made);
        return status;
    }
    return ps_public_answer(out, &made, is_plan ? NULL : row->fields, error);
}

/* Samplers and files are asked anew, and so is what had another limit. */
static void forget_useless(pspec_question *question) {
    const uint64_t limit = question->context->memory_limit;
    if (question->num_sets == 0 || question->kept_limit != limit) {
        ps_public_forget(question);
    }
    question->kept_limit = limit;
}

static pspec_status ask(pspec_answer **out, pspec_question *question, bool is_plan) {
    asking self;
    if (out == NULL || question == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    ps_error *const error = &question->context->error;
    *out = NULL;
    forget_useless(question);
    pspec_status status = begin(&self, question, is_plan ? "plan " : "", error);
    if (status == PSPEC_OK) {
        status = answer(out, &self, is_plan, error);
    }
    end(&self);
    return status;
}

pspec_status pspec_question_plan(pspec_answer **out, pspec_question *question) {
    return ask(out, question, true);
}

pspec_status pspec_question_answer(pspec_answer **out, pspec_question *question) {
    return ask(out, question, false);
}
