/* Rows of which some fields are the columns that are read. */
#include "base/text.h"
#include "files/decimal.h"
#include "files/text_lines.h"
#include "points/text/text_fields.h"
#include "points/text/text_header.h"

#include <stdio.h>
#include <string.h>

/* ---- --select ---------------------------------------------------------------------------- */

static void set_value(ps_row_filter *out, const char *value) {
    enum { NUMBER_BYTES = 64 };
    char own[NUMBER_BYTES + PS_DECIMAL_PADDING] = "";
    const size_t length = strlen(value);
    out->value = value;
    if (length < NUMBER_BYTES) {
        memcpy(own, value, length);
        out->is_number = ps_decimal_parse(own, &out->number) == own + length;
    }
}

pspec_status ps_row_filter_find(ps_row_filter *out, const char *names, char separator,
                                const ps_text_choice *choice, const ps_lines *lines,
                                ps_error *error) {
    const char *const select = choice->select;
    *out = (ps_row_filter){0};
    if (select == NULL) {
        return PSPEC_OK;
    }
    const size_t length = strcspn(select, "=");
    int column = ps_field_find(names, separator, select, length);
    const bool is_known =
        strncmp(select, "type=", length + 1) == 0 || strncmp(select, "element=", length + 1) == 0;
    if (column < 0 && is_known && choice->alias != NULL) {
        column = ps_field_find(names, separator, choice->alias, strlen(choice->alias));
    }
    if (column < 0) {
        char shown[PS_TOKEN_BYTES];
        return ps_lines_fail(lines, error, "--select %s, and the columns are \"%s\"", select,
                             ps_token_show(shown, names, strcspn(names, "\r\n")));
    }
    set_value(out, select + length + 1);
    out->column = (unsigned)column;
    return PSPEC_OK;
}

static bool takes_field(const ps_row_filter *filter, ps_field field) {
    double number = 0;
    return ps_field_is(field, filter->value, strlen(filter->value)) ||
           (filter->is_number && field.length > 0 &&
            ps_decimal_parse(field.text, &number) == field.text + field.length &&
            number == filter->number);
}

bool ps_row_filter_takes_number(const ps_row_filter *filter, double number, bool is_single) {
    return filter->value == NULL ||
           (filter->is_number &&
            number == (is_single ? (double)(float)filter->number : filter->number));
}

/* ---- rows -------------------------------------------------------------------------------- */

/* What the index is after this row, whose first field it is; false: it is none. Quotes make text of
 * numbers only where others have none. */
static bool next_index(ps_row_index *index, ps_field token, bool are_all_quoted) {
    uint64_t value = 0;
    const bool is_text = token.length > 0 && !ps_field_is_not_finite(token) &&
                         (!ps_field_is_number(token) || (token.is_quoted && !are_all_quoted));
    if (index->kind == PS_INDEX_UNKNOWN) {
        index->kind = is_text ? PS_INDEX_TEXT : PS_INDEX_NUMBERS;
        index->may_restart = true;
    }
    if (index->kind == PS_INDEX_TEXT) {
        return is_text;
    }
    if (!ps_field_is_whole(token, &value) ||
        !(value == index->next || (index->may_restart && value <= 1))) {
        return false;
    }
    index->next = value + 1;
    index->may_restart = false;
    return true;
}

const char *ps_text_header_row(ps_text_header *header, const char *line, char separator,
                               double *row, bool *is_taken) {
    ps_field token;
    bool is_more = true;
    unsigned column = 0;
    ps_row_index index = header->index;
    *is_taken = true;
    while (ps_field_next(&line, separator, &is_more, &token)) {
        if (column >= header->num_columns) {
            return NULL;
        }
        if (header->filter.value != NULL && column == header->filter.column) {
            *is_taken = takes_field(&header->filter, token);
        }
        if (column == 0 && header->has_index &&
            !next_index(&index, token, *ps_skip_blanks(line) == '"')) {
            return NULL;
        }
        const short place = header->places[column++];
        if (place >= 0 && (token.length == 0 || ps_decimal_parse(token.text, &row[place]) !=
                                                    token.text + token.length)) {
            return NULL;
        }
    }
    line += *line == '\r';
    if (column != header->num_columns || *line != '\n') {
        return NULL;
    }
    header->index = index;
    return line;
}

static pspec_status refuse_index(const ps_text_header *header, ps_field token,
                                 const ps_lines *lines, ps_error *error) {
    char shown[PS_TOKEN_BYTES];
    char advice[PS_TOKEN_BYTES];
    snprintf(advice, sizeof advice, "the header names %u of %u columns; it must name all",
             header->num_columns - 1, header->num_columns);
    return ps_lines_fail(
        lines, error,
        "\"%s\" in a column without a name, which is no index (text, or the rows "
        "counted from 0 or 1 on); %s",
        ps_token_show(shown, token.text, token.length),
        header->lacks_name ? advice : "--columns with names, as in x,y, passes over others");
}

pspec_status ps_text_header_refuse(const ps_text_header *header, const char *line, char separator,
                                   const ps_lines *lines, ps_error *error) {
    const unsigned num = ps_fields_count(line, separator);
    char shown[PS_TOKEN_BYTES];
    ps_field token;
    bool is_more = true;
    ps_row_index index = header->index;
    if (num != header->num_columns) {
        return ps_lines_fail(lines, error, "%u column%s, where the %s %u", num, num == 1 ? "" : "s",
                             header->is_there ? "header names" : "first row has",
                             header->num_columns);
    }
    for (unsigned i = 0; i < num; i++) {
        ps_field_next(&line, separator, &is_more, &token);
        if (i == 0 && header->has_index &&
            !next_index(&index, token, *ps_skip_blanks(line) == '"')) {
            return refuse_index(header, token, lines, error);
        }
        if (header->places[i] >= 0 && !ps_field_is_number(token)) {
            break;
        }
    }
    return ps_lines_fail(lines, error, "\"%s\" is not a %snumber",
                         ps_token_show(shown, token.text, token.length),
                         ps_field_is_not_finite(token) ? "finite " : "");
}
