/* pointspec plan: what another command would do, by what, what it skips and why. */
#include "cli/answer.h"
#include "cli/command.h"
#include "scene/check_question.h"
#include "scene/options.h"
#include "scene/quadrature_question.h"
#include "scene/question.h"
#include "io/table.h"

#include "pointspec_version.h"

#include <stdio.h>
#include <string.h>

static const char *verdict_of(const ps_candidate *candidate) {
    if (candidate->is_chosen) {
        return "chosen";
    }
    if (!candidate->is_applicable) {
        return "not applicable";
    }
    return candidate->is_feasible ? "slower" : candidate->is_excluded ? "excluded" : "infeasible";
}

static pspec_status add_candidates(ps_table *table, const ps_plan *plan, ps_error *error) {
    for (size_t i = 0; i < plan->num_candidates; i++) {
        const ps_candidate *candidate = &plan->candidates[i];
        char name[64];
        snprintf(name, sizeof name, "%s:%s", candidate->engine->name,
                 ps_precision_name(candidate->precision));
        const bool has_numbers = candidate->is_applicable;
        const ps_cell cells[] = {
            PS_TEXT(name),
            PS_TEXT(verdict_of(candidate)),
            has_numbers ? PS_NUMBER(candidate->seconds) : PS_MISSING,
            has_numbers ? PS_INTEGER(candidate->bytes) : PS_MISSING,
            has_numbers ? PS_NUMBER(candidate->error) : PS_MISSING,
            PS_TEXT(candidate->reason),
        };
        PS_TRY(ps_table_add_row(table, cells, error));
    }
    return PSPEC_OK;
}

/* What is asked of a job: number `index` of its command. */
static pspec_status add_header(ps_table *table, const ps_request *arguments,
                               const ps_problem *problem, const ps_needs *needs,
                               const ps_device_limits *limits, size_t index, ps_error *error) {
    if (arguments->num_samplers > 0) {
        PS_TRY(ps_table_add_meta(table, "sampler", PS_TEXT(arguments->samplers[index]), error));
    }
    PS_TRY(
        ps_table_add_meta(table, "device", PS_TEXT(limits != NULL ? limits->name : "host"), error));
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
        char text[sizeof(ps_skip) + 32]; /* with a number and separators */
        snprintf(text, sizeof text, "%s; %s; %.3g", needs->skips[i].what, needs->skips[i].why,
                 needs->skips[i].share);
        PS_TRY(ps_table_add_meta(table, "skip", PS_TEXT(text), error));
    }
    return PSPEC_OK;
}

static pspec_status add_list(ps_table *table, const ps_request *arguments,
                             const ps_question_list *list, ps_error *error) {
    for (size_t i = 0; i < list->num; i++) {
        ps_power_job *job = NULL;
        PS_TRY(ps_power_job_create(&job, &list->questions[i], error));
        ps_power_job_rate_skips(job);
        pspec_status status =
            add_header(table, arguments, ps_power_job_problem(job), ps_power_job_needs(job),
                       ps_power_job_limits(job), i, error);
        if (status == PSPEC_OK) {
            status = add_candidates(table, ps_power_job_plan(job), error);
        }
        ps_power_job_destroy(job);
        PS_TRY(status);
    }
    return PSPEC_OK;
}

static pspec_status add_jobs(ps_table *table, const ps_request *arguments, ps_question_kind kind,
                             ps_error *error) {
    ps_question_list list;
    PS_TRY(ps_questions_make(&list, arguments, kind, error));
    return add_list(table, arguments, &list, error);
}

static pspec_status add_check(ps_table *table, const ps_request *arguments, ps_error *error) {
    ps_saved_spectrum saved;
    ps_question_list list;
    PS_TRY(ps_check_check(arguments, error));
    PS_TRY(ps_saved_spectrum_read(&saved, arguments->against, error));
    const ps_request own = ps_check_request(arguments, &saved);
    pspec_status status = ps_check_question_make(&list, &own, &saved, error);
    if (status == PSPEC_OK) {
        status = add_list(table, &own, &list, error);
    }
    ps_saved_spectrum_free(&saved);
    return status;
}

