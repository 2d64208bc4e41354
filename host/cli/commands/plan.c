/* pointspec plan: what another command would do, by what, what it skips and why. */
#include "cli/command.h"
#include "questions/options.h"
#include "store/host_figures.h"

#include "pointspec_version.h"

#include <string.h>

/* Commands that can be planned: those that print a result, and others that say how. Their options are those of plan. */
#define COMMAND(name) &ps_command_##name,
#define BIT(name) PS_TAKER_BIT(name) |
#define NOTHING(name)
static const ps_command *const planned[] = {&ps_command_run, &ps_command_sample,
                                            &ps_command_convert, PS_TAKERS(COMMAND, NOTHING) NULL};
enum {
    PLANNED =
        PS_TAKER_BIT(run) | PS_TAKER_BIT(sample) | PS_TAKER_BIT(convert) | PS_TAKERS(BIT, NOTHING) 0
};

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
    for (size_t i = 0; planned[i] != NULL && arguments->num_files > 0; i++) {
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

static pspec_status fill(ps_table *table, const ps_command *command, const ps_request *arguments,
                         ps_error *error) {
    ps_figures host;
    ps_planner planner = {.table = table, .host = &host};
    PS_TRY(add_facts(table, arguments, error));
    PS_TRY(ps_host_figures_read(&host, arguments->limits.cache_folder, error));
    PS_TRY(ps_table_add_meta(table, "host_figures", PS_TEXT(host.note), error));
    PS_TRY(command->plan != NULL ? command->plan(&planner, arguments, error)
                                 : command->result->plan(&planner, arguments, error));
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
    const char *const path = is_of_points ? "-" : arguments->output;
    PS_TRY(ps_table_choose_format(&format, is_of_points ? NULL : arguments->format, path, error));
    PS_TRY(ps_plan_table_create(&table, command == &ps_command_run, error));
    pspec_status status = fill(table, command, &inner, error);
    if (status == PSPEC_OK) {
        status = ps_table_write(table, path, format, error);
    }
    ps_table_destroy(table);
    return status;
}

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
    .takes = PLANNED,
    .examples = {"pointspec plan power --sampler white -n 4096 -m 1000 -k 128",
                 "pointspec plan angular --sampler white-sphere -n 1e6 -l 512 --tol 1e-9"},
    .weights = "equal|column|optimal|FILE",
    .samples = PS_DOMAIN_ANY,
    .run = run,
};
