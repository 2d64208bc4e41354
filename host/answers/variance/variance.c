/* The variance of Monte Carlo integration, predicted from spectra and measured beside it. */
#include "answers/kept_rows.h"
#include "answers/ranges/row_ranges.h"
#include "answers/spectra/spectra.h"
#include "answers/variance/tail_verdict.h"
#include "answers/variance/variance_table.h"
#include "base/memory.h"

#include <stdlib.h>

typedef struct variances {
    ps_variance_list list;
    ps_device *device;      /* of all of them, where they share one that was opened for them */
    ps_variance_job **jobs; /* [list.num] */
    ps_error verdict;       /* on --tail */
} variances;

/* A spectrum and the trials beside it, unless nothing is measured. */
static size_t count_jobs(const ps_request *request) {
    const bool measures = !request->is_given[PS_OPTION_SHIFTS] || request->num_shifts > 0;
    return ps_request_num_questions(request) * (measures ? 2 : 1);
}

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
    ps_power_question *const spectrum = &question->spectrum;
    PS_TRY(ps_plan_table_begin_question(planner, request, index, &spectrum->limits.constraints,
                                        &spectrum->open_device, &spectrum->may_lack_device, error));
    PS_TRY(ps_variance_job_create(&job, question, error));
    ps_power_job_rate_skips(job->spectrum);
    const ps_plan_more more = {add_trials, job};
    const pspec_status status =
        ps_spectra_plan_job(planner, request, job->spectrum, &more, index, error);
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
    ps_answer_begin_job(hooks, &question->spectrum.watch, &question->spectrum.open_device);
    PS_TRY(ps_variance_job_create(job, question, error));
    ps_power_job *const spectrum = (*job)->spectrum;
    if (hooks->tell_plan != NULL) {
        hooks->tell_plan(hooks->payload, &spectrum->plan);
    }
    PS_TRY(ps_variance_job_run(*job, error));
    ps_answer_warn_of(hooks, ps_source_trouble(spectrum->sets.source));
    ps_answer_tell_profile(hooks, spectrum->device);
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
/* A question is a row for each integrand. */
static const ps_picture_kind pictures[] = {
    {.make = ps_variance_figure,
     .dealing = PS_OF_COUNTS,
     .by = PS_BY_SCENE | PS_BY_COMMAND,
     .panels = "integrand",
     .x = "points",
     .lines = {{.y = "predicted", .low = "lower", .high = "upper", .look = PS_LOOK_CURVE},
               {.y = "measured", .error = "measured_error", .look = PS_LOOK_MARKS, .name = ""},
               {.y = "best_bound", .look = PS_LOOK_BOUND, .name = "best bound"},
               {.y = "worst_bound", .look = PS_LOOK_BOUND, .name = "worst bound"},
               {.y = "white", .look = PS_LOOK_REFERENCE, .name = "white noise", .is_of_all = true}},
     .x_label = "points N",
     .is_log_x = true,
     .is_log_y = true,
     .find_slope = ps_variance_find_slope,
     .write_title = ps_variance_write_title},
    {.make = NULL}};

