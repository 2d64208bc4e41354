/* One option: how it was said, and its value in the request. */
#include "request/option_setters.h"

#include <stdio.h>

ps_shown_option ps_option_show(const ps_request *request, ps_option_id id) {
    ps_shown_option out;
    const ps_option_form form = request->forms[id];
    if (form == PS_FORM_LETTER) {
        snprintf(out.text, sizeof out.text, "-%c", ps_options[id].letter);
    } else {
        snprintf(out.text, sizeof out.text, "%s%s", form == PS_FORM_KEY ? "" : "--",
                 ps_options[id].name);
    }
    return out;
}

pspec_status ps_option_set(ps_request *request, ps_option_id id, const char *words,
                           const char *value, ps_error *error) {
    const ps_option *const option = &ps_options[id];
    const ps_shown_option shown = ps_option_show(request, id);
    const ps_said said = {option, shown.text, words, value, request};
    request->said[id] = value;
    return option->set(&said, error);
}
