/* One question answered: the table that a command prints and that a scene collects. */
#ifndef PS_CLI_ANSWER_H
#define PS_CLI_ANSWER_H

#include "cli/command.h"
#include "tables/table.h"
#include "jobs/spectrum/power_job.h"
#include "plan/phases.h"

/* Who is told how far it is, and what there is already. */
typedef struct ps_answer_hooks {
    ps_watch watch;
    ps_device
        *device; /* borrowed; NULL: the one that the request names is opened where it is needed */
} ps_answer_hooks;

typedef struct ps_answer {
    ps_table *table;
    double *
        array; /* the averaged periodogram on the whole square, [side][side], where request->wants_picture
                      and there is one; NULL: none */
    size_t side;
} ps_answer;

/* Of one sampler, or of files. *out is freed by ps_answer_free, also after an error. A check that found differences is no
 * error: the header of its table has the verdict. */
pspec_status ps_answer_make(ps_answer *out, const ps_result_kind *kind, const ps_request *request,
                            const ps_answer_hooks *hooks, ps_error *error) PS_MUST_CHECK;
void ps_answer_free(ps_answer *answer);

/* What an answer would refuse before any work, of the kinds truncation and check. */
pspec_status ps_answer_check(const ps_result_kind *kind, const ps_request *request,
                             ps_error *error) PS_MUST_CHECK;

/* Of kinds whose command is more than a spectrum job; arguments were looked at by the command. */
pspec_status ps_quadrature_answer(ps_table **out, const ps_request *request,
                                  const ps_answer_hooks *hooks, ps_error *error) PS_MUST_CHECK;
pspec_status ps_truncation_answer(ps_table **out, const ps_request *request,
                                  const ps_answer_hooks *hooks, ps_error *error) PS_MUST_CHECK;
/* How long its phases take. */
pspec_status ps_truncation_phases(const ps_request *arguments, ps_phases *phases,
                                  ps_error *error) PS_MUST_CHECK;
pspec_status ps_truncation_check(const ps_request *request, ps_error *error) PS_MUST_CHECK;
pspec_status ps_check_check(const ps_request *request, ps_error *error) PS_MUST_CHECK;
pspec_status ps_check_answer(ps_table **out, const ps_request *request,
                             const ps_answer_hooks *hooks, ps_error *error) PS_MUST_CHECK;

#endif
