/* The table of commands. */
#include "base/text.h"
#include "cli/command.h"

#include "request/options.h"

#include <string.h>

const ps_command *const ps_commands[] = {
    PS_COMMANDS(PS_KIND_OF, PS_COMMAND_OF, PS_COMMAND_OF, PS_COMMAND_OF) NULL};

const ps_command *ps_command_find(const char *name, ps_error *error) {
    size_t distance = 0;
    const ps_command *const nearest = ps_command_nearest(ps_commands, name, &distance);
    if (distance == 0) {
        return nearest;
    }
    ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "unknown command \"%s\"%s", name,
            ps_text_suggest(name, nearest->name, distance, "; did you mean ", "?").text);
    return NULL;
}

int ps_exit_code(pspec_status status) {
    switch (status) {
    case PSPEC_OK:
        return PS_EXIT_DONE;
    case PSPEC_ERROR_INVALID_ARGUMENT:
    case PSPEC_ERROR_INPUT:
        return PS_EXIT_USAGE;
    case PSPEC_ERROR_TOLERANCE:
    case PSPEC_ERROR_CHECK:
        return PS_EXIT_CHECK;
    case PSPEC_ERROR_CANCELLED:
        return PS_EXIT_INTERRUPTED;
    case PSPEC_ERROR_IO:
    case PSPEC_ERROR_MEMORY:
    case PSPEC_ERROR_NO_DEVICE:
    case PSPEC_ERROR_DEVICE:
    case PSPEC_ERROR_BUILD:
        break;
    }
    return PS_EXIT_FAILED;
}
