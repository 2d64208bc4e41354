/* Words of the command line -> ps_request, by the table of options. */
#include "answers/arguments.h"

#include "base/text.h"
#include "request/options.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct parser {
    const ps_command *command;
    ps_request *arguments;
    char **words;
    int num_words, next; /* next: the first word that has not been looked at */
    ps_error *error;
} parser;

/* An option as it stands on the command line, "--points" of "--points=5". */
typedef struct shown_option {
    const char *text;
    int length;
} shown_option;

/* ---- what commands take ---------------------------------------------------------------------- */

const char *ps_command_words(const ps_command *command, ps_option_id id) {
    const char *const own = id == PS_OPTION_FORMAT    ? command->formats
                            : id == PS_OPTION_WEIGHTS ? command->weights
                                                      : NULL;
    if (id == PS_OPTION_FORMAT && own == NULL) {
        return ps_table_formats(command->has_words, command->has_late_rows);
    }
    return own != NULL ? own : ps_options[id].metavar;
}

const ps_command *ps_command_nearest(const ps_command *const *table, const char *name,
                                     size_t *distance) {
    const ps_command *nearest = NULL;
    *distance = SIZE_MAX;
    for (size_t i = 0; table[i] != NULL; i++) {
        const size_t own = ps_name_distance(name, table[i]->name);
        if (own < *distance) {
            *distance = own;
            nearest = table[i];
        }
    }
    return nearest;
}

const char *ps_command_metavar(const ps_command *command, ps_option_id id) {
    enum { MOST_LETTERS = 40 };
    const char *const words = ps_command_words(command, id);
    return words != NULL && strlen(words) > MOST_LETTERS ? "NAME" : words;
}

/* ---- what is wrong ------------------------------------------------------------------------- */

/* The option of the command that is nearest to a name without dashes. One letter may also be that
 * of an option in the other case. */
static ps_option_id find_nearest(const ps_command *command, const char *name, size_t *best) {
    ps_option_id nearest = PS_OPTION_HELP;
    *best = SIZE_MAX;
    for (int id = 0; id < PS_NUM_OPTIONS; id++) {
        if (!ps_command_takes(command, (ps_option_id)id)) {
            continue;
        }
        const bool is_letter =
            strlen(name) == 1 && tolower((unsigned char)name[0]) == ps_options[id].letter;
        const size_t distance = is_letter ? 0 : ps_name_distance(name, ps_options[id].name);
        if (distance < *best) {
            *best = distance;
            nearest = (ps_option_id)id;
        }
    }
    return nearest;
}

/* Options of versions before. */
static const char *find_former(const char *name) {
    static const char *const names[][2] = {{"shells", "--bins shells"}};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        if (strcmp(name, names[i][0]) == 0) {
            return names[i][1];
        }
    }
    return NULL;
}

/* name: without dashes and value. is_known: some other command has that option. */
static pspec_status fail_option(const parser *p, shown_option shown, const char *name,
                                bool is_known) {
    size_t distance = 0;
    const char *const former = find_former(name);
    if (former != NULL) {
        return ps_fail(p->error, PSPEC_ERROR_INVALID_ARGUMENT, "unknown option %.*s; it is %s now",
                       shown.length, shown.text, former);
    }
    const ps_option *const nearest = &ps_options[find_nearest(p->command, name, &distance)];
    const char letter[] = {nearest->letter, '\0'};
    const bool has_letter = strlen(name) == 1 && nearest->letter == tolower((unsigned char)name[0]);
    const char *const before = has_letter ? "-" : "--";
    char begin[32];
    snprintf(begin, sizeof begin, "%s%s", is_known ? "; the nearest is " : "; did you mean ",
             before);
    return ps_fail(p->error, PSPEC_ERROR_INVALID_ARGUMENT,
                   is_known ? "%.*s is not an option of this command%s" : "unknown option %.*s%s",
                   shown.length, shown.text,
                   ps_text_suggest(name, has_letter ? letter : nearest->name, distance, begin,
                                   is_known ? "" : "?")
                       .text);
}

/* Does the word look like an option? Numbers, also several with commas, and "-" do not. */
static bool is_option_like(const char *word) {
    char *end = NULL;
    if (word[0] != '-' || word[1] == '\0') {
        return false;
    }
    (void)strtod(word, &end);
    return end == word || (*end != '\0' && *end != ',');
}

/* ---- one option ---------------------------------------------------------------------------- */

/* The next word as the value of an option. --output=--odd is the way to a value that looks like an
 * option. */
static pspec_status take_value(parser *p, ps_option_id id, shown_option shown, const char **value) {
    const char *const metavar = ps_command_metavar(p->command, id);
    if (p->next == p->num_words) {
        return ps_fail(p->error, PSPEC_ERROR_INVALID_ARGUMENT, "%.*s needs a value: %.*s %s",
                       shown.length, shown.text, shown.length, shown.text, metavar);
    }
    if (is_option_like(p->words[p->next])) {
        return ps_fail(p->error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%.*s needs a value: %.*s %s, but the option %s follows", shown.length,
                       shown.text, shown.length, shown.text, metavar, p->words[p->next]);
    }
    *value = p->words[p->next++];
    return PSPEC_OK;
}

