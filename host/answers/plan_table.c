/* What a plan says of one question. */
#include "answers/plan_table.h"

#include <stdio.h>
#include <stdlib.h>

static const char *const columns[] = {"engine", "verdict", "seconds", "bytes", "error", "reason"};
enum { NUM_COLUMNS = sizeof columns / sizeof columns[0] };

pspec_status ps_plan_table_create(ps_table **out, const ps_lead *lead, ps_error *error) {
    return ps_lead_create_table(out, "plan", lead, columns, NUM_COLUMNS, error);
}

ps_lead ps_plan_table_lead(const char *job) {
    return (ps_lead){.num = 1, .names = {"job"}, .cells = {PS_TEXT(job)}};
}

static pspec_status add_row(const ps_planner *planner, const ps_cell *cells, ps_error *error) {
    return ps_lead_add_row(planner->table, &planner->lead, cells, NUM_COLUMNS, error);
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

/* Of an engine that could do it: how long all of it takes beside the chosen one, as the seconds of
 * both rows say, which other phases may be the most of; then its own part. */
static void say_reason(char *out, size_t bytes, const ps_candidate *candidate, double ratio) {
    const double notable = 1.005; /* three digits show it */
    if (!candidate->is_feasible || candidate->is_chosen) {
        snprintf(out, bytes, "%s", candidate->reason);
    } else if (ratio < notable && ratio * notable > 1) {
        snprintf(out, bytes, "as long in all; powers alone %s", candidate->reason);
    } else {
        snprintf(out, bytes, "%.3g times %s in all; powers alone %s", ratio > 1 ? ratio : 1 / ratio,
                 ratio > 1 ? "slower" : "faster", candidate->reason);
    }
}

/* Each with its own seconds, `repeats` times, and those of all other phases. */
static pspec_status add_candidates(const ps_planner *planner, const ps_plan *plan,
                                   const ps_phases *phases, double repeats, ps_error *error) {
    const double all = ps_phases_seconds(phases);
    const double own = plan->chosen != NULL ? plan->chosen->seconds * repeats : 0;
    for (size_t i = 0; i < plan->num_candidates; i++) {
        const ps_candidate *candidate = &plan->candidates[i];
        const double seconds = candidate->seconds * repeats + all - own;
        char name[64];
        char reason[sizeof candidate->reason + 64];
        snprintf(name, sizeof name, "%s:%s", candidate->engine->name,
                 ps_precision_name(candidate->precision));
        say_reason(reason, sizeof reason, candidate, seconds / all);
        const bool has_numbers = candidate->is_applicable;
        const ps_cell cells[NUM_COLUMNS] = {
            PS_TEXT(name),
            PS_TEXT(verdict_of(candidate)),
            has_numbers ? PS_NUMBER(seconds) : PS_MISSING,
            has_numbers ? PS_INTEGER(candidate->bytes) : PS_MISSING,
            has_numbers ? PS_NUMBER(candidate->error) : PS_MISSING,
            PS_TEXT(reason),
        };
        PS_TRY(add_row(planner, cells, error));
    }
    return PSPEC_OK;
}

/* A header line; of several jobs a row, too: JSON does not keep which header line is of which job.
 */
static pspec_status add_skip(const ps_planner *planner, const ps_skip *skip, ps_error *error) {
    char text[sizeof(ps_skip) + 32]; /* with a number and separators */
    snprintf(text, sizeof text, "%s; %s; %.3g", skip->what, skip->why, skip->share);
    const ps_cell cells[NUM_COLUMNS] = {PS_MISSING, PS_TEXT("skip"), PS_MISSING,
                                        PS_MISSING, PS_MISSING,      PS_TEXT(text)};
    PS_TRY(ps_table_add_meta(planner->table, "skip", PS_TEXT(text), error));
    return planner->lead.num > 0 ? add_row(planner, cells, error) : PSPEC_OK;
}

/* ---- phases -------------------------------------------------------------------------------- */

static pspec_status add_phase(const ps_planner *planner, const ps_phase_cost *phase,
                              ps_error *error) {
    char text[sizeof(ps_phase_cost) + 64]; /* with a number and separators */
    const char *const most = phase->is_at_most ? "at most " : "";
    snprintf(text, sizeof text, "%s; %s%.3g s; %s", phase->name, most, phase->seconds, phase->what);
    PS_TRY(ps_table_add_meta(planner->table, "phase", PS_TEXT(text), error));
    snprintf(text, sizeof text, "%s%s; %s", most, phase->name, phase->what);
    const ps_cell cells[NUM_COLUMNS] = {PS_MISSING, PS_TEXT("phase"), PS_NUMBER(phase->seconds),
                                        PS_MISSING, PS_MISSING,       PS_TEXT(text)};
    return planner->lead.num > 0 ? add_row(planner, cells, error) : PSPEC_OK;
}

pspec_status ps_plan_table_add_phases(ps_planner *planner, const ps_phases *phases,
                                      ps_error *error) {
    for (size_t i = 0; i < phases->num; i++) {
        PS_TRY(add_phase(planner, &phases->list[i], error));
    }
    planner->seconds += ps_phases_seconds(phases);
    planner->is_at_most = planner->is_at_most || ps_phases_are_at_most(phases);
    return PSPEC_OK;
}

pspec_status ps_plan_table_end(const ps_planner *planner, ps_error *error) {
    char text[64];
    snprintf(text, sizeof text, "%s%.3g", planner->is_at_most ? "at most " : "", planner->seconds);
    return ps_table_set_meta(planner->table, "seconds", PS_TEXT(text), error);
}

pspec_status ps_plan_table_add_only(ps_planner *planner, const ps_phases *phases,
                                    const ps_only_way *way, ps_error *error) {
    const ps_device_limits *const limits = ps_device_get_limits(way->device);
    const double bytes = way->bytes;
    const ps_cell cells[NUM_COLUMNS] = {PS_TEXT(limits != NULL ? way->engine : "host"),
                                        PS_TEXT("chosen"),
                                        PS_NUMBER(ps_phases_seconds(phases)),
                                        bytes > 0 ? PS_INTEGER(bytes) : PS_MISSING,
                                        PS_MISSING,
                                        PS_TEXT(way->reason)};
    PS_TRY(ps_table_add_meta(planner->table, "device",
                             PS_TEXT(limits != NULL ? limits->name : "none"), error));
    PS_TRY(ps_plan_table_add_phases(planner, phases, error));
    return add_row(planner, cells, error);
}

pspec_status ps_plan_table_add_host(ps_planner *planner, const ps_phases *phases, double bytes,
                                    const char *reason, ps_error *error) {
    const ps_only_way way = {.bytes = bytes, .reason = reason};
    return ps_plan_table_add_only(planner, phases, &way, error);
}

/* ---- jobs ---------------------------------------------------------------------------------- */

/* What is asked of a job: number `index` of its command. */
static pspec_status add_header(const ps_planner *planner, const ps_request *arguments,
                               const ps_planned *job, size_t index, ps_error *error) {
    ps_table *const table = planner->table;
    const ps_problem *const problem = job->problem;
    const ps_device_limits *const limits = job->limits;
    PS_TRY(ps_lead_add_source(table, arguments, index, error));
    PS_TRY(
        ps_table_add_meta(table, "device", PS_TEXT(limits != NULL ? limits->name : "host"), error));
    PS_TRY(ps_table_add_meta(table, "figures",
                             PS_TEXT(limits != NULL && limits->figures != NULL
                                         ? limits->figures->note
                                         : "built-in: no device"),
                             error));
    PS_TRY(ps_table_add_meta(table, "points", PS_INTEGER(problem->planned_points), error));
    PS_TRY(ps_table_add_meta(table, "realizations",
                             problem->num_realizations > 0 ? PS_INTEGER(problem->num_realizations)
                                                           : PS_TEXT("as many as there are"),
                             error));
    const bool on_sphere = problem->frequencies->kind == PS_FREQUENCIES_DEGREES;
    PS_TRY(ps_table_add_meta(table, on_sphere ? "max_degree" : "max_frequency",
                             PS_INTEGER(ps_frequencies_reach(problem->frequencies)), error));
    PS_TRY(ps_table_add_meta(table, on_sphere ? "degrees" : "frequencies",
                             PS_INTEGER(problem->frequencies->num), error));
    PS_TRY(ps_table_add_meta(table, "tolerance", PS_NUMBER(problem->tolerance), error));
    for (size_t i = 0; i < job->needs->num_skips; i++) {
        PS_TRY(add_skip(planner, &job->needs->skips[i], error));
    }
    return ps_table_add_metas(table, job->notes, job->num_notes, error);
}

ps_phases ps_plan_table_begin_phases(ps_planner *planner) {
    return (ps_phases){.host = planner->host, .begun = &planner->begun};
}

void ps_plan_table_add_picture(ps_phases *phases, const ps_request *arguments) {
    ps_phases_draw(phases, "picture", arguments->plot != NULL ? 1 : 0);
    ps_phases_say(phases, "picture", "by gnuplot");
}

pspec_status ps_plan_table_add_job(ps_planner *planner, const ps_request *arguments,
                                   const ps_planned *job, size_t index, ps_error *error) {
    PS_TRY(add_header(planner, arguments, job, index, error));
    PS_TRY(ps_plan_table_add_phases(planner, job->phases, error));
    return add_candidates(planner, job->plan, job->phases, job->repeats, error);
}

pspec_status ps_plan_table_begin_question(ps_planner *planner, const ps_request *request,
                                          size_t index, const ps_plan_constraints *constraints,
                                          ps_device **open_device, bool *lacks_device,
                                          ps_error *error) {
    ps_device_limits *limits = NULL;
    size_t num = 0;
    ps_error reason = {0};
    if (ps_request_num_questions(request) > 1) {
        planner->lead = ps_lead_make(request, index);
    }
    *open_device = planner->device;
    *lacks_device = planner->device == NULL && ps_plan_may_need_device(constraints) &&
                    ps_device_list(&limits, &num, &reason) == PSPEC_ERROR_NO_DEVICE;
    free(limits);
    return *lacks_device
               ? ps_table_add_meta(planner->table, "no_device", PS_TEXT(reason.message), error)
               : PSPEC_OK;
}

pspec_status ps_plan_table_add_cached(ps_planner *planner, ps_error *error) {
    const ps_cell cells[NUM_COLUMNS] = {
        PS_TEXT("cache"), PS_TEXT("chosen"), PS_NUMBER(0),
        PS_INTEGER(0),    PS_MISSING,        PS_TEXT("the answer is in the cache of results")};
    PS_TRY(ps_table_add_meta(planner->table, "skip",
                             PS_TEXT("the whole question; its answer is in the cache; 1"), error));
    return add_row(planner, cells, error);
}
