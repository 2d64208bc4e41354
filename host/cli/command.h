/* The commands: one file each (commands/NAME.c), one table (commands.c). */
#ifndef PS_CLI_COMMAND_H
#define PS_CLI_COMMAND_H

#include "answers/kind.h"
#include "base/watch.h"
#include "cli/signals.h"
#include "commands/verb.h"

#include <stdio.h>

/* Exit codes of the program (docs/user/conventions.md#exit-codes). */
enum {
    PS_EXIT_DONE = 0,
    PS_EXIT_FAILED = 1,
    PS_EXIT_USAGE = 2,
    PS_EXIT_CHECK = 3,
    PS_EXIT_INTERRUPTED = 130, /* by SIGINT, SIGTERM or SIGHUP */
    PS_EXIT_PIPE = 141         /* nobody reads what is written: what shells say of SIGPIPE */
};

typedef struct ps_command {
    const char *name;
    const char *summary;     /* one line */
    const char *usage;       /* after "pointspec ", for example "power [options] [FILE...]" */
    const char *description; /* a paragraph for --help */
    const ps_kind *result;   /* what it prints, with the options of that question; or NULL */
    const ps_verb *verb;     /* what else it does that the library can do, too; or NULL */
    ps_verb_set takes;       /* whose options: the command's bit in their table */
    const char *examples[2]; /* complete command lines, run by the tests */
    /* Words of --format, the default first, and of --weights, where neither result nor verb says
     * so; NULL: csv|json|npy|npz|jsonl|text, equal|column|FILE. */
    const char *formats, *weights;
    bool makes_folder; /* which --output names: it has no default */
    ps_domain samples; /* which samplers it takes, where no result says so, for --help */
    pspec_status (*run)(const ps_request *, ps_error *); /* NULL: it prints its result */
} ps_command;

/* Ended by NULL. */
extern const ps_command *const ps_commands[];

/* The command of that name; NULL with a sentence that names the nearest one. */
const ps_command *ps_command_find(const char *name, ps_error *error);

/* ps_command_power, .. */
#define PS_DECLARE_COMMAND(name) extern const ps_command ps_command_##name;
PS_VERBS(PS_DECLARE_COMMAND, PS_DECLARE_COMMAND)

/* Names of all kinds of answers in sentences, "power, angular, .., check, ", and in usages,
 * "power|angular|..|check|". */
#define PS_COMMA_AFTER(name) #name ", "
#define PS_BAR_AFTER(name) #name "|"
#define PS_UNNAMED(name)
#define PS_KINDS_IN_SENTENCE PS_VERBS(PS_COMMA_AFTER, PS_UNNAMED)
#define PS_KINDS_IN_USAGE PS_VERBS(PS_BAR_AFTER, PS_UNNAMED)

/* Every command takes --help, also when the table of options does not say so. */
bool ps_command_takes(const ps_command *command, ps_option_id id);

/* The values that the command admits for the option, "one|two|FILE"; NULL for a flag. */
const char *ps_command_words(const ps_command *command, ps_option_id id);

/* What stands after the option in usage and help: these values, or NAME when they are too many for
 * a line; NULL for a flag. */
const char *ps_command_metavar(const ps_command *command, ps_option_id id);

/* Parses the words after the command's name. Options and files may be mixed; "--" ends the options,
 * "-" is a file. --name value, --name=value, -n value, -nvalue; an option given again replaces what
 * it said before, but --sampler adds. Errors name the nearest option that the command takes. --help
 * ends the parsing: see is_given[PS_OPTION_HELP]. Call ps_arguments_free also after an error. */
pspec_status ps_arguments_parse(ps_request *arguments, const ps_command *command, int num_words,
                                char **words, ps_error *error) PS_MUST_CHECK;
void ps_arguments_free(ps_request *arguments);

/* Exit code that goes with a status. */
int ps_exit_code(pspec_status status);

/* --help: what the program does, and what one command does. */
void ps_help_program(FILE *stream);
void ps_help_command(FILE *stream, const ps_command *command);
/* The columns, header entries and arrays of the answers that the command prints. */
pspec_status ps_help_fields(FILE *stream, const ps_command *command, ps_error *error) PS_MUST_CHECK;

/* A progress line on standard error, when that is a terminal and --quiet was not given: done, rate,
 * time left; updated at most ten times a second, erased at the end. total 0: unknown. what names
 * the things counted, for example "realizations", and must outlive the progress. */
typedef struct ps_progress ps_progress;
ps_progress *ps_progress_begin(const ps_request *arguments, const char *what); /* NULL: silent */
void ps_progress_update(ps_progress *progress, uint64_t done, uint64_t total);
/* From now on the line is about a part of the work, which it names first; time and rate begin anew.
 */
void ps_progress_part(ps_progress *progress, const char *format, ...) PS_PRINTF(2, 3);
void ps_progress_hide(ps_progress *progress); /* until the next update: something else is printed */
void ps_progress_end(ps_progress *progress);
/* The call of a ps_watch whose payload is a progress line or NULL: other phases than `what` are
 * shown, too, with a rate of their own or their detail; an interrupt cancels. */
int ps_progress_tell(const ps_watch_report *report, void *progress);

#endif
