#include "request/option_help.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

/* Is the command among the names of a part, "pairs,quadrature:of Q(l)}", or has it none? */
static bool is_for(const char *part, const char *command) {
    const size_t length = strlen(command);
    while (*part != ':') {
        const size_t name = strcspn(part, ",:");
        if (name == length && strncmp(part, command, length) == 0) {
            return true;
        }
        part += name + (part[name] == ',');
        if (*part == ':') {
            return false;
        }
    }
    return true;
}

void ps_option_help(char out[PS_OPTION_HELP_BYTES], const char *help, const char *command) {
    size_t used = 0;
    bool is_told = false; /* one of the parts that touch */
    out[0] = '\0';
    while (*help != '\0' && used < PS_OPTION_HELP_BYTES - 1) {
        const bool is_part = *help == '{';
        const char *const text = is_part ? strchr(help, ':') + 1 : help;
        const size_t length = strcspn(text, is_part ? "}" : "{");
        const bool tells = !is_part || (!is_told && is_for(help + 1, command));
        if (tells) {
            used += (size_t)snprintf(out + used, PS_OPTION_HELP_BYTES - used, "%.*s", (int)length,
                                     text);
        }
        is_told = is_part && (is_told || tells);
        help = text + length + is_part;
    }
}
