/* Who does what: may the realizations of a job be shared, or what a command keeps, and how many are
 * there?
 */
#include "answers/ranks/ranks_work.h"

#include "answers/checkpoints.h"
#include "answers/output_check.h"
#include "answers/parts/sharing.h"
#include "base/text.h"
#include "device/choice.h"
#include "request/options.h"
#include "spectra/sum_nodes.h"

#include <stdio.h>
#include <string.h>

/* Why this is not shared, as far as the request says it, in *why; "": it may be. */
static void look_at_request(ps_error *why, const ps_command *command, const ps_request *request) {
    if (request->is_given[PS_OPTION_RANGE]) {
        ps_fail(why, PSPEC_ERROR_INVALID_ARGUMENT, "a range is not shared");
    } else {
        ps_sharing_look(why, command, request);
    }
}

/* One process needs nobody to be told. */
static void warn(const ps_ranks *ranks, const ps_ranks_plan *plan, const char *why,
                 const ps_answer_hooks *hooks) {
    const size_t num = ps_ranks_num(ranks);
    const uint64_t blocks = ps_parts_most(plan->job.num_realizations);
    const unsigned long long idle = num - plan->job.num_parts;
    if (ranks == NULL) {
        return;
    }
    if (!plan->job.is_shared) {
        ps_answer_warn(hooks, "rank 0 works alone, and the others of %zu ranks wait: %s", num, why);
    } else if (blocks < num) {
        ps_answer_warn(hooks,
                       "%llu of %zu ranks have nothing to do: realizations are shared in blocks of "
                       "%d, of which there are %llu",
                       idle, num, PS_SUM_BLOCK, (unsigned long long)blocks);
    } else if (plan->job.num_parts < num) {
        ps_answer_warn(hooks,
                       "%llu of %zu ranks have nothing to do: by its checkpoints the job was begun "
                       "in %llu parts",
                       idle, num, (unsigned long long)plan->job.num_parts);
    }
}

/* counts: sets in files, too. */
static pspec_status look(ps_outlook *outlook, ps_ranks_plan *out, bool counts,
                         const ps_command *command, const ps_request *request,
                         const ps_answer_hooks *hooks, ps_error *error) {
    *outlook = (ps_outlook){.counts = counts};
    const pspec_status status = command->look_ahead(outlook, request, hooks, error);
    out->alike = outlook->alike;
    return status;
}

/* Of a row that has such shares: only why not is said, or that there are few. */
static pspec_status look_at_shares(ps_ranks_plan *out, const ps_ranks *ranks,
                                   const ps_command *command, const ps_request *request,
                                   const ps_answer_hooks *hooks, ps_error *error) {
    const size_t num_ranks = ps_ranks_num(ranks);
    uint64_t num = 0;
    ps_error why = {0};
    PS_TRY(command->look_at_shares(&num, &why, request, error));
    out->job.has_shares = why.message[0] == '\0';
    if (!out->job.has_shares) {
        warn(ranks, out, why.message, hooks);
    } else if (num < num_ranks) {
        ps_answer_warn(hooks, "%zu of %zu ranks have nothing to do: there is work for %zu",
                       num_ranks - (size_t)num, num_ranks, (size_t)num);
    }
    return PSPEC_OK;
}

/* Of rank 0. */
static pspec_status plan(ps_ranks_plan *out, const ps_ranks *ranks, const ps_command *command,
                         const ps_request *request, const ps_answer_hooks *hooks, ps_error *error) {
    uint64_t found = 0;
    ps_error why = {0};
    if (ranks != NULL && command->look_at_shares != NULL) {
        return look_at_shares(out, ranks, command, request, hooks, error);
    }
    look_at_request(&why, command, request);
    if (why.message[0] == '\0') {
        PS_TRY(ps_sharing_find_begun(&found, &why, request, error));
    }
    if (why.message[0] == '\0' && (ranks != NULL || found > 0)) {
        ps_outlook outlook;
        ps_table_format format = PS_FORMAT_CSV;
        PS_TRY(ps_answer_check_outputs(&format, command, request, hooks, error));
        PS_TRY(look(&outlook, out, true, command, request, hooks, error));
        ps_sharing_look_at_job(&why, &outlook, outlook.num_realizations);
        out->job.num_realizations = outlook.num_realizations;
        out->job.is_shared = why.message[0] == '\0';
    }
    if (out->job.is_shared) {
        PS_TRY(ps_sharing_choose_parts(&out->job.num_parts, found, ps_ranks_num(ranks),
                                       out->job.num_realizations, error));
    }
    warn(ranks, out, why.message, hooks);
    return PSPEC_OK;
}

/* Of the others, at the same time. */
static void prepare(ps_ranks_plan *out, const ps_command *command, const ps_request *request,
                    const ps_answer_hooks *hooks) {
    ps_error why = {0};
    ps_outlook outlook;
    look_at_request(&why, command, request);
    if (why.message[0] == '\0') {
        (void)look(&outlook, out, false, command, request, hooks, &out->failure);
    }
}

void ps_ranks_plan_free(ps_ranks_plan *plan) {
    ps_text_free(&plan->alike);
}

pspec_status ps_ranks_plan_work(ps_ranks_plan *out, ps_ranks *ranks, const ps_command *command,
                                const ps_request *request, const ps_answer_hooks *hooks,
                                ps_error *error) {
    ps_text lines = {0};
    *out = (ps_ranks_plan){0};
    if (ranks == NULL &&
        (request->limits.checkpoint.path == NULL || ps_selector_is_list(request->limits.device))) {
        return PSPEC_OK;
    }
    if (ranks == NULL) {
        return plan(out, ranks, command, request, hooks, error);
    }
    ps_text_append(&lines, "program: ");
    pspec_status status = ps_answer_identify_program(&lines, error);
    ps_text_append(&lines, "command line: %s\n", request->command_line);
    if (status == PSPEC_OK && ps_ranks_own(ranks) == 0) {
        status = plan(out, ranks, command, request, hooks, error);
    } else if (status == PSPEC_OK) {
        prepare(out, command, request, hooks);
    }
    status = ps_ranks_compare(ranks, &lines, status, &out->job, sizeof out->job, error);
    ps_text_free(&lines);
    return status;
}
