/* What a plan says of one question. */
#include "cli/plan_table.h"

#include "cli/answer.h"
#include "jobs/parts/point_phases.h"
#include "jobs/spectrum/power_phases.h"
#include "jobs/quadrature/quadrature_phases.h"
#include "questions/check_question.h"
#include "questions/quadrature_question.h"
#include "questions/question.h"

#include <stdio.h>
#include <stdlib.h>

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

/* Each with its own seconds, `repeats` times, and those of all other phases. */
static pspec_status add_candidates(const ps_planner *to, const ps_plan *plan,
                                   const ps_phases *phases, double repeats, ps_error *error) {
    const double own = plan->chosen != NULL ? plan->chosen->seconds * repeats : 0;
    const double others = ps_phases_seconds(phases) - own;
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
            has_numbers ? PS_NUMBER(candidate->seconds * repeats + others) : PS_MISSING,
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

/* ---- phases -------------------------------------------------------------------------------- */

static pspec_status add_phase(const ps_planner *to, const ps_phase_cost *phase, ps_error *error) {
    char text[sizeof(ps_phase_cost) + 64]; /* with a number and separators */
    const char *const most = phase->is_at_most ? "at most " : "";
    snprintf(text, sizeof text, "%s; %s%.3g s; %s", phase->name, most, phase->seconds, phase->what);
    PS_TRY(ps_table_add_meta(to->table, "phase", PS_TEXT(text), error));
    snprintf(text, sizeof text, "%s%s; %s", most, phase->name, phase->what);
    const ps_cell cells[NUM_COLUMNS] = {
        PS_TEXT(to->job), PS_MISSING, PS_TEXT("phase"), PS_NUMBER(phase->seconds),
        PS_MISSING,       PS_MISSING, PS_TEXT(text)};
    return to->job != NULL ? ps_table_add_row(to->table, cells, error) : PSPEC_OK;
}

pspec_status ps_plan_table_add_phases(ps_planner *to, const ps_phases *phases, ps_error *error) {
    for (size_t i = 0; i < phases->num; i++) {
        PS_TRY(add_phase(to, &phases->list[i], error));
    }
    to->seconds += ps_phases_seconds(phases);
    to->is_at_most = to->is_at_most || ps_phases_are_at_most(phases);
    return PSPEC_OK;
}

pspec_status ps_plan_table_end(const ps_planner *to, ps_error *error) {
    char text[64];
    snprintf(text, sizeof text, "%s%.3g", to->is_at_most ? "at most " : "", to->seconds);
    return ps_table_add_meta(to->table, "seconds", PS_TEXT(text), error);
}

static pspec_status add_host(ps_planner *to, const ps_phases *phases, const char *reason,
                             ps_error *error) {
    const ps_cell cells[NUM_COLUMNS] = {
        PS_TEXT(to->job), PS_TEXT("host"), PS_TEXT("chosen"), PS_NUMBER(ps_phases_seconds(phases)),
        PS_MISSING,       PS_MISSING,      PS_TEXT(reason)};
    PS_TRY(ps_table_add_meta(to->table, "device", PS_TEXT("none"), error));
    PS_TRY(ps_plan_table_add_phases(to, phases, error));
    return ps_table_add_row(to->table, to->job != NULL ? cells : cells + 1, error);
}

/* ---- jobs ---------------------------------------------------------------------------------- */

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

static ps_phases begin_phases(ps_planner *to) {
    return (ps_phases){.host = to->host, .begun = &to->begun};
}

/* A picture needs gnuplot, which takes its time whatever is in it. */
static void add_picture(ps_phases *phases, const ps_request *arguments) {
    ps_phases_add(phases, "picture", PS_HOST_PICTURE, arguments->plot != NULL ? 1 : 0);
    ps_phases_say(phases, "picture", "by gnuplot");
}

static pspec_status add_power(ps_planner *to, const ps_request *arguments, const ps_power_job *job,
                              size_t index, ps_error *error) {
    ps_phases phases = begin_phases(to);
    const double repeats = ps_power_job_phases(job, &phases);
    add_picture(&phases, arguments);
    PS_TRY(add_header(to, arguments, ps_power_job_problem(job), ps_power_job_needs(job),
                      ps_power_job_limits(job), index, error));
    PS_TRY(ps_plan_table_add_phases(to, &phases, error));
    return add_candidates(to, ps_power_job_plan(job), &phases, repeats, error);
}

/* Without any device the host's engines are planned, and the header says why there is none. A device that was named and
 * is not there is an error, as for the command itself. */
static pspec_status find_lack(const ps_planner *to, const ps_plan_constraints *constraints,
                              bool *lacks_device, ps_error *error) {
    ps_device_limits *limits = NULL;
    size_t num = 0;
    ps_error reason = {0};
    *lacks_device = to->device == NULL && ps_plan_may_need_device(constraints) &&
                    ps_device_list(&limits, &num, &reason) == PSPEC_ERROR_NO_DEVICE;
    free(limits);
    return *lacks_device ? ps_table_add_meta(to->table, "no_device", PS_TEXT(reason.message), error)
                         : PSPEC_OK;
}

static pspec_status add_list(ps_planner *to, const ps_request *arguments, ps_question_list *list,
                             ps_error *error) {
    for (size_t i = 0; i < list->num; i++) {
        ps_power_job *job = NULL;
        list->questions[i].open_device = to->device;
        PS_TRY(find_lack(to, &list->questions[i].constraints, &list->questions[i].may_lack_device,
                         error));
        PS_TRY(ps_power_job_create(&job, &list->questions[i], error));
        ps_power_job_rate_skips(job);
        const pspec_status status = add_power(to, arguments, job, i, error);
        ps_power_job_destroy(job);
        PS_TRY(status);
    }
    return PSPEC_OK;
}

static pspec_status add_jobs(ps_planner *to, const ps_request *arguments, ps_question_kind kind,
                             ps_error *error) {
    ps_question_list list;
    PS_TRY(ps_questions_make(&list, arguments, kind, error));
    return add_list(to, arguments, &list, error);
}

static pspec_status add_check(ps_planner *to, const ps_request *arguments, ps_error *error) {
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

static pspec_status add_setup(ps_planner *to, const ps_request *arguments,
                              const ps_quadrature_question *question,
                              const ps_quadrature_setup *setup, size_t index, ps_error *error) {
    ps_phases phases = begin_phases(to);
    const double repeats = ps_quadrature_phases(setup, question, &phases);
    add_picture(&phases, arguments);
    const ps_device_limits *const limits =
        setup->device != NULL ? ps_device_get_limits(setup->device) : NULL;
    PS_TRY(add_header(to, arguments, &setup->problem, &setup->needs, limits, index, error));
    if (setup->degrees_note[0] != '\0') {
        PS_TRY(ps_table_add_meta(to->table, "degrees_note", PS_TEXT(setup->degrees_note), error));
    }
    if (setup->weights_note[0] != '\0') {
        PS_TRY(ps_table_add_meta(to->table, "weights", PS_TEXT(setup->weights_note), error));
    }
    PS_TRY(ps_plan_table_add_phases(to, &phases, error));
    return add_candidates(to, &setup->plan, &phases, repeats, error);
}

static pspec_status add_quadrature(ps_planner *to, const ps_request *arguments, ps_error *error) {
    ps_quadrature_list list;
    pspec_status status = ps_quadrature_list_make(&list, arguments, error);
    for (size_t i = 0; status == PSPEC_OK && i < list.num; i++) {
        ps_quadrature_setup setup;
        list.questions[i].open_device = to->device;
        setup = (ps_quadrature_setup){0};
        status = find_lack(to, &list.questions[i].constraints, &list.questions[i].may_lack_device,
                           error);
        if (status == PSPEC_OK) {
            status = ps_quadrature_setup_ask(&setup, &list.questions[i], error);
        }
        if (status == PSPEC_OK) {
            status = add_setup(to, arguments, &list.questions[i], &setup, i, error);
        }
        ps_quadrature_setup_free(&setup);
    }
    ps_quadrature_list_free(&list);
    return status;
}

/* Products in harmonics are the host's: there is nothing to choose. */
static pspec_status add_truncation(ps_planner *to, const ps_request *request, ps_error *error) {
    ps_phases phases = begin_phases(to);
    PS_TRY(ps_truncation_phases(request, &phases, error));
    add_picture(&phases, request);
    return add_host(to, &phases, "series of the lobe, in double precision", error);
}

pspec_status ps_plan_table_add(ps_planner *to, const ps_result_kind *kind,
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

pspec_status ps_plan_table_add_cached(ps_planner *to, ps_error *error) {
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

/* ---- points -------------------------------------------------------------------------------- */

pspec_status ps_plan_table_add_sample(ps_planner *to, const ps_request *request, ps_error *error) {
    ps_sampler_request sampler;
    ps_phases phases = begin_phases(to);
    if (request->num_samplers != 1) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "one --sampler NAME is needed");
    }
    PS_TRY(ps_sampler_request_make(&sampler, request, 0, error));
    const double sets = (double)request->num_realizations;
    ps_phases_start(&phases, NULL);
    ps_phases_sample(&phases, &sampler, sets);
    ps_phases_touch(&phases, (double)sampler.num_points * sampler.dimension * sizeof(double));
    ps_phases_write(&phases, request->output != NULL ? request->output : "-", request->format,
                    sets * (double)sampler.num_points * sampler.dimension);
    return add_host(to, &phases, "points of one sampler, one realization at a time", error);
}

pspec_status ps_plan_table_add_convert(ps_planner *to, const ps_request *request, ps_error *error) {
    ps_phases phases = begin_phases(to);
    ps_point_set set = {0};
    ps_point_reader *reader = NULL;
    const ps_point_options options = ps_point_options_make(request);
    bool has_block = false;
    bool ends_set = false;
    if (request->num_files == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "nothing to convert: name point files (- for standard input)");
    }
    pspec_status status = ps_points_open(&reader, request->files[0], &options, error);
    if (status == PSPEC_OK) { /* one point tells how many numbers each has */
        status = ps_points_next_block(reader, &set, 1, &has_block, &ends_set, error);
    }
    if (status == PSPEC_OK) {
        const unsigned numbers = set.dimension + (set.has_weights ? 1 : 0);
        ps_phases_start(&phases, NULL);
        const double points = ps_phases_read(&phases, request->files, request->num_files,
                                             request->input_format, numbers);
        ps_phases_write(&phases, request->output != NULL ? request->output : "-", request->format,
                        points * numbers);
        status = add_host(to, &phases, "a block of points at a time", error);
    }
    ps_points_close(reader);
    ps_point_set_free(&set);
    return status;
}
