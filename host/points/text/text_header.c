#include "points/text/text_header.h"

#include "base/text.h"
#include "files/decimal.h"
#include "files/text_lines.h"
#include "points/text/text_fields.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

bool ps_text_header_is(const char *line, char separator) {
    ps_field token;
    bool is_more = true;
    unsigned num_names = 0;
    unsigned num_numbers = 0;
    unsigned num_empty = 0;
    unsigned num = 0;
    bool begins_empty = false;
    for (; ps_field_next(&line, separator, &is_more, &token); num++) {
        begins_empty = begins_empty || (num == 0 && token.length == 0);
        num_names += ps_field_is_name(token);
        num_numbers += ps_field_is_number(token);
        num_empty += token.length == 0;
    }
    /* ",0,1" are labels beside an index, which has none */
    return num_names + num_empty + (begins_empty ? num_numbers : 0) == num && num_empty < num &&
           num_names + num_numbers > 0;
}

char ps_text_header_separator(const char *names, const char *row, char otherwise) {
    enum { ARE_NAMES = 1 << 20, AGREE = 1 << 21, MOST = ARE_NAMES - 1 };
    static const char separators[] = {';', ',', '\t'};
    unsigned best = 0;
    for (size_t i = 0; i < sizeof separators; i++) {
        const unsigned num = ps_fields_count(names, separators[i]);
        const unsigned num_fields = ps_fields_count(row, separators[i]);
        const unsigned are_names = ps_text_header_is(names, separators[i]) ? ARE_NAMES : 0;
        const unsigned agree = num_fields == num || num_fields == num + 1 ? AGREE : 0;
        const unsigned score = (num < MOST ? num : MOST) + are_names + agree;
        if (num > 1 && score > best) {
            best = score;
            otherwise = separators[i];
        }
    }
    return otherwise;
}

char ps_text_header_line_separator(const ps_text_header *header, const char *line, char separator) {
    const bool has_tab = memchr(line, '\t', strcspn(line, "\n")) != NULL;
    return header->is_there && separator == ' ' && has_tab ? '\t' : separator;
}

bool ps_text_header_is_numbered(const char *line, char separator) {
    ps_field token;
    bool is_more = true;
    uint64_t value = 0;
    uint64_t num = 0;
    while (ps_field_next(&line, separator, &is_more, &token)) {
        if (!ps_field_is_whole(token, &value) || value != num++) {
            return false;
        }
    }
    return num > 0;
}

bool ps_text_header_is_decimal(const char *line, char separator) {
    ps_field token;
    bool is_more = true;
    while (ps_field_next(&line, separator, &is_more, &token)) {
        if (strcspn(token.text, ".eE\n") >= token.length) {
            return false;
        }
    }
    return true;
}

/* ---- which columns ----------------------------------------------------------------------- */

static bool is_unnamed(ps_field token) {
    static const char unnamed[] = "Unnamed: 0"; /* an index that was read and written again */
    return token.length == 0 || ps_field_is(token, unnamed, sizeof unnamed - 1);
}

/* The name says that it is no coordinate. */
static bool is_named_index(ps_field token) {
    static const char *const names[] = {"index", "id", "idx", "row"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        if (token.length == strlen(names[i]) &&
            strncasecmp(token.text, names[i], token.length) == 0) {
            return true;
        }
    }
    return false;
}

static bool is_index(ps_field token) {
    return is_unnamed(token) || is_named_index(token);
}

/* As many names as a sentence has room for, none of them cut. */
static void show_names(ps_text *out, const ps_field *names, unsigned num) {
    enum { MOST_BYTES = 300 };
    unsigned i = 0;
    for (; i < num && out->length + names[i].length < MOST_BYTES; i++) {
        ps_text_append(out, "%s\"%.*s\"", i > 0 ? ", " : "", (int)names[i].length, names[i].text);
    }
    ps_text_append(out, "%s", i == num ? "" : i > 0 ? ", and more" : "too long to be shown");
}

