#include "cli/answer.h"

#include "report/angular_table.h"
#include "cli/jobs.h"
#include "report/pairs_table.h"
#include "report/power_table.h"

#include <stdlib.h>

/* ---- spectra ----------------------------------------------------------------------------- */

typedef pspec_status make_table(ps_table **, const ps_request *, const ps_power_job *const *,
                                size_t, ps_error *);

static pspec_status take_array(ps_answer *out, const ps_spectrum *spectrum, ps_error *error) {
    size_t num = 0;
    PS_TRY(ps_spectrum_full(spectrum, 0, (ps_mean){0}, &out->array, &num, error));
    out->side = 2 * (size_t)spectrum->frequencies.max_frequency + 1;
    return PSPEC_OK;
}

static pspec_status take_results(ps_answer *out, const ps_request *request, make_table *make,
                                 const ps_power_job *job, ps_error *error) {
    const ps_spectrum *const spectrum = ps_power_job_spectrum(job);
    enum { PLANE = 2 };
    /* lists, and subsets of rings, fill no array */
    if (request->wants_picture && spectrum->frequencies.dimension == PLANE &&
        spectrum->frequencies.kind == PS_FREQUENCIES_BOX) {
        PS_TRY(take_array(out, spectrum, error));
    }
    return make(&out->table, request, &job, 1, error);
}

static pspec_status answer_spectrum(ps_answer *out, const ps_request *request,
                                    ps_question_kind kind, make_table *make,
                                    const ps_answer_hooks *hooks, ps_error *error) {
    ps_question_list list;
    ps_power_job *job = NULL;
    PS_TRY(ps_questions_make(&list, request, kind, error));
    pspec_status status = ps_jobs_run_one(request, &list.questions[0], hooks, &job, error);
    if (status == PSPEC_OK) {
        status = take_results(out, request, make, job, error);
    }
    ps_power_job_destroy(job);
    return status;
}

/* ---- all kinds --------------------------------------------------------------------------- */

pspec_status ps_answer_make(ps_answer *out, const ps_result_kind *kind, const ps_request *request,
                            const ps_answer_hooks *hooks, ps_error *error) {
    *out = (ps_answer){0};
    if (kind == &ps_result_power) {
        return answer_spectrum(out, request, PS_QUESTION_POWER, ps_power_table, hooks, error);
    }
    if (kind == &ps_result_angular) {
        return answer_spectrum(out, request, PS_QUESTION_ANGULAR, ps_angular_table, hooks, error);
    }
    if (kind == &ps_result_pairs) {
        return answer_spectrum(out, request, PS_QUESTION_PAIRS, ps_pairs_table, hooks, error);
    }
    if (kind == &ps_result_quadrature) {
        return ps_quadrature_answer(&out->table, request, hooks, error);
    }
    return kind == &ps_result_truncation ? ps_truncation_answer(&out->table, request, hooks, error)
                                         : ps_check_answer(&out->table, request, hooks, error);
}

pspec_status ps_answer_check(const ps_result_kind *kind, const ps_request *request,
                             ps_error *error) {
    return kind == &ps_result_truncation ? ps_truncation_check(request, error)
                                         : ps_check_check(request, error);
}

void ps_answer_free(ps_answer *answer) {
    ps_table_destroy(answer->table);
    free(answer->array);
    *answer = (ps_answer){0};
}
