#include "request/option_help.h"

#include "request/option_setters.h"

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

/* ---- facts ------------------------------------------------------------------------------- */

/* Setters tell what a value is. Those of one of several words, and of texts with rules of their
 * own, are told by the words that they admit. */
static const char *find_type(const ps_option *option, const char *words) {
    static const struct {
        ps_option_setter *set;
        const char *type;
    } types[] = {{ps_set_flag, "flag"},          {ps_set_nothing, "flag"},
                 {ps_set_points, "integers"},    {ps_set_count, "integer"},
                 {ps_set_dimension, "integer"},  {ps_set_max_frequency, "integer"},
                 {ps_set_max_degree, "integer"}, {ps_set_positive, "number"},
                 {ps_set_share, "number"},       {ps_set_false_alarm_rate, "number"},
                 {ps_set_smoothness, "number"},  {ps_set_columns, "text"}};
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++) {
        if (types[i].set == option->set) {
            return types[i].type;
        }
    }
    const bool has_names = words[strcspn(words, "ABCDEFGHIJKLMNOPQRSTUVWXYZ=")] != '\0';
    return strchr(words, '|') != NULL && !has_names ? "word" : "text";
}

static bool is_repeatable(const ps_option *option) {
    return option->offset_of_number > 0 || option->set == ps_add_sampler ||
           option->set == ps_add_set || option->set == ps_set_bounds;
}

/* What stands in "(default X)", "(default: X; and more)" or before ", the default)"; X may have
 * parentheses. */
static void copy_default(char out[PS_OPTION_HELP_BYTES], const char *help) {
    static const char word[] = "(default";
    const char *const found = strstr(help, word);
    out[0] = '\0';
    if (found == NULL) {
        return;
    }
    const char *const begin = found + strlen(word) + strspn(found + strlen(word), ": ");
    size_t length = 0;
    for (int depth = 1; begin[length] != '\0'; length++) {
        depth += (begin[length] == '(') - (begin[length] == ')');
        if (depth == 0 || (depth == 1 && begin[length] == ';')) {
            break;
        }
    }
    snprintf(out, PS_OPTION_HELP_BYTES, "%.*s", (int)length, begin);
}

void ps_option_find_facts(ps_option_facts *out, ps_option_id id, const char *words,
                          const char *help) {
    const ps_option *const option = &ps_options[id];
    const bool is_size =
        words != NULL && (strcmp(words, "SIZE") == 0 || strcmp(words, "BYTES") == 0);
    *out = (ps_option_facts){.type = find_type(option, words),
                             .unit = is_size ? "bytes" : "",
                             .file = option->is_output       ? "written"
                                     : option->input != NULL ? "read"
                                                             : "",
                             .is_repeatable = is_repeatable(option)};
    copy_default(out->initial, help);
}