static pspec_status add_setup(ps_table *table, const ps_request *arguments,
                              const ps_quadrature_setup *setup, size_t index, ps_error *error) {
    const ps_device_limits *const limits =
        setup->device != NULL ? ps_device_get_limits(setup->device) : NULL;
    PS_TRY(add_header(table, arguments, &setup->problem, &setup->needs, limits, index, error));
    if (setup->degrees_note[0] != '\0') {
        PS_TRY(ps_table_add_meta(table, "degrees_note", PS_TEXT(setup->degrees_note), error));
    }
    if (setup->weights_note[0] != '\0') {
        PS_TRY(ps_table_add_meta(table, "weights", PS_TEXT(setup->weights_note), error));
    }
    return add_candidates(table, &setup->plan, error);
}

static pspec_status add_quadrature(ps_table *table, const ps_request *arguments, ps_error *error) {
    ps_quadrature_list list;
    pspec_status status = ps_quadrature_list_make(&list, arguments, error);
    for (size_t i = 0; status == PSPEC_OK && i < list.num; i++) {
        ps_quadrature_setup setup;
        status = ps_quadrature_setup_ask(&setup, &list.questions[i], error);
        if (status == PSPEC_OK) {
            status = add_setup(table, arguments, &setup, i, error);
        }
        ps_quadrature_setup_free(&setup);
    }
    ps_quadrature_list_free(&list);
    return status;
}

static pspec_status fill(ps_table *table, const ps_request *arguments, const ps_command *command,
                         ps_question_kind kind, ps_error *error) {
    PS_TRY(ps_table_add_meta(table, "pointspec_version", PS_TEXT(PS_VERSION), error));
    PS_TRY(ps_table_add_meta(table, "schema", PS_INTEGER(1), error));
    PS_TRY(ps_table_add_meta(table, "command", PS_TEXT(arguments->command_line), error));
    return command == &ps_command_quadrature ? add_quadrature(table, arguments, error)
           : command == &ps_command_check    ? add_check(table, arguments, error)
                                             : add_jobs(table, arguments, kind, error);
}

/* Commands that can be planned; the kind is of those whose question is one of a spectrum. */
static const struct {
    const ps_command *command;
    ps_question_kind kind;
} planned[] = {{&ps_command_power, PS_QUESTION_POWER},
               {&ps_command_angular, PS_QUESTION_ANGULAR},
               {&ps_command_pairs, PS_QUESTION_PAIRS},
               {&ps_command_quadrature, PS_QUESTION_PAIRS},
               {&ps_command_check, PS_QUESTION_POWER}};
enum { NUM_PLANNED = sizeof planned / sizeof planned[0] };

/* Options of the other command only. */
static pspec_status check_options(const ps_command *command, const ps_request *arguments,
                                  ps_error *error) {
    for (int id = 0; id < PS_NUM_OPTIONS; id++) {
        if (arguments->is_given[id] && !ps_command_takes(command, (ps_option_id)id)) {
            return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s does not take --%s",
                           command->name, ps_options[id].name);
        }
    }
    return PSPEC_OK;
}

/* The first word names the command that is asked about; the rest is that command's. */
static pspec_status take_command(ps_request *inner, const ps_command **command,
                                 ps_question_kind *kind, const ps_request *arguments,
                                 ps_error *error) {
    for (size_t i = 0; i < NUM_PLANNED && arguments->num_files > 0; i++) {
        if (strcmp(arguments->files[0], planned[i].command->name) == 0) {
            *inner = *arguments;
            inner->files++;
            inner->num_files--;
            *kind = planned[i].kind;
            *command = planned[i].command;
            return check_options(planned[i].command, arguments, error);
        }
    }
    return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                   "name the command to plan first, as in: pointspec plan power --sampler white "
                   "(power, angular, pairs, quadrature and check can be planned)");
}

