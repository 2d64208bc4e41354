/* pointspec plan: what another command would do, by what, what it skips and why. */
#include "cli/command.h"
#include "cli/shown.h"

/* Options of plan are those of everything that can be planned. */
#define BIT(name) PS_VERB_BIT(name) |
enum {
    PLANNED =
        PS_VERB_BIT(run) | PS_VERB_BIT(sample) | PS_VERB_BIT(convert) | PS_VERBS(BIT, PS_UNNAMED) 0
};

/* Options of the other command only. */
static pspec_status check_options(const ps_verb *verb, const ps_request *arguments,
                                  ps_error *error) {
    for (int id = 0; id < PS_NUM_OPTIONS; id++) {
        if (arguments->is_given[id] && !ps_verb_takes(verb, (ps_option_id)id)) {
            return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s does not take --%s", verb->name,
                           ps_options[id].name);
        }
    }
    return PSPEC_OK;
}

/* The first word names the command that is asked about; the rest is that command's. */
static pspec_status take_command(ps_request *inner, const ps_verb **verb,
                                 const ps_request *arguments, ps_error *error) {
    *verb = arguments->num_files > 0 ? ps_verb_find(arguments->files[0]) : NULL;
    if (*verb == NULL) {
        return ps_fail(
            error, PSPEC_ERROR_INVALID_ARGUMENT,
            "name the command to plan first, as in: pointspec plan power --sampler white "
            "(" PS_KINDS_IN_SENTENCE "run, sample and convert can be planned)");
    }
    *inner = *arguments;
    inner->files++;
    inner->num_files--;
    return check_options(*verb, arguments, error);
}

static pspec_status run(const ps_request *arguments, ps_error *error) {
    ps_request inner;
    ps_table *table = NULL;
    ps_table_format format = PS_FORMAT_CSV;
    const ps_verb *verb = NULL;
    ps_shown shown = {.arguments = arguments, .speaker = "pointspec"};
    const ps_answer_hooks hooks = ps_shown_hooks(&shown);
    PS_TRY(take_command(&inner, &verb, arguments, error));
    /* Where points are written -o and --format are about the points: the plan must not stand in
     * their place. */
    const char *const path = verb->makes_points ? "-" : arguments->output;
    const bool is_of_points = verb->makes_points && arguments->is_given[PS_OPTION_FORMAT];
    PS_TRY(ps_table_choose_format(&format, is_of_points ? NULL : arguments->format, path, error));
    PS_TRY(ps_verb_plan(&table, verb, &inner, &hooks, error));
    ps_table_set_view(table, &arguments->view);
    const pspec_status status = ps_table_write(table, path, format, error);
    ps_table_destroy(table);
    return status;
}

const ps_command ps_command_plan = {
    .name = "plan",
    .summary = "what a command would do: engines, seconds, bytes, error, what is skipped",
    .usage = "plan " PS_KINDS_IN_USAGE "run|sample|convert [options of that command]",
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
