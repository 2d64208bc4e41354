#include "answers/parts/sharing.h"

#include "answers/parts/parts.h"
#include "request/options.h"
#include "spectra/sum_nodes.h"

/* What goes with other options goes with them as a range, too. */
static pspec_status check_options(const ps_request *request, ps_error *why) {
    ps_request ranged = *request;
    ranged.is_given[PS_OPTION_RANGE] = true;
    ranged.forms[PS_OPTION_RANGE] = PS_FORM_LONG;
    return ps_option_pairs_check(request, PS_COMMAND_power, NULL) == PSPEC_OK
               ? ps_option_pairs_check(&ranged, PS_COMMAND_power, why)
               : PSPEC_OK;
}

static pspec_status look(ps_error *why, const ps_command *command, const ps_request *request) {
    if (command->look_ahead == NULL) {
        return ps_fail(why, PSPEC_ERROR_INVALID_ARGUMENT, "%s has no realizations that are shared",
                       command->name);
    }
    PS_TRY(check_options(request, why));
    return ps_answer_look_at_inputs(request, why);
}

void ps_sharing_look(ps_error *why, const ps_command *command, const ps_request *request) {
    if (look(why, command, request) == PSPEC_OK) {
        why->message[0] = '\0';
    }
}

void ps_sharing_look_at_job(ps_error *why, const ps_outlook *outlook, uint64_t num_realizations) {
    if (outlook->alone != NULL) {
        ps_fail(why, PSPEC_ERROR_INVALID_ARGUMENT, "%s", outlook->alone);
    } else if (num_realizations <= PS_SUM_BLOCK) {
        ps_fail(why, PSPEC_ERROR_INVALID_ARGUMENT,
                "realizations are shared in blocks of %d, and there %s %llu", PS_SUM_BLOCK,
                num_realizations == 1 ? "is" : "are", (unsigned long long)num_realizations);
    }
}

pspec_status ps_sharing_find_begun(uint64_t *found, ps_error *why, const ps_request *request,
                                   ps_error *error) {
    const char *const path = request->limits.checkpoint.path;
    *found = 0;
    if (path != NULL) {
        PS_TRY(ps_parts_find(found, path, error));
    }
    if (*found == 1) {
        ps_fail(why, PSPEC_ERROR_INPUT, "\"%s\" is the checkpoint of one process", path);
    }
    return PSPEC_OK;
}

pspec_status ps_sharing_choose_parts(uint64_t *num_parts, uint64_t found, uint64_t wanted,
                                     uint64_t num_realizations, ps_error *error) {
    const uint64_t most = ps_parts_most(num_realizations);
    *num_parts = found > 0 ? found : wanted < most ? wanted : most;
    return found <= most
               ? PSPEC_OK
               : ps_fail(
                     error, PSPEC_ERROR_INPUT,
                     "there are checkpoints of another job: it has %llu parts, and this one %llu "
                     "blocks of %d realizations",
                     (unsigned long long)found, (unsigned long long)most, PS_SUM_BLOCK);
}