static pspec_status fail_name(const ps_field *names, unsigned num, const char *name, size_t length,
                              const ps_lines *lines, ps_error *error) {
    ps_text list = {0};
    show_names(&list, names, num);
    const pspec_status status =
        ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                "%s, line %zu: there is no column \"%.*s\", or it is named twice; the names are %s",
                lines->input->name, lines->line_number, (int)length, name, ps_text_string(&list));
    ps_text_free(&list);
    return status;
}

static void choose(ps_text_header *out, unsigned column, ps_field name) {
    const size_t used = strlen(out->used);
    out->places[column] = (short)out->num_chosen++;
    if (used + 1 + name.length < sizeof out->used) { /* no half characters */
        snprintf(out->used + used, sizeof out->used - used, "%s%.*s", used > 0 ? "," : "",
                 (int)name.length, name.text);
    }
}

/* The next of "x,y" or "ra,dec=lon-lat"; false behind the last. */
static bool next_wanted(const char **names, ps_field *out) {
    const char *const meaning = ps_columns_meaning(*names);
    const size_t left = meaning != NULL ? (size_t)(meaning - 1 - *names) : strlen(*names);
    const size_t before = strcspn(*names, ",");
    *out = (ps_field){.text = *names, .length = before < left ? before : left};
    *names += out->length + (out->length < left);
    return left > 0;
}

/* Where the name stands among others; num: it is none of them. */
static unsigned find_name(const ps_field *names, unsigned num, ps_field wanted) {
    unsigned found = 0;
    while (found < num && !ps_field_is(names[found], wanted.text, wanted.length)) {
        found++;
    }
    return found;
}

static pspec_status choose_named(ps_text_header *out, const ps_field *names, const char *wanted,
                                 const ps_lines *lines, ps_error *error) {
    ps_field name;
    while (next_wanted(&wanted, &name)) {
        const unsigned found = find_name(names, out->num_columns, name);
        if (found == out->num_columns || out->places[found] >= 0) {
            return fail_name(names, out->num_columns, name.text, name.length, lines, error);
        }
        choose(out, found, names[found]);
    }
    return PSPEC_OK;
}

/* "3,7": numbers of columns, which have names or none. */
static pspec_status choose_numbered(ps_text_header *out, const ps_field *names, const char *numbers,
                                    const ps_lines *lines, ps_error *error) {
    unsigned wanted[PS_MAX_COLUMNS];
    unsigned num = 0;
    ps_columns_numbers(numbers, wanted, PS_MAX_COLUMNS, &num);
    for (unsigned i = 0; i < num && i < PS_MAX_COLUMNS; i++) {
        char text[16];
        const ps_field shown = {.text = text,
                                .length = (size_t)snprintf(text, sizeof text, "%u", wanted[i])};
        if (wanted[i] > out->num_columns) {
            return ps_lines_fail(lines, error, "%u column%s, and --columns asks for %u",
                                 out->num_columns, out->num_columns == 1 ? "" : "s", wanted[i]);
        }
        if (out->places[wanted[i] - 1] >= 0) {
            return ps_lines_fail(lines, error, "--columns asks for column %u twice", wanted[i]);
        }
        choose(out, wanted[i] - 1, names != NULL ? names[wanted[i] - 1] : shown);
    }
    out->num_chosen = num;
    return PSPEC_OK;
}

/* Are all that are wanted names of columns? */
static bool are_among(const ps_field *names, unsigned num, const char *wanted) {
    ps_field name;
    bool are = true;
    while (are && next_wanted(&wanted, &name)) {
        are = find_name(names, num, name) < num;
    }
    return are;
}

const char *ps_text_header_meaning(ps_text_header *header) {
    bool are_swapped = false;
    const char *const layout = ps_columns_of_names(header->used, &are_swapped);
    for (unsigned i = 0; are_swapped && i < header->num_columns; i++) {
        const short place = header->places[i];
        header->places[i] = place == 0 ? 1 : place == 1 ? 0 : place;
        header->chooses = true;
    }
    return layout;
}

