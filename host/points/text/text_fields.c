#include "points/text/text_fields.h"

#include "base/text.h"
#include "files/decimal.h"
#include "files/text_lines.h"

#include <ctype.h>
#include <string.h>

/* Tabs are blanks, unless they part fields. */
static const char *skip_blanks(const char *text, char separator) {
    while (*text == ' ' || (*text == '\t' && separator != '\t')) {
        text++;
    }
    return text;
}

static bool ends_field(const char *text, char separator) {
    return ps_ends_line(text) || *text == separator || (separator == ' ' && *text == '\t');
}

/* The quote that closes the field, which two of them do not, or the end of the line. */
static const char *find_quote(const char *text) {
    while (!ps_ends_line(text) && (*text != '"' || text[1] == '"')) {
        text += *text == '"' ? 2 : 1;
    }
    return text;
}

bool ps_field_next(const char **text, char separator, bool *is_more, ps_field *out) {
    const char *at = skip_blanks(*text, separator);
    if (ps_ends_line(at) && (separator == ' ' || !*is_more)) {
        return false;
    }
    out->is_quoted = *at == '"';
    out->text = at + out->is_quoted;
    at = out->is_quoted ? find_quote(out->text) : at;
    out->is_open = out->is_quoted && *at != '"';
    out->length = (size_t)(at - out->text);
    const char *const after = at + (out->is_quoted && !out->is_open);
    at = skip_blanks(after, separator);
    /* Behind quotes only a separator is right: with anything else it is no name and no number. */
    if (!out->is_quoted || (!ends_field(at, separator) && (separator != ' ' || at == after))) {
        while (!ends_field(at, separator)) {
            at++;
        }
        out->length = (size_t)(at - out->text);
    }
    while (!out->is_quoted && out->length > 0 &&
           strchr(" \t", out->text[out->length - 1]) != NULL) {
        out->length--;
    }
    at = skip_blanks(at, separator);
    *is_more = separator != ' ' && *at == separator;
    *text = at + *is_more;
    return true;
}

bool ps_field_is(ps_field field, const char *name, size_t length) {
    size_t num = 0;
    for (size_t i = 0; i < field.length; i++, num++) {
        if (num == length || field.text[i] != name[num]) {
            return false;
        }
        i += field.is_quoted && field.text[i] == '"'; /* two stand for one */
    }
    return num == length;
}

bool ps_field_is_number(ps_field token) {
    double value = 0;
    return token.length > 0 && ps_decimal_parse(token.text, &value) == token.text + token.length;
}

bool ps_field_is_not_finite(ps_field token) {
    return ps_token_is_not_finite(token.text, token.length);
}

bool ps_field_is_printable(ps_field token) {
    size_t i = 0;
    size_t bytes = 1;
    while (i < token.length && bytes > 0) {
        bytes = ps_text_character(token.text + i);
        i += bytes;
    }
    return bytes > 0;
}

bool ps_field_is_name(ps_field token) {
    const unsigned char first = token.length > 0 ? (unsigned char)token.text[0] : 0;
    const unsigned char beyond_ascii = 0x80;
    return ps_field_is_printable(token) &&
           (isalpha(first) != 0 || first == '_' || first >= beyond_ascii) &&
           !ps_field_is_not_finite(token);
}

bool ps_field_is_whole(ps_field token, uint64_t *out) {
    enum { MOST_DIGITS = 18 };
    *out = 0;
    for (size_t i = 0; i < token.length; i++) {
        if (isdigit((unsigned char)token.text[i]) == 0) {
            return false;
        }
        *out = *out * 10 + (uint64_t)(token.text[i] - '0');
    }
    return token.length > 0 && token.length <= MOST_DIGITS;
}

unsigned ps_fields_count(const char *line, char separator) {
    ps_field token;
    bool is_more = true;
    unsigned num = 0;
    while (ps_field_next(&line, separator, &is_more, &token)) {
        num++;
    }
    return num;
}

int ps_field_find(const char *names, char separator, const char *name, size_t length) {
    ps_field field;
    bool is_more = true;
    for (int i = 0; ps_field_next(&names, separator, &is_more, &field); i++) {
        if (ps_field_is(field, name, length)) {
            return i;
        }
    }
    return -1;
}