static pspec_status run(const ps_request *arguments, ps_error *error) {
    ps_request inner;
    static const char *const columns[] = {"engine", "verdict", "seconds",
                                          "bytes",  "error",   "reason"};
    ps_table *table = NULL;
    ps_table_format format = PS_FORMAT_CSV;
    ps_question_kind kind = PS_QUESTION_POWER;
    const ps_command *command = NULL;
    PS_TRY(take_command(&inner, &command, &kind, arguments, error));
    PS_TRY(ps_table_choose_format(&format, arguments->format, arguments->output, error));
    PS_TRY(ps_table_create(&table, "plan", columns, sizeof columns / sizeof columns[0], error));
    pspec_status status = fill(table, &inner, command, kind, error);
    if (status == PSPEC_OK) {
        status = ps_table_write(table, arguments->output != NULL ? arguments->output : "-", format,
                                error);
    }
    ps_table_destroy(table);
    return status;
}

/* Those of all commands that can be planned. */
static const ps_option_id options[] = {
    PS_OPTION_SAMPLER,        PS_OPTION_POINTS,       PS_OPTION_REALIZATIONS,
    PS_OPTION_STANDARD_ERROR, PS_OPTION_AGAINST,      PS_OPTION_FALSE_ALARM_RATE,
    PS_OPTION_DIMENSION,      PS_OPTION_BRDF,         PS_OPTION_SMOOTHNESS,
    PS_OPTION_DROP_BELOW,     PS_OPTION_SEED,         PS_OPTION_HOMOGENIZE,
    PS_OPTION_WEIGHTS,        PS_OPTION_INPUT_FORMAT, PS_OPTION_COLUMNS,
    PS_OPTION_SELECT_SETS,    PS_OPTION_WRAP,         PS_OPTION_NORMALIZE_VECTORS,
    PS_OPTION_MAX_FREQUENCY,  PS_OPTION_MAX_DEGREE,   PS_OPTION_HEMISPHERE,
    PS_OPTION_COEFFICIENTS,   PS_OPTION_HARMONICS,    PS_OPTION_FREQUENCIES,
    PS_OPTION_SHELLS,         PS_OPTION_PER_RING,     PS_OPTION_NORMALIZE,
    PS_OPTION_TOLERANCE,      PS_OPTION_FLOOR,        PS_OPTION_PRECISION,
    PS_OPTION_ENGINE,         PS_OPTION_DEVICE,       PS_OPTION_NO_SKIP,
    PS_OPTION_NO_SELF_CHECK,  PS_OPTION_OUTPUT,       PS_OPTION_FORMAT,
    PS_OPTION_FULL,           PS_OPTION_PLOT,         PS_OPTION_PROFILE,
    PS_OPTION_MEMORY,         PS_OPTION_QUIET,        PS_OPTION_VERBOSE,
    PS_OPTION_HELP,           PS_NUM_OPTIONS};

const ps_command ps_command_plan = {
    .name = "plan",
    .summary = "what a command would do: engines, seconds, bytes, error, what is skipped",
    .usage = "plan power|angular|pairs|quadrature|check [options of that command]",
    .description = "Takes the same arguments as the command named after it and prints how that "
                   "command would go about it: every engine with its estimated time, memory and "
                   "error, the one chosen, why the others were not, and what is skipped and why. "
                   "Nothing is computed and nothing is timed.",
    .options = options,
    .examples = {"pointspec plan power --sampler white -n 4096 -m 1000 -k 128",
                 "pointspec plan angular --sampler white-sphere -n 1e6 -l 512 --tol 1e-9"},
    .weights = "equal|column|optimal|FILE",
    .samples = PS_DOMAIN_ANY,
    .run = run,
};