/* names[0] is empty where the header has a name less than rows have columns: an index. */
static pspec_status read_names(ps_text_header *out, ps_field names[PS_MOST_FILE_COLUMNS],
                               const char *line, unsigned num_fields, char separator,
                               const ps_lines *lines, ps_error *error) {
    const unsigned num_names = ps_fields_count(line, separator);
    const unsigned first = num_fields == num_names + 1 ? 1 : 0;
    bool is_more = true;
    if (num_fields > PS_MOST_FILE_COLUMNS || num_names + first != num_fields) {
        return ps_lines_fail(lines, error,
                             "%u names of columns, but the line after it has %u (at most %d)%s",
                             num_names, num_fields, PS_MOST_FILE_COLUMNS,
                             separator == ' ' ? "; text with blanks stands in quotes" : "");
    }
    names[0] = (ps_field){.text = line};
    out->lacks_name = first == 1;
    for (unsigned i = first; i < num_fields; i++) {
        ps_field_next(&line, separator, &is_more, &names[i]);
        if (!ps_field_is_printable(names[i])) {
            return ps_lines_fail(lines, error, "the name of column %u is no text", i + 1);
        }
    }
    out->num_columns = num_fields;
    return PSPEC_OK;
}

static bool ends_empty(const char *row, char separator) {
    ps_field field = {.text = row};
    bool is_more = true;
    while (ps_field_next(&row, separator, &is_more, &field)) {
    }
    return field.length == 0 && !field.is_quoted;
}

/* Where rows have a field more than there are names: is it the first name that is missing, and
 * neither a separator at the end of rows, nor text that blanks parted, nor the name of a last
 * column? names[0] is that of the missing one. */
static bool lacks_first(const ps_text_header *header, const ps_field *names, const char *line,
                        const char *row, char separator) {
    ps_field first;
    ps_field field;
    bool is_more = true;
    unsigned num_texts = 0;
    unsigned num_quoted = 0;
    if (is_named_index(names[1]) || ends_empty(row, separator)) {
        return false;
    }
    ps_field_next(&row, separator, &is_more, &first);
    while (ps_field_next(&row, separator, &is_more, &field)) {
        num_texts += !field.is_quoted && !ps_field_is_number(field);
        num_quoted += field.is_quoted;
    }
    const bool is_quoted = first.is_quoted && num_quoted < header->num_columns - 1;
    const bool has_place = *line == ' ' || !ps_field_is_number(first); /* as pandas prints it */
    return is_quoted || header->places[1] >= 0 || (has_place && num_texts == 0);
}

/* What the names have in common at the beginning, or at the end. */
static size_t common_length(const ps_field *names, unsigned num, bool at_end) {
    size_t common = names[0].length;
    for (unsigned i = 1; i < num; i++) {
        size_t length = 0;
        while (length < common && length < names[i].length &&
               (at_end ? names[0].text[names[0].length - 1 - length] ==
                             names[i].text[names[i].length - 1 - length]
                       : names[0].text[length] == names[i].text[length])) {
            length++;
        }
        common = length;
    }
    return common;
}

/* Do the names count, by a number ("x1", "x2") or by a letter ("px", "py"), with the same text
 * around it? "w" is the name of weights. */
static bool are_similar(const ps_field *names, unsigned num) {
    const size_t before = num > 0 ? common_length(names, num, false) : 0;
    const size_t after = num > 0 ? common_length(names, num, true) : 0;
    uint64_t first = 0;
    bool are = true;
    for (unsigned i = 0; num > 1 && i < num; i++) {
        if (names[i].length <= before + after) {
            return false;
        }
        const ps_field middle = {.text = names[i].text + before,
                                 .length = names[i].length - before - after};
        const bool is_letter = middle.length == 1 && isalpha((unsigned char)middle.text[0]) != 0;
        uint64_t value = is_letter ? (unsigned char)middle.text[0] : 0;
        are = are && (is_letter || ps_field_is_whole(middle, &value));
        first = i == 0 ? value : first;
        are = are && value == first + i;
    }
    return are && !(num > 1 && ps_field_is(names[num - 1], "w", 1));
}

