#include "request/option_text.h"

#include "base/text.h"

#include <string.h>

size_t ps_name_distance(const char *typed, const char *known) {
    const size_t length = strlen(typed);
    const bool is_beginning = length > 0 && strncmp(known, typed, length) == 0;
    const bool goes_on = strncmp(known, typed, strlen(known)) == 0;
    const size_t distance = ps_text_distance(typed, known);
    return distance > 1 && (is_beginning || goes_on) ? 1 : distance;
}

pspec_status ps_option_apply(ps_request *request, ps_option_id id, const char *words,
                             const char *text, ps_error *error) {
    if (ps_options[id].metavar == NULL) {
        if (strcmp(text, "false") == 0) {
            return PSPEC_OK;
        }
        if (strcmp(text, "true") != 0) {
            return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "true or false, not \"%s\"", text);
        }
    }
    request->is_given[id] = true;
    request->forms[id] = PS_FORM_KEY;
    return ps_option_set(request, id, words, text, error);
}

void ps_option_append(ps_text *command, ps_option_id id, const char *text) {
    const char *const name = ps_options[id].name;
    if (ps_options[id].metavar == NULL) {
        if (strcmp(text, "true") == 0) {
            ps_text_append(command, " --%s", name);
        }
        return;
    }
    if (text[0] != '-') {
        ps_text_append(command, " --%s", name);
        ps_text_append_word(command, text);
        return;
    }
    ps_text word = {0}; /* one word, since the value looks like an option */
    ps_text_append(&word, "--%s=%s", name, text);
    ps_text_append_word(command, ps_text_string(&word));
    command->failed = command->failed || word.failed;
    ps_text_free(&word);
}

pspec_status ps_option_find(ps_option_id *out, const char *name, ps_option_taken *takes,
                            const void *taker, const char *name_of_taker, ps_error *error) {
    size_t best = SIZE_MAX;
    *out = PS_NUM_OPTIONS;
    for (int id = 0; id < PS_NUM_OPTIONS; id++) {
        const size_t distance = ps_name_distance(name, ps_options[id].name);
        if (distance < best && takes(taker, (ps_option_id)id)) {
            best = distance;
            *out = (ps_option_id)id;
        }
    }
    return best == 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s takes no option \"%s\"%s",
                         name_of_taker, name,
                         ps_text_suggest(name, *out < PS_NUM_OPTIONS ? ps_options[*out].name : "",
                                         best, "; did you mean ", "?")
                             .text);
}
