/* Jobs before they run, for ranks that share their realizations. */
#include "answers/spectra/spectra.h"

static pspec_status look(void *payload, ps_error *error) {
    const ps_power_job *const job = payload;
    return ps_watch_tell(&job->question->watch, "sets", 0, 0, NULL, error);
}

/* Files do not say how many sets they have. */
static pspec_status count(uint64_t *out, ps_power_job *job, ps_error *error) {
    ps_passed_sets passed = {0};
    PS_TRY(ps_power_sets_pass(&job->sets, UINT64_MAX, look, job, &passed, error));
    *out = passed.num;
    return PSPEC_OK;
}

static pspec_status add(ps_outlook *out, ps_power_job *job, ps_error *error) {
    const ps_device_limits *const limits = ps_device_get_limits(job->device);
    const ps_candidate *const chosen = job->plan.chosen;
    const bool is_on_host = limits == NULL || chosen == NULL || !chosen->engine->needs_device;
    ps_text_append(&out->alike, "device: %s\n", is_on_host ? "host" : limits->name);
    if (chosen != NULL) {
        ps_text_append(&out->alike, "engine: %s, %s\n", chosen->engine->name,
                       ps_precision_name(chosen->precision));
    }
    if (job->needs.one_realization) {
        out->alone = "all realizations of a sampler have the same powers, and one stands for all";
    }
    out->num_realizations = job->num_realizations;
    out->num_jobs++;
    return out->counts && job->question->sampler == NULL ? count(&out->num_realizations, job, error)
                                                         : PSPEC_OK;
}

static pspec_status look_ahead_at(ps_outlook *out, ps_power_question *question,
                                  const ps_answer_hooks *hooks, ps_error *error) {
    ps_power_job *job = NULL;
    question->watch = hooks->watch;
    PS_TRY(ps_power_job_create(&job, question, error));
    const pspec_status status = add(out, job, error);
    ps_power_job_destroy(job);
    return status;
}

pspec_status ps_spectra_look_ahead(ps_outlook *out, const ps_request *request,
                                   ps_question_kind kind, const ps_answer_hooks *hooks,
                                   ps_error *error) {
    ps_question_list list;
    pspec_status status = ps_questions_make(&list, request, kind, error);
    for (size_t i = 0; status == PSPEC_OK && i < list.num; i++) {
        list.questions[i].limits.checkpoint.path = NULL;
        status = look_ahead_at(out, &list.questions[i], hooks, error);
    }
    ps_questions_free(&list);
    return status == PSPEC_OK ? ps_text_check(&out->alike, error) : status;
}