static pspec_status check_chosen(ps_text_header *out, const ps_lines *lines, ps_error *error) {
    out->chooses = out->num_chosen < out->num_columns;
    for (unsigned i = 0; i < out->num_columns; i++) {
        out->chooses = out->chooses || out->places[i] != (short)i;
    }
    return out->num_chosen > 0 && out->num_chosen <= PS_MAX_COLUMNS
               ? PSPEC_OK
               : ps_lines_fail(
                     lines, error,
                     "%u columns; at most %d dimensions are read (--columns chooses among "
                     "them by name or number, as in 1,2)",
                     out->num_chosen, PS_MAX_DIMENSION);
}

pspec_status ps_text_header_read(ps_text_header *out, const char *line, const char *row,
                                 char separator, const ps_text_choice *choice,
                                 const ps_lines *lines, ps_error *error) {
    const char *const names = choice->names;
    const char *const select = choice->select;
    ps_field found[PS_MOST_FILE_COLUMNS];
    *out = (ps_text_header){.is_there = true};
    PS_TRY(ps_row_filter_find(&out->filter, line, separator, choice, lines, error));
    const char part = ps_text_header_line_separator(out, row, separator);
    PS_TRY(read_names(out, found, line, ps_fields_count(row, part), separator, lines, error));
    out->filter.column += out->lacks_name; /* names begin with the second column */
    for (unsigned i = 0; i < out->num_columns; i++) {
        out->places[i] = -1;
    }
    const bool is_chosen_by_number = names != NULL && !are_among(found, out->num_columns, names) &&
                                     ps_columns_are_numbers(names);
    if (is_chosen_by_number) {
        /* which names are theirs is not clear where one is missing */
        PS_TRY(choose_numbered(out, out->lacks_name ? NULL : found, names, lines, error));
    } else if (names != NULL) {
        PS_TRY(choose_named(out, found, names, lines, error));
    }
    const bool is_end_empty = ends_empty(row, part); /* separators after the last column */
    for (unsigned i = 0; names == NULL && i < out->num_columns; i++) {
        const bool is_selected =
            select != NULL && ps_field_is(found[i], select, strcspn(select, "="));
        const bool is_end = i + 1 == out->num_columns && found[i].length == 0 && is_end_empty;
        if (!is_selected && !is_end && (i > 0 || out->num_columns == 1 || !is_index(found[i]))) {
            choose(out, i, found[i]);
        }
    }
    if (out->lacks_name && !is_chosen_by_number && !lacks_first(out, found, line, row, part)) {
        return ps_lines_fail(
            lines, error,
            "%u names of columns, and the row after has %u; nothing says that it is the "
            "first that has no name (--columns chooses by number, as in 1,2)",
            out->num_columns - 1, out->num_columns);
    }
    /* Where a name is missing, those that are wanted may be the names of other columns. */
    out->has_index = out->places[0] < 0 && is_unnamed(found[0]) && !is_chosen_by_number &&
                     (names == NULL || out->lacks_name);
    out->are_similar = are_similar(found + (out->places[0] < 0), out->num_chosen);
    return check_chosen(out, lines, error);
}

pspec_status ps_text_header_choose(ps_text_header *out, const char *row, char separator,
                                   const char *numbers, const ps_lines *lines, ps_error *error) {
    *out = (ps_text_header){.num_columns = ps_fields_count(row, separator)};
    if (out->num_columns > PS_MOST_FILE_COLUMNS) {
        return ps_lines_fail(lines, error, "%u columns; at most %d are chosen among",
                             out->num_columns, PS_MOST_FILE_COLUMNS);
    }
    for (unsigned i = 0; i < out->num_columns; i++) {
        out->places[i] = numbers != NULL ? -1 : (short)i;
    }
    out->num_chosen = out->num_columns;
    if (numbers != NULL) {
        out->num_chosen = 0;
        PS_TRY(choose_numbered(out, NULL, numbers, lines, error));
    }
    PS_TRY(check_chosen(out, lines, error));
    out->chooses = true; /* by fields, also where they are all there */
    return PSPEC_OK;
}