/* value: what is attached to the option, or NULL. */
static pspec_status apply(parser *p, ps_option_id id, shown_option shown, const char *value) {
    const ps_option *const option = &ps_options[id];
    if (option->metavar == NULL && value != NULL) {
        return ps_fail(p->error, PSPEC_ERROR_INVALID_ARGUMENT, "%.*s takes no value", shown.length,
                       shown.text);
    }
    if (option->metavar != NULL && value == NULL) {
        PS_TRY(take_value(p, id, shown, &value));
    }
    p->arguments->is_given[id] = true;
    p->arguments->forms[id] = shown.text[1] == '-' ? PS_FORM_LONG : PS_FORM_LETTER;
    return ps_option_set(p->arguments, id, ps_command_words(p->command, id), value, p->error);
}

static bool has_name(ps_option_id id, const char *name, size_t length) {
    return strlen(ps_options[id].name) == length && strncmp(ps_options[id].name, name, length) == 0;
}

/* "--name" or "--name=value" */
static pspec_status parse_long(parser *p, char *word) {
    char *const name = word + 2;
    const size_t length = strcspn(name, "=");
    const char *const value = name[length] == '=' ? name + length + 1 : NULL;
    const shown_option shown = {word, (int)length + 2};
    int id = 0;
    while (id < PS_NUM_OPTIONS && !has_name((ps_option_id)id, name, length)) {
        id++;
    }
    if (id < PS_NUM_OPTIONS && ps_command_takes(p->command, (ps_option_id)id)) {
        return apply(p, (ps_option_id)id, shown, value);
    }
    name[length] = '\0'; /* the words are ours to change, and this one is done with */
    return fail_option(p, shown, name, id < PS_NUM_OPTIONS);
}

/* "-n" or "-nvalue" */
static pspec_status parse_short(parser *p, const char *word) {
    const shown_option shown = {word, 2};
    int id = 0;
    while (id < PS_NUM_OPTIONS && ps_options[id].letter != word[1]) {
        id++;
    }
    if (id < PS_NUM_OPTIONS && ps_command_takes(p->command, (ps_option_id)id)) {
        return apply(p, (ps_option_id)id, shown, word[2] != '\0' ? word + 2 : NULL);
    }
    const shown_option whole = {word, (int)strlen(word)};
    return id < PS_NUM_OPTIONS ? fail_option(p, shown, ps_options[id].name, true)
                               : fail_option(p, whole, word + 1, false);
}

/* ---- the whole line ------------------------------------------------------------------------ */

static pspec_status parse_word(parser *p, bool *is_over) {
    char *const word = p->words[p->next++];
    if (*is_over || word[0] != '-' || word[1] == '\0') {
        p->arguments->files[p->arguments->num_files++] = word;
        return PSPEC_OK;
    }
    if (strcmp(word, "--") == 0) {
        *is_over = true;
        return PSPEC_OK;
    }
    return word[1] == '-' ? parse_long(p, word) : parse_short(p, word);
}

static pspec_status count_standard_input(void *payload, const ps_request_file *input,
                                         ps_error *error) {
    size_t *const num = payload;
    (void)error;
    *num += strcmp(input->path, "-") == 0;
    return PSPEC_OK;
}

/* Whatever reads it first leaves nothing for the second. */
static pspec_status check_standard_input(const ps_request *arguments, ps_error *error) {
    size_t num = 0;
    PS_TRY(ps_request_visit_inputs(arguments, count_standard_input, &num, error));
    return num <= 1 ? PSPEC_OK
                    : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                              "standard input (-) is named %zu times, but can be read once", num);
}

pspec_status ps_arguments_parse(ps_request *arguments, const ps_command *command, int num_words,
                                char **words, ps_error *error) {
    *arguments = ps_request_default;
    PS_TRY(PS_NEW(&arguments->files, (size_t)num_words, "names of files", error));
    parser p = {command, arguments, words, num_words, 0, error};
    bool is_over = false;
    while (p.next < num_words && !arguments->is_given[PS_OPTION_HELP]) {
        PS_TRY(parse_word(&p, &is_over));
    }
    return arguments->is_given[PS_OPTION_HELP] ? PSPEC_OK : check_standard_input(arguments, error);
}

void ps_arguments_free(ps_request *arguments) {
    free(arguments->files);
    arguments->files = NULL;
    arguments->num_files = 0;
}

/* ---- a line that was kept -------------------------------------------------------------------- */

bool ps_command_next_word(const char **at, const char **word, size_t *length) {
    bool is_quoted = false;
    const char *end = *at + strspn(*at, " ");
    *word = end;
    for (; *end != '\0' && (is_quoted || *end != ' '); end++) {
        is_quoted = is_quoted != (*end == '\'');
        end += *end == '\\' && !is_quoted && end[1] != '\0';
    }
    *length = (size_t)(end - *word);
    *at = end;
    return *length > 0;
}

/* What the quotes of a word mean; returns its end in `out`. */
static char *unquote(char *out, const char *word, size_t length) {
    bool is_quoted = false;
    for (size_t i = 0; i < length; i++) {
        if (word[i] == '\'') {
            is_quoted = !is_quoted;
        } else {
            i += word[i] == '\\' && !is_quoted && i + 1 < length;
            *out++ = word[i];
        }
    }
    *out++ = '\0';
    return out;
}

pspec_status ps_command_split(char ***out, int *num, ps_pool *memory, const char *line,
                              ps_error *error) {
    const size_t most = strlen(line) / 2 + 1; /* words have a blank between them */
    const char *word = NULL;
    char *next = NULL;
    size_t length = 0;
    *num = 0;
    PS_TRY(PS_POOL_NEW(memory, out, most, "words", error));
    PS_TRY(PS_POOL_NEW(memory, &next, strlen(line) + 1, "words", error));
    while (ps_command_next_word(&line, &word, &length)) {
        (*out)[(*num)++] = next;
        next = unquote(next, word, length);
    }
    return PSPEC_OK;
}