static const ps_field_row own_fields[] = {
    {"trials", "", PS_ENTRY, 0, "", "what a trial is, where there are any"},
    {"shifts", "", PS_ENTRY, 0, "", "random moves of each set that is measured"},
    {"predicted_error_is", "", PS_ENTRY, 0, "",
     "that predicted_error of the header and of the columns are two things"},
    {"measured_error_is", "", PS_ENTRY, 0, "", "what measured_error holds"},
    {"sum", "", PS_ENTRY, 0, "--bins shells", "over which frequencies the prediction sums"},
    {"paper", "", PS_ENTRY, 0, "--paper-formula", "what the column of that name is"},
    {"tail", "", PS_ENTRY, 0, "--tail", "what the cut-off may leave open, as it was asked for"},
    {"tail_largest", "", PS_ENTRY, 0, "--tail", "the largest half of upper - lower over predicted"},
    {"tail_verdict", "", PS_ENTRY, 0, "--tail", "reached, or the sentence"},
    {"integrand", "", PS_ENTRIES, 0, "", "the integrand"},
    {"integral", "", PS_ENTRIES, 0, "", "its integral"},
    {"integrand_note", "", PS_ENTRIES, 0, "some integrands", "what else there is to know of it"},
    {"measured_sets", "", PS_ENTRIES, 0, "files", "how many sets are measured"},
    {"white_power", "", PS_ENTRIES, 0, "files",
     "power of white noise with their weights, mean(N) mean(V/W^2)"},
    {"student_95", "", PS_ENTRIES, 0, "trials",
     "how many standard errors hold 95 % of normal numbers, from as many sets or moves"},
    {"most_power", "", PS_ENTRIES, 0, "", "the largest power beyond the cut-off"},
    {"most_power_is", "", PS_ENTRIES, 0, "", "a bound, or assumed, and why"},
    {"pairwise_variance", "", PS_ENTRIES, 0, "single sets",
     "the variance once more, exact, by a sum over pairs of points"},
    {"predicted", "", PS_COLUMN, 0, "",
     "variance by the spectra of M realizations, with white noise beyond the cut-off"},
    {"predicted_error", "", PS_COLUMN, 0, "",
     "its standard error over realizations; missing for one of several that there could be"},
    {"lower", "", PS_COLUMN, 0, "", "the prediction without power beyond the cut-off"},
    {"upper", "", PS_COLUMN, 0, "",
     "the prediction with most_power of the header beyond the cut-off"},
    {"measured", "", PS_COLUMN, 0, "",
     "mean square of estimate minus integral over other realizations and their moves"},
    {"measured_error", "", PS_COLUMN, 0, "", "its standard error"},
    {"z_score", "", PS_COLUMN, 0, "",
     "measured minus predicted over both errors; missing with --in-place and where nothing varies "
     "but by rounding"},
    {"white", "", PS_COLUMN, 0, "", "variance of as many independent points"},
    {"best_bound", "", PS_COLUMN, 0, "--bounds", "variance by the profile below the power"},
    {"worst_bound", "", PS_COLUMN, 0, "--bounds", "variance by the profile above the power"},
    {"rate_here", "", PS_COLUMN, 0, "--rates", "r of N^-r from the N before to this one"},
    {"rate_here_error", "", PS_COLUMN, 0, "--rates", "its standard error"},
    {"rank", "", PS_COLUMN, 0, "--rank", "1 and how many samplers are told apart as having less"},
    {"factor", "", PS_COLUMN, 0, "--rank", "variance over that of the first one, ranking_first"},
    {"factor_error", "", PS_COLUMN, 0, "--rank", "its standard error"},
    {"factor_by", "", PS_COLUMN, 0, "--rank", "what was compared: predicted, pairs or measured"},
    {"factor_score", "", PS_COLUMN, 0, "--rank",
     "logarithm of the factor over its standard error; 0 where lower and upper overlap"},
    {"factor_p_value", "", PS_COLUMN, 0, "--rank",
     "smallest rate of false alarms at which the two are told apart"},
    {"white_score", "", PS_COLUMN, 0, "--rank", "factor_score of white noise over this sampler"},
    {"white_p_value", "", PS_COLUMN, 0, "--rank",
     "factor_p_value of white noise over this sampler"},
    {"paper", "", PS_COLUMN, 0, "--paper-formula", "the variance by (E-13) of P15"},
    {.name = NULL}};

