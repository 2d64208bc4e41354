/* The table of commands. */
#include "base/text.h"
#include "cli/command.h"

#include "request/options.h"

#include <string.h>

/* In the order of --help. A new command is a file, a name in request/options.h, and the rows of
 * its options. */
#define COMMAND(name) &ps_command_##name,
const ps_command *const ps_commands[] = {PS_VERBS(COMMAND, COMMAND) NULL};

const ps_command *ps_command_find(const char *name, ps_error *error) {
    const ps_command *nearest = NULL;
    size_t best = SIZE_MAX;
    for (size_t i = 0; ps_commands[i] != NULL; i++) {
        const size_t distance = ps_name_distance(name, ps_commands[i]->name);
        if (distance < best) {
            best = distance;
            nearest = ps_commands[i];
        }
    }
    if (best == 0) {
        return nearest;
    }
    ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "unknown command \"%s\"%s", name,
            nearest != NULL
                ? ps_text_suggest(name, nearest->name, best, "; did you mean ", "?").text
                : "");
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
