/* The options of all commands, one row per ps_option_id: parser, usage and --help come from here.
 */
#ifndef PS_CLI_OPTIONS_H
#define PS_CLI_OPTIONS_H

#include "cli/command.h"

typedef struct ps_option ps_option;

/* Stores value (NULL for a flag) in *arguments, or says what is wrong with it. words are the values
 * that the command at hand admits, "one|two". */
typedef pspec_status ps_option_setter(const ps_option *option, const char *words, const char *value,
                                      ps_arguments *arguments, ps_error *error);

struct ps_option {
    const char *name;    /* without its dashes */
    const char *metavar; /* NULL: takes no value */
    const char *help;
    ps_option_setter *set;
    size_t offset;    /* of the field of ps_arguments, for setters that serve several options */
    const char *what; /* in messages, where a limit can be broken */
    uint64_t minimum, maximum;
    char letter; /* 0: none */
};

extern const ps_option ps_options[PS_NUM_OPTIONS];

/* Every command takes --help, also when its list does not say so. */
bool ps_command_takes(const ps_command *command, ps_option_id id);

/* The values that the command admits for the option, "one|two|FILE"; NULL for a flag. */
const char *ps_option_words(const ps_command *command, ps_option_id id);

/* What stands after the option in usage and help: these values, or NAME when they are too many for
 * a line; NULL for a flag. */
const char *ps_option_metavar(const ps_command *command, ps_option_id id);

/* How far a name that somebody typed is from a known one. 0: that very name; a beginning of it
 * counts as one letter. */
size_t ps_name_distance(const char *typed, const char *known);

#endif