static const ps_field_row sentence_fields[] = {
    {"rates", "", PS_ENTRIES, 0, "--rates", "how fast the variance falls, a sentence"},
    {"rate_sampler", "", PS_ENTRIES, 0, "--rates", "the sampler that it is of"},
    {"rate_integrand", "", PS_ENTRIES, 0, "--rates", "the integrand that it is of"},
    {"rate", "", PS_ENTRIES, 0, "--rates", "r of Var ~ N^-r by the column predicted"},
    {"rate_error", "", PS_ENTRIES, 0, "--rates", "its standard error"},
    {"rate_from", "", PS_ENTRIES, 0, "--rates", "the smallest N of it"},
    {"rate_to", "", PS_ENTRIES, 0, "--rates", "the largest N of it"},
    {"rate_change", "", PS_ENTRIES, 0, "--rates", "by how much r grows whenever N doubles"},
    {"rate_change_error", "", PS_ENTRIES, 0, "--rates", "its standard error"},
    {"rate_white_score", "", PS_ENTRIES, 0, "--rates",
     "how many standard errors r is from 1, that of white noise"},
    {"measured_rate", "", PS_ENTRIES, 0, "--rates", "r by the column measured"},
    {"measured_rate_error", "", PS_ENTRIES, 0, "--rates", "its standard error"},
    {"crossing", "", PS_ENTRIES, 0, "--rates",
     "from which N on one of two samplers has less variance, a sentence"},
    {"crossing_first", "", PS_ENTRIES, 0, "--rates", "one of the two"},
    {"crossing_second", "", PS_ENTRIES, 0, "--rates", "the other"},
    {"crossing_integrand", "", PS_ENTRIES, 0, "--rates", "the integrand"},
    {"crossing_points", "", PS_ENTRIES, 0, "--rates", "that N; missing where there is none"},
    {"crossing_points_error", "", PS_ENTRIES, 0, "--rates", "its standard error"},
    {"ranking", "", PS_ENTRIES, 0, "--rank", "which sampler has the least variance, a sentence"},
    {"ranking_integrand", "", PS_ENTRIES, 0, "--rank", "the integrand"},
    {"ranking_points", "", PS_ENTRIES, 0, "--rank", "the N"},
    {"ranking_first", "", PS_ENTRIES, 0, "--rank", "the sampler with the least variance"},
    {.name = NULL}};

static const ps_field_row *const fields[] = {
    ps_fields_asked,     ps_fields_points,   own_fields,
    ps_fields_profiles,  sentence_fields,    ps_fields_ranges,
    ps_fields_kept_rows, ps_fields_computed, NULL};

static const ps_compared_field compared[] = {
    {"predicted", "predicted_error", false, ps_compared_variance_bound},
    {"measured", "measured_error", false, ps_compared_variance_bound},
    {.value = NULL}};

const ps_kind ps_kind_variance = {
    .name = "variance",
    .purpose = "variance of Monte Carlo integration, predicted from spectra and measured",
    .usage = "variance --integrand NAME [options] --sampler NAME | variance --integrand NAME "
             "[options] FILE...",
    .description =
        "The variance of the mean of an integrand over N points of a sampler, predicted from the "
        "spectra of M realizations as (1/N) sum P(k) |f_k|^2 over all k but 0 (on the sphere (4 "
        "pi/N) sum (2l+1) P(l) P_F(l)), and measured beside it by M other realizations, each "
        "shifted or rotated at random --shifts times. Of files the first half of the sets "
        "predicts, "
        "and the second is measured; a single set is both, and has the sum over its pairs in the "
        "header. What lies beyond the cut-off is taken for "
        "white; lower and upper have nothing there, and the most power that there can be. z_score "
        "is measured minus predicted over both standard errors; white is the variance of as many "
        "independent points.",
    .examples = {"pointspec variance --sampler jittered --integrand disk:radius=0.25 -n 16..1024 "
                 "-m 100",
                 "pointspec variance --sampler healpix-jittered --integrand cap -n 48,192,768 -m "
                 "50"},
    .takes = PS_COMMAND_BIT(variance),
    .samples = PS_DOMAIN_ANY,
    .counted = "realizations",
    .check_question = check_question,
    .plan = plan,
    .count_jobs = count_jobs,
    .look_at_shares = ps_answer_look_at_rows,
    .merge = ps_row_ranges_merge,
    .compute = compute,
    .tabulate = tabulate,
    .discard = discard,
    .fields = fields,
    .summary = summary,
    .pictures = pictures,
    .sentences = sentences,
    .has_few_rows = true,
    .compared = compared,
};
