#include "answers/parts/sharing.h"

#include "answers/output_check.h"
#include "request/options.h"
#include "spectra/sum_nodes.h"

/* Who answers a part reads the inputs for it. */
static pspec_status check_file(void *payload, const ps_request_file *input, ps_error *error) {
    (void)payload;
    return ps_request_file_comes_once(input)
               ? ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s \"%s\" comes once",
                         input->option.text, input->path)
               : PSPEC_OK;
}

/* What goes with other options goes with them as a range, too. */
static pspec_status check_options(const ps_request *request, ps_error *why) {
    ps_request ranged = *request;
    ranged.is_given[PS_OPTION_RANGE] = true;
    ranged.forms[PS_OPTION_RANGE] = PS_FORM_LONG;
    return ps_option_pairs_check(request, PS_COMMAND_power, NULL) == PSPEC_OK
               ? ps_option_pairs_check(&ranged, PS_COMMAND_power, why)
               : PSPEC_OK;
}

static pspec_status look_at_request(const ps_command *command, const ps_request *request,
                                    ps_error *why) {
    if (command->look_ahead == NULL) {
        return ps_fail(why, PSPEC_ERROR_INVALID_ARGUMENT, "%s has no realizations that are shared",
                       command->name);
    }
    if (request->reading.given.num > 0) {
        return ps_fail(why, PSPEC_ERROR_INVALID_ARGUMENT, "points of the caller are not shared");
    }
    PS_TRY(check_options(request, why));
    return ps_request_visit_inputs(request, check_file, NULL, why);
}

static pspec_status look_at_job(const ps_outlook *outlook, uint64_t num, ps_error *why) {
    if (outlook->alone != NULL) {
        return ps_fail(why, PSPEC_ERROR_INVALID_ARGUMENT, "%s", outlook->alone);
    }
    return num > PS_SUM_BLOCK
               ? PSPEC_OK
               : ps_fail(why, PSPEC_ERROR_INVALID_ARGUMENT,
                         "realizations are shared in blocks of %d, and there %s %llu", PS_SUM_BLOCK,
                         num == 1 ? "is" : "are", (unsigned long long)num);
}

pspec_status ps_sharing_find(ps_sharing *out, const ps_command *command, const ps_request *request,
                             const ps_answer_hooks *hooks, ps_error *error) {
    ps_outlook outlook = {.counts = request->range.end == 0};
    ps_table_format format = PS_FORMAT_CSV;
    *out = (ps_sharing){0};
    if (look_at_request(command, request, &out->why) != PSPEC_OK) {
        return PSPEC_OK;
    }
    out->why.message[0] = '\0';
    PS_TRY(ps_answer_check_outputs(&format, command, request, hooks, error));
    const pspec_status status = command->look_ahead(&outlook, request, hooks, error);
    ps_text_free(&outlook.alike);
    PS_TRY(status);
    out->num_jobs = outlook.num_jobs;
    out->num_realizations =
        outlook.counts ? outlook.num_realizations : request->range.end - request->range.first;
    if (look_at_job(&outlook, out->num_realizations, &out->why) == PSPEC_OK) {
        out->why.message[0] = '\0';
    }
    return PSPEC_OK;
}
