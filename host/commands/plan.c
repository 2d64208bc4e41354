/* pointspec plan: what another command would do, by what, what it skips and why. */
#include "commands/plan.h"
#include "store/figures_file.h"

const ps_command *const ps_with_fields[] = {
    PS_COMMANDS(PS_KIND_OF, PS_NO_COMMAND, PS_COMMAND_OF, PS_NO_COMMAND) NULL};
const ps_command *const ps_plannable[] = {
    PS_COMMANDS(PS_KIND_OF, PS_COMMAND_OF, PS_NO_COMMAND, PS_NO_COMMAND) NULL};

/* ---- the table --------------------------------------------------------------------------- */

static pspec_status fill(ps_planner *planner, const ps_command *command, const ps_request *request,
                         ps_error *error) {
    ps_figures host;
    ps_device_limits processors;
    ps_table *const table = planner->table;
    planner->host = &host;
    PS_TRY(ps_lead_add_origin(table, request->command_line, error));
    /* the total stands before the parts, of which a scene may have hundreds */
    PS_TRY(ps_table_add_meta(table, "seconds", PS_MISSING, error));
    ps_host_describe(&processors);
    PS_TRY(ps_figures_read(&host, request->limits.cache_folder, &processors, error));
    PS_TRY(ps_table_add_meta(table, "host_figures", PS_TEXT(host.note), error));
    const size_t num_single = ps_table_num_meta(table);
    PS_TRY(command->plan(planner, request, error));
    PS_TRY(ps_plan_table_end(planner, error));
    for (size_t i = num_single; i < ps_table_num_meta(table); i++) { /* of every question */
        const char *key = NULL;
        ps_table_meta(table, i, &key);
        ps_table_set_repeated(table, key);
    }
    return PSPEC_OK;
}

pspec_status ps_plan_command(ps_table **out, const ps_command *command, const ps_request *request,
                             const ps_answer_hooks *hooks, ps_error *error) {
    ps_planner planner = {.device = hooks->device,
                          .hooks = hooks,
                          .lead = command == &ps_command_run || command == &ps_command_report
                                      ? ps_plan_table_lead("")
                                      : ps_lead_make(request, 0)};
    *out = NULL;
    PS_TRY(ps_plan_table_create(&planner.table, &planner.lead, error));
    const pspec_status status = fill(&planner, command, request, error);
    if (status != PSPEC_OK) {
        ps_table_destroy(planner.table);
        return status;
    }
    *out = planner.table;
    return PSPEC_OK;
}

/* ---- the command ------------------------------------------------------------------------- */

/* Options of plan are those of everything that can be planned. */
#define BIT(name) PS_COMMAND_BIT(name) |
enum { PLANNED = PS_COMMANDS(BIT, BIT, PS_NO_COMMAND, PS_NO_COMMAND) 0 };

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
    size_t distance = 1;
    if (arguments->num_files > 0) {
        *command = ps_command_nearest(ps_plannable, arguments->files[0], &distance);
    }
    if (distance > 0) {
        return ps_fail(
            error, PSPEC_ERROR_INVALID_ARGUMENT,
            "name the command to plan first, as in: pointspec plan power --sampler white "
            "(" PS_KINDS_IN_SENTENCE "run, report, sample and convert can be planned)");
    }
    *inner = *arguments;
    inner->files++;
    inner->num_files--;
    return check_options(*command, arguments, error);
}

static pspec_status run(ps_answer *out, const ps_request *arguments, const ps_answer_hooks *hooks,
                        ps_error *error) {
    ps_request inner;
    ps_table_format format = PS_FORMAT_CSV;
    const ps_command *command = NULL;
    PS_TRY(take_command(&inner, &command, arguments, error));
    /* Where points are written -o and --format are about the points: the plan must not stand in
     * their place. */
    const char *const path = command->makes_points ? "-" : arguments->output;
    const bool is_of_points = command->makes_points && arguments->is_given[PS_OPTION_FORMAT];
    PS_TRY(ps_table_choose_format(&format, is_of_points ? NULL : arguments->format, path, error));
    PS_TRY(ps_plan_command(&out->table, command, &inner, hooks, error));
    ps_table_set_view(out->table, &arguments->view);
    return ps_table_write(out->table, path, format, error);
}

