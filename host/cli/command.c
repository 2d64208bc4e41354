/* What a command takes. */
#include "cli/command.h"

#include "request/options.h"

#include <string.h>

bool ps_command_takes(const ps_command *command, ps_option_id id) {
    const ps_option *const option = &ps_options[id];
    return id == PS_OPTION_HELP || ((option->questions | option->commands) & command->takes) != 0;
}

const char *ps_command_words(const ps_command *command, ps_option_id id) {
    if (command->result != NULL) {
        return ps_kind_words(command->result, id);
    }
    if (command->verb != NULL) {
        return ps_verb_words(command->verb, id);
    }
    if (id == PS_OPTION_FORMAT && command->formats != NULL) {
        return command->formats;
    }
    return id == PS_OPTION_WEIGHTS && command->weights != NULL ? command->weights
                                                               : ps_options[id].metavar;
}

const char *ps_command_metavar(const ps_command *command, ps_option_id id) {
    enum { MOST_LETTERS = 40 };
    const char *const words = ps_command_words(command, id);
    return words != NULL && strlen(words) > MOST_LETTERS ? "NAME" : words;
}
