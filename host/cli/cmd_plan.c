/* pointspec plan: what another command would do, by what, what it skips and why. */
#include "cli/command.h"
#include "cli/options.h"
#include "cli/question.h"
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

static pspec_status add_header(ps_table *table, const ps_arguments *arguments,
                               const ps_power_job *job, size_t index, ps_error *error) {
    const ps_problem *problem = ps_power_job_problem(job);
    const ps_needs *needs = ps_power_job_needs(job);
    const ps_device_limits *limits = ps_power_job_limits(job);
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
        char text[256];
        snprintf(text, sizeof text, "%s; %s; %.3g", needs->skips[i].what, needs->skips[i].why,
                 needs->skips[i].share);
        PS_TRY(ps_table_add_meta(table, "skip", PS_TEXT(text), error));
    }
    return PSPEC_OK;
}

static pspec_status add_jobs(ps_table *table, const ps_arguments *arguments, ps_domain domain,
                             ps_error *error) {
    ps_question_list list;
    PS_TRY(ps_questions_make(&list, arguments, domain, error));
    PS_TRY(ps_table_add_meta(table, "pointspec_version", PS_TEXT(PS_VERSION), error));
    PS_TRY(ps_table_add_meta(table, "schema", PS_INTEGER(1), error));
    PS_TRY(ps_table_add_meta(table, "command", PS_TEXT(arguments->command_line), error));
    for (size_t i = 0; i < list.num; i++) {
        ps_power_job *job = NULL;
        PS_TRY(ps_power_job_create(&job, &list.questions[i], error));
        pspec_status status = add_header(table, arguments, job, i, error);
        if (status == PSPEC_OK) {
            status = add_candidates(table, ps_power_job_plan(job), error);
        }
        ps_power_job_destroy(job);
        PS_TRY(status);
    }
    return PSPEC_OK;
}

/* Commands that can be planned. */
static const struct {
    const ps_command *command;
    ps_domain domain;
} planned[] = {{&ps_command_power, PS_DOMAIN_TORUS}, {&ps_command_angular, PS_DOMAIN_SPHERE}};
enum { NUM_PLANNED = sizeof planned / sizeof planned[0] };

/* Options of the other command only. */
static pspec_status check_options(const ps_command *command, const ps_arguments *arguments,
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
static pspec_status take_command(ps_arguments *inner, ps_domain *domain,
                                 const ps_arguments *arguments, ps_error *error) {
    for (size_t i = 0; i < NUM_PLANNED && arguments->num_files > 0; i++) {
        if (strcmp(arguments->files[0], planned[i].command->name) == 0) {
            *inner = *arguments;
            inner->files++;
            inner->num_files--;
            *domain = planned[i].domain;
            return check_options(planned[i].command, arguments, error);
        }
    }
    return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                   "name the command to plan first, as in: pointspec plan power --sampler white "
                   "(power and angular can be planned)");
}

static pspec_status run(const ps_arguments *arguments, ps_error *error) {
    ps_arguments inner;
    static const char *const columns[] = {"engine", "verdict", "seconds",
                                          "bytes",  "error",   "reason"};
    ps_table *table = NULL;
    ps_table_format format = PS_FORMAT_CSV;
    ps_domain domain = PS_DOMAIN_TORUS;
    PS_TRY(take_command(&inner, &domain, arguments, error));
    PS_TRY(ps_table_choose_format(&format, arguments->format, arguments->output, error));
    PS_TRY(ps_table_create(&table, "plan", columns, sizeof columns / sizeof columns[0], error));
    pspec_status status = add_jobs(table, &inner, domain, error);
    if (status == PSPEC_OK) {
        status = ps_table_write(table, arguments->output != NULL ? arguments->output : "-", format,
                                error);
    }
    ps_table_destroy(table);
    return status;
}

/* Those of all commands that can be planned. */
static const ps_option_id options[] = {
    PS_OPTION_SAMPLER,       PS_OPTION_POINTS,        PS_OPTION_REALIZATIONS,
    PS_OPTION_DIMENSION,     PS_OPTION_SEED,          PS_OPTION_HOMOGENIZE,
    PS_OPTION_WEIGHTS,       PS_OPTION_INPUT_FORMAT,  PS_OPTION_COLUMNS,
    PS_OPTION_SELECT_SETS,   PS_OPTION_WRAP,          PS_OPTION_NORMALIZE_VECTORS,
    PS_OPTION_MAX_FREQUENCY, PS_OPTION_MAX_DEGREE,    PS_OPTION_HEMISPHERE,
    PS_OPTION_FREQUENCIES,   PS_OPTION_SHELLS,        PS_OPTION_PER_RING,
    PS_OPTION_NORMALIZE,     PS_OPTION_TOLERANCE,     PS_OPTION_FLOOR,
    PS_OPTION_PRECISION,     PS_OPTION_ENGINE,        PS_OPTION_DEVICE,
    PS_OPTION_NO_SKIP,       PS_OPTION_NO_SELF_CHECK, PS_OPTION_OUTPUT,
    PS_OPTION_FORMAT,        PS_OPTION_FULL,          PS_OPTION_PLOT,
    PS_OPTION_PROFILE,       PS_OPTION_QUIET,         PS_OPTION_VERBOSE,
    PS_OPTION_HELP,          PS_NUM_OPTIONS};

const ps_command ps_command_plan = {
    .name = "plan",
    .summary = "what a command would do: engines, seconds, bytes, error, what is skipped",
    .usage = "plan power|angular [options of that command]",
    .description = "Takes the same arguments as the command named after it and prints how that "
                   "command would go about it: every engine with its estimated time, memory and "
                   "error, the one chosen, why the others were not, and what is skipped and why. "
                   "Nothing is computed and nothing is timed.",
    .options = options,
    .examples = {"pointspec plan power --sampler white -n 4096 -m 1000 -k 128",
                 "pointspec plan angular --sampler white-sphere -n 1e6 -l 512 --tol 1e-9"},
    .samples = PS_DOMAIN_ANY,
    .run = run,
};
