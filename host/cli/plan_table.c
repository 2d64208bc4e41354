/* What a plan says of one question. */
#include "cli/plan_table.h"

#include "cli/answer.h"
#include "scene/check_question.h"
#include "scene/quadrature_question.h"
#include "scene/question.h"

#include <stdio.h>

static const char *const columns[] = {"job",   "engine", "verdict", "seconds",
                                      "bytes", "error",  "reason"};
enum { NUM_COLUMNS = sizeof columns / sizeof columns[0] };

pspec_status ps_plan_table_create(ps_table **out, bool has_jobs, ps_error *error) {
    const size_t first = has_jobs ? 0 : 1;
    return ps_table_create(out, "plan", columns + first, NUM_COLUMNS - first, error);
}

static const char *verdict_of(const ps_candidate *candidate) {
    if (candidate->is_chosen) {
        return "chosen";
    }
    if (!candidate->is_applicable) {
        return "not applicable";
    }
    return candidate->is_feasible ? "slower" : candidate->is_excluded ? "excluded" : "infeasible";
}

static pspec_status add_candidates(const ps_planner *to, const ps_plan *plan, ps_error *error) {
    for (size_t i = 0; i < plan->num_candidates; i++) {
        const ps_candidate *candidate = &plan->candidates[i];
        char name[64];
        snprintf(name, sizeof name, "%s:%s", candidate->engine->name,
                 ps_precision_name(candidate->precision));
        const bool has_numbers = candidate->is_applicable;
        const ps_cell cells[NUM_COLUMNS] = {
            PS_TEXT(to->job),
            PS_TEXT(name),
            PS_TEXT(verdict_of(candidate)),
            has_numbers ? PS_NUMBER(candidate->seconds) : PS_MISSING,
            has_numbers ? PS_INTEGER(candidate->bytes) : PS_MISSING,
            has_numbers ? PS_NUMBER(candidate->error) : PS_MISSING,
            PS_TEXT(candidate->reason),
        };
        PS_TRY(ps_table_add_row(to->table, to->job != NULL ? cells : cells + 1, error));
    }
    return PSPEC_OK;
}

/* A header line; of several jobs a row, too: JSON does not keep which header line is of which job. */
static pspec_status add_skip(const ps_planner *to, const ps_skip *skip, ps_error *error) {
    char text[sizeof(ps_skip) + 32]; /* with a number and separators */
    snprintf(text, sizeof text, "%s; %s; %.3g", skip->what, skip->why, skip->share);
    const ps_cell cells[NUM_COLUMNS] = {PS_TEXT(to->job), PS_MISSING, PS_TEXT("skip"), PS_MISSING,
                                        PS_MISSING,       PS_MISSING, PS_TEXT(text)};
    PS_TRY(ps_table_add_meta(to->table, "skip", PS_TEXT(text), error));
    return to->job != NULL ? ps_table_add_row(to->table, cells, error) : PSPEC_OK;
}

/* What is asked of a job: number `index` of its command. */
static pspec_status add_header(const ps_planner *to, const ps_request *arguments,
                               const ps_problem *problem, const ps_needs *needs,
                               const ps_device_limits *limits, size_t index, ps_error *error) {
    ps_table *const table = to->table;
    if (arguments->num_samplers > 0) {
        PS_TRY(ps_table_add_meta(table, "sampler", PS_TEXT(arguments->samplers[index]), error));
    }
    PS_TRY(
        ps_table_add_meta(table, "device", PS_TEXT(limits != NULL ? limits->name : "host"), error));
    PS_TRY(ps_table_add_meta(table, "figures",
                             PS_TEXT(limits != NULL && limits->figures != NULL
                                         ? limits->figures->note
                                         : "built-in: no device"),
                             error));
    PS_TRY(ps_table_add_meta(table, "points", PS_INTEGER(problem->num_points), error));
    PS_TRY(ps_table_add_meta(table, "realizations",
                             problem->num_realizations > 0 ? PS_INTEGER(problem->num_realizations)
                                                           : PS_TEXT("as many as there are"),
                             error));
    const bool on_sphere = problem->frequencies->kind == PS_FREQUENCIES_DEGREES;
    PS_TRY(ps_table_add_meta(table, on_sphere ? "max_degree" : "max_frequency",
                             PS_INTEGER(problem->frequencies->max_frequency), error));
    PS_TRY(ps_table_add_meta(table, on_sphere ? "degrees" : "frequencies",
                             PS_INTEGER(problem->frequencies->num), error));
    PS_TRY(ps_table_add_meta(table, "tolerance", PS_NUMBER(problem->tolerance), error));
    for (size_t i = 0; i < needs->num_skips; i++) {
        PS_TRY(add_skip(to, &needs->skips[i], error));
    }
    return PSPEC_OK;
}

