/* Words of a command line. */
#ifndef PS_ANSWERS_ARGUMENTS_H
#define PS_ANSWERS_ARGUMENTS_H

#include "answers/kind.h"
#include "base/memory.h"

/* What stands after the option in usage and help: these values, or NAME when they are too many for
 * a line; NULL for a flag. */
const char *ps_command_metavar(const ps_command *command, ps_option_id id);

/* Parses the words after the command's name, which outlive the request. Options and files may be
 * mixed; "--" ends the options, "-" is a file. --name value, --name=value, -n value, -nvalue; an
 * option given again replaces what it said before, but --sampler adds. Errors name the nearest
 * option that the command takes. --help ends the parsing: see is_given[PS_OPTION_HELP]. Call
 * ps_arguments_free also after an error. */
pspec_status ps_arguments_parse(ps_request *arguments, const ps_command *command, int num_words,
                                char **words, ps_error *error) PS_MUST_CHECK;
void ps_arguments_free(ps_request *arguments);

/* The next word of a line, as the shell takes it, from *at on, and where it ends; false: none. */
bool ps_command_next_word(const char **at, const char **word, size_t *length);
/* All of them, which ps_arguments_parse may change, with memory of the pool. */
pspec_status ps_command_split(char ***out, int *num, ps_pool *memory, const char *line,
                              ps_error *error) PS_MUST_CHECK;

#endif
