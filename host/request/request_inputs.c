/* Which files a request reads. */
#include "request/option_inputs.h"

#include <string.h>

/* The text of the option in the request; NULL: it was not given. */
static const char *find_value(const ps_request *request, const ps_option *option) {
    const char *value = NULL;
    memcpy(&value, (const char *)request + option->offset, sizeof value);
    return value;
}

pspec_status ps_request_visit_inputs(const ps_request *request, ps_request_visit_input *visit,
                                     void *payload, ps_error *error) {
    for (int id = 0; id < PS_NUM_OPTIONS; id++) {
        const ps_option *const option = &ps_options[id];
        const bool is_text = option->input != NULL && id != PS_OPTION_INTEGRAND; /* a list */
        const char *const value = is_text ? find_value(request, option) : NULL;
        const char *const path = value != NULL ? option->input(option->metavar, value) : NULL;
        if (path != NULL) {
            const ps_request_input input = {ps_option_show(request, (ps_option_id)id), path};
            PS_TRY(visit(payload, &input, error));
        }
    }
    for (size_t i = 0; i < request->num_integrands; i++) {
        const char *const path = ps_input_of_named(NULL, request->integrands[i]);
        if (path != NULL) {
            const ps_request_input input = {ps_option_show(request, PS_OPTION_INTEGRAND), path};
            PS_TRY(visit(payload, &input, error));
        }
    }
    for (size_t i = 0; i < request->num_files; i++) {
        const ps_request_input input = {{"the input"}, request->files[i]};
        PS_TRY(visit(payload, &input, error));
    }
    return PSPEC_OK;
}