static pspec_status add_list(const ps_planner *to, const ps_request *arguments,
                             ps_question_list *list, ps_error *error) {
    for (size_t i = 0; i < list->num; i++) {
        ps_power_job *job = NULL;
        list->questions[i].open_device = to->device;
        PS_TRY(ps_power_job_create(&job, &list->questions[i], error));
        ps_power_job_rate_skips(job);
        pspec_status status =
            add_header(to, arguments, ps_power_job_problem(job), ps_power_job_needs(job),
                       ps_power_job_limits(job), i, error);
        if (status == PSPEC_OK) {
            status = add_candidates(to, ps_power_job_plan(job), error);
        }
        ps_power_job_destroy(job);
        PS_TRY(status);
    }
    return PSPEC_OK;
}

static pspec_status add_jobs(const ps_planner *to, const ps_request *arguments,
                             ps_question_kind kind, ps_error *error) {
    ps_question_list list;
    PS_TRY(ps_questions_make(&list, arguments, kind, error));
    return add_list(to, arguments, &list, error);
}

static pspec_status add_check(const ps_planner *to, const ps_request *arguments, ps_error *error) {
    ps_saved_spectrum saved;
    ps_question_list list;
    PS_TRY(ps_check_check(arguments, error));
    PS_TRY(ps_saved_spectrum_read(&saved, arguments->against, error));
    const ps_request own = ps_check_request(arguments, &saved);
    pspec_status status = ps_check_question_make(&list, &own, &saved, error);
    if (status == PSPEC_OK) {
        status = add_list(to, &own, &list, error);
    }
    ps_saved_spectrum_free(&saved);
    return status;
}

static pspec_status add_setup(const ps_planner *to, const ps_request *arguments,
                              const ps_quadrature_setup *setup, size_t index, ps_error *error) {
    const ps_device_limits *const limits =
        setup->device != NULL ? ps_device_get_limits(setup->device) : NULL;
    PS_TRY(add_header(to, arguments, &setup->problem, &setup->needs, limits, index, error));
    if (setup->degrees_note[0] != '\0') {
        PS_TRY(ps_table_add_meta(to->table, "degrees_note", PS_TEXT(setup->degrees_note), error));
    }
    if (setup->weights_note[0] != '\0') {
        PS_TRY(ps_table_add_meta(to->table, "weights", PS_TEXT(setup->weights_note), error));
    }
    return add_candidates(to, &setup->plan, error);
}

static pspec_status add_quadrature(const ps_planner *to, const ps_request *arguments,
                                   ps_error *error) {
    ps_quadrature_list list;
    pspec_status status = ps_quadrature_list_make(&list, arguments, error);
    for (size_t i = 0; status == PSPEC_OK && i < list.num; i++) {
        ps_quadrature_setup setup;
        list.questions[i].open_device = to->device;
        status = ps_quadrature_setup_ask(&setup, &list.questions[i], error);
        if (status == PSPEC_OK) {
            status = add_setup(to, arguments, &setup, i, error);
        }
        ps_quadrature_setup_free(&setup);
    }
    ps_quadrature_list_free(&list);
    return status;
}

/* Products in harmonics are the host's: there is nothing to choose. */
static pspec_status add_truncation(const ps_planner *to, const ps_request *request,
                                   ps_error *error) {
    const ps_cell cells[NUM_COLUMNS] = {PS_TEXT(to->job),
                                        PS_TEXT("host"),
                                        PS_TEXT("chosen"),
                                        PS_MISSING,
                                        PS_MISSING,
                                        PS_MISSING,
                                        PS_TEXT("series of the lobe, in double precision")};
    PS_TRY(ps_truncation_check(request, error));
    PS_TRY(ps_table_add_meta(to->table, "device", PS_TEXT("none"), error));
    return ps_table_add_row(to->table, to->job != NULL ? cells : cells + 1, error);
}

pspec_status ps_plan_table_add(const ps_planner *to, const ps_result_kind *kind,
                               const ps_request *request, ps_error *error) {
    if (kind == &ps_result_quadrature) {
        return add_quadrature(to, request, error);
    }
    if (kind == &ps_result_check) {
        return add_check(to, request, error);
    }
    if (kind == &ps_result_truncation) {
        return add_truncation(to, request, error);
    }
    return add_jobs(to, request,
                    kind == &ps_result_power     ? PS_QUESTION_POWER
                    : kind == &ps_result_angular ? PS_QUESTION_ANGULAR
                                                 : PS_QUESTION_PAIRS,
                    error);
}

pspec_status ps_plan_table_add_cached(const ps_planner *to, ps_error *error) {
    const ps_cell cells[NUM_COLUMNS] = {PS_TEXT(to->job),
                                        PS_TEXT("cache"),
                                        PS_TEXT("chosen"),
                                        PS_NUMBER(0),
                                        PS_INTEGER(0),
                                        PS_MISSING,
                                        PS_TEXT("the answer is in the cache of results")};
    PS_TRY(ps_table_add_meta(to->table, "skip",
                             PS_TEXT("the whole question; its answer is in the cache; 1"), error));
    return ps_table_add_row(to->table, to->job != NULL ? cells : cells + 1, error);
}
