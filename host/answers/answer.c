#include "answers/kept_rows.h"
#include "base/text.h"
#include "request/point_source.h"

#include <stdarg.h>
#include <stdio.h>

void ps_answer_begin_next(const ps_answer_hooks *hooks) {
    if (hooks->next != NULL) {
        hooks->next(hooks->payload);
    }
}

void ps_answer_begin_job(const ps_answer_hooks *hooks, ps_watch *watch, ps_device **open_device) {
    *watch = hooks->watch;
    *open_device = hooks->device != NULL ? hooks->device : *open_device;
    ps_answer_begin_next(hooks);
}

void ps_answer_end(const ps_answer_hooks *hooks) {
    if (hooks->end != NULL) {
        hooks->end(hooks->payload);
    }
}

bool ps_answer_is_interrupted(const ps_answer_hooks *hooks) {
    return hooks->is_interrupted != NULL && hooks->is_interrupted(hooks->payload);
}

static void say(void (*hear)(void *payload, const char *sentence), void *payload,
                const char *format, va_list arguments) {
    char sentence[PS_MESSAGE_BYTES];
    if (hear != NULL) {
        vsnprintf(sentence, sizeof sentence, format, arguments);
        hear(payload, sentence);
    }
}

void ps_answer_warn(const ps_answer_hooks *hooks, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    say(hooks->warn, hooks->payload, format, arguments);
    va_end(arguments);
}

void ps_answer_warn_of(const ps_answer_hooks *hooks, const char *sentence) {
    if (sentence[0] != '\0') {
        ps_answer_warn(hooks, "%s", sentence);
    }
}

void ps_answer_tell_missing(const ps_answer_hooks *hooks, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    say(hooks->tell_missing, hooks->payload, format, arguments);
    va_end(arguments);
}

void ps_answer_tell_profile(const ps_answer_hooks *hooks, const ps_device *device) {
    size_t num = 0;
    if (hooks->tell_profile != NULL) {
        const ps_profile_row *const rows = device != NULL ? ps_device_profile(device, &num) : NULL;
        hooks->tell_profile(hooks->payload, rows, num);
    }
}

static pspec_status check_input(void *payload, const ps_request_file *input, ps_error *error) {
    (void)payload;
    return ps_request_file_comes_once(input)
               ? ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s \"%s\" comes once",
                         input->option.text, input->path)
               : PSPEC_OK;
}

pspec_status ps_answer_look_at_inputs(const ps_request *request, ps_error *why) {
    if (request->reading.given.num > 0) {
        return ps_fail(why, PSPEC_ERROR_INVALID_ARGUMENT, "points of the caller are not shared");
    }
    if (request->integrands_given.num > 0) {
        return ps_fail(why, PSPEC_ERROR_INVALID_ARGUMENT, "functions of the caller are not shared");
    }
    return ps_request_visit_inputs(request, check_input, NULL, why);
}

pspec_status ps_answer_look_at_rows(uint64_t *num, ps_error *why, const ps_request *request,
                                    ps_error *error) {
    (void)error;
    *num = ps_request_has_samplers(request) ? ps_num_realizations_asked(request) : UINT64_MAX;
    if (ps_answer_look_at_inputs(request, why) == PSPEC_OK) {
        why->message[0] = '\0';
        if (*num < 2) {
            ps_fail(why, PSPEC_ERROR_INVALID_ARGUMENT, "one realization is not shared");
        }
    }
    return PSPEC_OK;
}

pspec_status ps_answer_make(ps_answer *out, const ps_kind *kind, const ps_request *request,
                            const ps_answer_hooks *hooks, ps_error *error) {
    void *computed = NULL;
    ps_request own = *request;
    ps_row_tape tape;
    *out = (ps_answer){0};
    own.limits.checkpoint.team = hooks->team;
    pspec_status status = ps_kept_rows_begin(&tape, &own, kind, error);
    if (status == PSPEC_OK) {
        status = kind->compute(&computed, &own, hooks, error);
    }
    if (status == PSPEC_OK) {
        status = ps_team_meet(hooks->team, status, error);
    }
    if (status == PSPEC_OK && ps_team_is_led_here(hooks->team)) {
        status = kind->tabulate(out, computed, &own, error);
    }
    if (status == PSPEC_OK && ps_team_is_led_here(hooks->team)) {
        status = ps_kept_rows_add(out->table, &own, error);
    }
    kind->discard(computed);
    ps_row_tape_free(&tape);
    return status;
}

void ps_answer_free(ps_answer *answer) {
    ps_table_destroy(answer->table);
    *answer = (ps_answer){0};
}