static const ps_field_row own_fields[] = {
    {"pointspec_version", "", PS_ENTRY, 0, "", "version of the program"},
    {"schema", "", PS_ENTRY, 0, "", "number of the format of the table"},
    {"command", "", PS_ENTRY, 0, "", "the command line"},
    {"seconds", "s", PS_ENTRY, 0, "",
     "sum of all phases; begins with at most where one of them may end earlier"},
    {"host_figures", "", PS_ENTRY, 0, "",
     "whether there are figures measured on this host (bench --calibrate), or why not"},
    {"no_device", "", PS_ENTRIES, 0, "no device", "why there is none"},
    {"job", "", PS_ENTRIES, 0, "scenes", "name of the result and number of its question"},
    {"question", "", PS_ENTRIES, 0, "scenes", "the command line that asks it"},
    {"sampler", "", PS_ENTRIES, 0, "samplers, --set", "the sampler, or the name of the set"},
    {"device", "", PS_ENTRIES, 0, "", "what would compute it; host or none without OpenCL"},
    {"figures", "", PS_ENTRIES, 0, "", "the same of the device"},
    {"points", "", PS_ENTRIES, 0, "", "N; of files those of the largest set"},
    {"realizations", "", PS_ENTRIES, 0, "", "how many, where that is known"},
    {"max_frequency", "", PS_ENTRIES, 0, "on the torus", "K"},
    {"max_degree", "", PS_ENTRIES, 0, "on the sphere", "L"},
    {"frequencies", "", PS_ENTRIES, 0, "on the torus", "how many"},
    {"degrees", "", PS_ENTRIES, 0, "on the sphere", "how many"},
    {"tolerance", "", PS_ENTRIES, 0, "", "largest numerical error that is allowed (--tol)"},
    {"degrees_note", "", PS_ENTRIES, 0, "quadrature", "why there are so many degrees"},
    {"horizon_points", "", PS_ENTRIES, 0, "shade --view",
     "directions below the horizon, which points count, too"},
    {"weights", "", PS_ENTRIES, 0, "quadrature", "how weights are made"},
    {"skip", "", PS_ENTRIES, 0, "", "what is not done; why; share of work"},
    {"phase", "", PS_ENTRIES, 0, "", "name; seconds; what is done"},
    {"job", "", PS_COLUMN, 0, "scenes", "name of the result and number of its question"},
    {"sampler", "", PS_COLUMN, 0, "several samplers, --set", "the sampler, or the name of the set"},
    {"points", "", PS_COLUMN, 0, "several numbers of points", "N as it was asked for"},
    {"engine", "", PS_COLUMN, 0, "", "the engine and its precision; host, or cache of results"},
    {"verdict", "", PS_COLUMN, 0, "",
     "chosen, slower, infeasible, excluded or not applicable; with a first column also skip, "
     "phase"},
    {"seconds", "s", PS_COLUMN, 0, "", "of the whole command with that engine; of the phase"},
    {"bytes", "bytes", PS_COLUMN, 0, "", "memory that it takes"},
    {"error", "", PS_COLUMN, 0, "", "bound on its numerical error, in the unit of --tol"},
    {"reason", "", PS_COLUMN, 0, "", "why it is chosen, or not; what is skipped or done"},
    {.name = NULL}};
static const ps_field_row *const fields[] = {own_fields, NULL};

const ps_command ps_command_plan = {
    .name = "plan",
    .purpose = "what a command would do: engines, seconds, bytes, error, what is skipped",
    .usage = "plan " PS_KINDS_IN_USAGE "run|report|sample|convert [options of that command]",
    .description =
        "Takes the same arguments as the command named after it and prints how that "
        "command would go about it: every engine with its estimated time, memory and "
        "error, the one chosen, why the others were not, what is skipped and why, and how long "
        "each phase takes. "
        "Nothing is computed and nothing is timed.",
    .takes = PLANNED,
    .fields = fields,
    .examples = {"pointspec plan power --sampler white -n 4096 -m 1000 -k 128",
                 "pointspec plan angular --sampler white-sphere -n 1e6 -l 512 --tol 1e-9"},
    .weights = "equal|column|optimal|FILE",
    .samples = PS_DOMAIN_ANY,
    .run = run,
};
