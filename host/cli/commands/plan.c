/* pointspec plan: what another command would do, by what, what it skips and why. */
#include "cli/command.h"
#include "cli/run_shown.h"
#include "questions/options.h"
#include "store/host_figures.h"

#include "pointspec_version.h"

#include <string.h>

/* Commands that can be planned. */
static const ps_command *const planned[] = {
    &ps_command_power,      &ps_command_angular,    &ps_command_pairs,
    &ps_command_quadrature, &ps_command_truncation, &ps_command_check,
    &ps_command_run,        &ps_command_sample,     &ps_command_convert};
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
                                 const ps_request *arguments, ps_error *error) {
    for (size_t i = 0; i < NUM_PLANNED && arguments->num_files > 0; i++) {
        if (strcmp(arguments->files[0], planned[i]->name) == 0) {
            *inner = *arguments;
            inner->files++;
            inner->num_files--;
            *command = planned[i];
            return check_options(planned[i], arguments, error);
        }
    }
    return ps_fail(
        error, PSPEC_ERROR_INVALID_ARGUMENT,
        "name the command to plan first, as in: pointspec plan power --sampler white "
        "(power, angular, pairs, quadrature, truncation, check, run, sample and convert can be "
        "planned)");
}

static pspec_status add_facts(ps_table *table, const ps_request *arguments, ps_error *error) {
    PS_TRY(ps_table_add_meta(table, "pointspec_version", PS_TEXT(PS_VERSION), error));
    PS_TRY(ps_table_add_meta(table, "schema", PS_INTEGER(1), error));
    return ps_table_add_meta(table, "command", PS_TEXT(arguments->command_line), error);
}

static pspec_status fill_jobs(ps_planner *planner, const ps_command *command,
                              const ps_request *arguments, ps_error *error) {
    if (command == &ps_command_run) {
        const ps_run_hooks hooks = ps_run_hooks_make(arguments);
        return ps_run_plan(planner, arguments, &hooks, error);
    }
    if (command == &ps_command_sample) {
        return ps_plan_table_add_sample(planner, arguments, error);
    }
    return command == &ps_command_convert ? ps_plan_table_add_convert(planner, arguments, error)
                                          : command->result->plan(planner, arguments, error);
}

static pspec_status fill(ps_table *table, const ps_command *command, const ps_request *arguments,
                         ps_error *error) {
    ps_figures host;
    ps_planner planner = {.table = table, .host = &host};
    PS_TRY(add_facts(table, arguments, error));
    PS_TRY(ps_host_figures_read(&host, arguments->cache_folder, error));
    PS_TRY(ps_table_add_meta(table, "host_figures", PS_TEXT(host.note), error));
    PS_TRY(fill_jobs(&planner, command, arguments, error));
    return ps_plan_table_end(&planner, error);
}

static pspec_status run(const ps_request *arguments, ps_error *error) {
    ps_request inner;
    ps_table *table = NULL;
    ps_table_format format = PS_FORMAT_CSV;
    const ps_command *command = NULL;
    PS_TRY(take_command(&inner, &command, arguments, error));
    /* Where points are written -o and --format are about the points: the plan must not stand in their place. */
    const bool is_of_points = command == &ps_command_sample || command == &ps_command_convert;
    const char *const path = !is_of_points && arguments->output != NULL ? arguments->output : "-";
    PS_TRY(ps_table_choose_format(&format, is_of_points ? NULL : arguments->format, path, error));
    PS_TRY(ps_plan_table_create(&table, command == &ps_command_run, error));
    pspec_status status = fill(table, command, &inner, error);
    if (status == PSPEC_OK) {
        status = ps_table_write(table, path, format, error);
    }
    ps_table_destroy(table);
    return status;
}

/* Those of all commands that can be planned. */
static const ps_option_id options[] = {PS_OPTION_SAMPLER,       PS_OPTION_POINTS,
                                       PS_OPTION_REALIZATIONS,  PS_OPTION_STANDARD_ERROR,
                                       PS_OPTION_AGAINST,       PS_OPTION_FALSE_ALARM_RATE,
                                       PS_OPTION_DIMENSION,     PS_OPTION_BRDF,
                                       PS_OPTION_SMOOTHNESS,    PS_OPTION_DROP_BELOW,
                                       PS_OPTION_SEED,          PS_OPTION_HOMOGENIZE,
                                       PS_OPTION_WEIGHTS,       PS_OPTION_INPUT_FORMAT,
                                       PS_OPTION_COLUMNS,       PS_OPTION_SELECT_SETS,
                                       PS_OPTION_WRAP,          PS_OPTION_NORMALIZE_VECTORS,
                                       PS_OPTION_MAX_FREQUENCY, PS_OPTION_MAX_DEGREE,
                                       PS_OPTION_HEMISPHERE,    PS_OPTION_COEFFICIENTS,
                                       PS_OPTION_HARMONICS,     PS_OPTION_FREQUENCIES,
                                       PS_OPTION_SHELLS,        PS_OPTION_PER_RING,
                                       PS_OPTION_NORMALIZE,     PS_OPTION_TOLERANCE,
                                       PS_OPTION_FLOOR,         PS_OPTION_PRECISION,
                                       PS_OPTION_ENGINE,        PS_OPTION_DEVICE,
                                       PS_OPTION_NO_SKIP,       PS_OPTION_CACHE,
                                       PS_OPTION_NO_SELF_CHECK, PS_OPTION_OUTPUT,
                                       PS_OPTION_FORMAT,        PS_OPTION_FULL,
                                       PS_OPTION_PLOT,          PS_OPTION_PROFILE,
                                       PS_OPTION_MEMORY,        PS_OPTION_QUIET,
                                       PS_OPTION_VERBOSE,       PS_OPTION_HELP,
                                       PS_OPTION_DOMAIN,        PS_OPTION_SELECT_POINTS,
                                       PS_OPTION_MERGE,         PS_OPTION_TO_COLUMNS,
                                       PS_NUM_OPTIONS};

const ps_command ps_command_plan = {
    .name = "plan",
    .summary = "what a command would do: engines, seconds, bytes, error, what is skipped",
    .usage =
        "plan power|angular|pairs|quadrature|truncation|check|run|sample|convert [options of that "
        "command]",
    .description =
        "Takes the same arguments as the command named after it and prints how that "
        "command would go about it: every engine with its estimated time, memory and "
        "error, the one chosen, why the others were not, what is skipped and why, and how long "
        "each phase takes. "
        "Nothing is computed and nothing is timed.",
    .options = options,
    .examples = {"pointspec plan power --sampler white -n 4096 -m 1000 -k 128",
                 "pointspec plan angular --sampler white-sphere -n 1e6 -l 512 --tol 1e-9"},
    .weights = "equal|column|optimal|FILE",
    .samples = PS_DOMAIN_ANY,
    .run = run,
};
