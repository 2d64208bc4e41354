/* The variance of Monte Carlo integration, predicted from spectra and measured beside it. */
#include "answers/compare.h"
#include "answers/spectra/spectra.h"
#include "answers/variance/tail_verdict.h"
#include "answers/variance/variance_question.h"
#include "answers/variance/variance_table.h"
#include "base/memory.h"

#include <stdlib.h>

typedef struct variances {
    ps_variance_list list;
    ps_device *device;      /* of all of them, where they share one that was opened for them */
    ps_variance_job **jobs; /* [list.num] */
    ps_error verdict;       /* on --tail */
} variances;

static pspec_status check_question(const ps_request *request, ps_error *error) {
    ps_variance_list list;
    const pspec_status status = ps_variance_list_make(&list, request, error);
    ps_variance_list_free(&list);
    return status;
}

/* ---- plan ---------------------------------------------------------------------------------- */

static void add_trials(const void *job, ps_phases *phases) {
    ps_variance_job_phases(job, phases);
}

static pspec_status plan_one(ps_planner *planner, const ps_request *request,
                             ps_variance_question *question, size_t index, ps_error *error) {
    ps_variance_job *job = NULL;
    question->spectrum.open_device = planner->device;
    ps_plan_table_begin_question(planner, request, index);
    PS_TRY(ps_plan_table_find_lack(planner, &question->spectrum.limits.constraints,
                                   &question->spectrum.may_lack_device, error));
    PS_TRY(ps_variance_job_create(&job, question, error));
    ps_power_job_rate_skips(ps_variance_job_spectrum(job));
    const ps_plan_more more = {add_trials, job};
    const pspec_status status =
        ps_spectra_plan_job(planner, request, ps_variance_job_spectrum(job), &more, index, error);
    ps_variance_job_destroy(job);
    return status;
}

static pspec_status plan(ps_planner *planner, const ps_request *request, ps_error *error) {
    ps_variance_list list;
    pspec_status status = ps_variance_list_make(&list, request, error);
    for (size_t i = 0; status == PSPEC_OK && i < list.num; i++) {
        status = plan_one(planner, request, &list.questions[i], i, error);
    }
    ps_variance_list_free(&list);
    return status;
}

/* ---- work ---------------------------------------------------------------------------------- */

static pspec_status run_one(ps_variance_job **job, ps_variance_question *question,
                            const ps_answer_hooks *hooks, ps_error *error) {
    question->spectrum.watch = hooks->watch;
    if (hooks->device != NULL) {
        question->spectrum.open_device = hooks->device;
    }
    ps_answer_begin_next(hooks);
    PS_TRY(ps_variance_job_create(job, question, error));
    ps_power_job *const spectrum = ps_variance_job_spectrum(*job);
    if (hooks->tell_plan != NULL) {
        hooks->tell_plan(hooks->payload, ps_power_job_plan(spectrum));
    }
    PS_TRY(ps_variance_job_run(*job, error));
    ps_answer_warn_of(hooks, ps_power_job_trouble(spectrum));
    if (hooks->tell_profile != NULL) {
        size_t num_rows = 0;
        const ps_profile_row *const rows = ps_power_job_profile(spectrum, &num_rows);
        hooks->tell_profile(hooks->payload, rows, num_rows);
    }
    return PSPEC_OK;
}

static pspec_status compute(void **out, const ps_request *request, const ps_answer_hooks *hooks,
                            ps_error *error) {
    PS_TRY(ps_allocate(out, 1, sizeof(variances), "variances", error));
    variances *const work = *out;
    ps_variance_list *const list = &work->list;
    PS_TRY(ps_variance_list_make(list, request, error));
    PS_TRY(PS_NEW(&work->jobs, list->num, "jobs", error));
    PS_TRY(ps_answer_open_device(&work->device, request,
                                 &list->questions[0].spectrum.limits.constraints, list->num, hooks,
                                 error));
    for (size_t i = 0; i < list->num; i++) {
        list->questions[i].spectrum.open_device = work->device;
        PS_TRY(run_one(&work->jobs[i], &list->questions[i], hooks, error));
    }
    return ps_variance_judge_tails(&work->verdict, request, work->jobs, list->num, error);
}

static pspec_status tabulate(ps_answer *out, const void *computed, const ps_request *request,
                             ps_error *error) {
    const variances *const work = computed;
    out->verdict = work->verdict;
    return ps_variance_table(&out->table, request, work->jobs, work->list.num, &work->verdict,
                             error);
}

/* By a table, as scenes have it. */
static pspec_status draw(const void *computed, const ps_request *request, ps_error *error) {
    ps_answer rows = {0};
    pspec_status status = tabulate(&rows, computed, request, error);
    if (status == PSPEC_OK) {
        status = ps_variance_plot(request, rows.table, error);
    }
    ps_answer_free(&rows);
    return status;
}

static void discard(void *computed) {
    variances *const work = computed;
    if (work == NULL) {
        return;
    }
    for (size_t i = 0; work->jobs != NULL && i < work->list.num; i++) {
        ps_variance_job_destroy(work->jobs[i]);
    }
    free(work->jobs);
    ps_variance_list_free(&work->list);
    ps_device_close(work->device);
    free(work);
}

/* ---- what tables mean ------------------------------------------------------------------------ */

static const char *const summary[] = {"points", "points_smallest", "points_largest", "realizations",
                                      "shifts", "most_power",      "most_power_is",  NULL};
static const char *const sentences[] = {"rates", "crossing", "ranking", NULL};
static const ps_line_kind lines[] = {{.suffix = NULL}}; /* a question is a row for each integrand */

const ps_kind ps_kind_variance = {
    .name = "variance",
    .bit = PS_VERB_BIT(variance),
    .samples = PS_DOMAIN_ANY,
    .counted = "realizations",
    .check_question = check_question,
    .plan = plan,
    .compute = compute,
    .tabulate = tabulate,
    .draw = draw,
    .discard = discard,
    .summary = summary,
    .lines = lines,
    .chart = ps_variance_chart,
    .sentences = sentences,
    .has_few_rows = true,
    .compare = ps_compare_variances,
};
