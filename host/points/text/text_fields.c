#include "points/text/text_fields.h"

#include "base/text.h"
#include "files/decimal.h"
#include "files/text_lines.h"

#include <ctype.h>
#include <string.h>

static bool ends_field(const char *text, char separator, bool is_quoted) {
    if (ps_ends_line(text) || *text == '\n') {
        return true;
    }
    return is_quoted ? *text == '"' : *text == separator || (separator == ' ' && *text == '\t');
}

bool ps_field_next(const char **text, char separator, bool *is_more, ps_field *out) {
    const char *at = ps_skip_blanks(*text);
    if (ps_ends_line(at) && (separator == ' ' || !*is_more)) {
        return false;
    }
    out->is_quoted = *at == '"';
    at += out->is_quoted;
    out->text = at;
    while (!ends_field(at, separator, out->is_quoted)) {
        at++;
    }
    out->length = (size_t)(at - out->text);
    while (!out->is_quoted && out->length > 0 &&
           strchr(" \t", out->text[out->length - 1]) != NULL) {
        out->length--;
    }
    at = ps_skip_blanks(at + (out->is_quoted && *at == '"'));
    *is_more = separator != ' ' && *at == separator;
    *text = at + *is_more;
    return true;
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
        if (field.length == length && strncmp(field.text, name, length) == 0) {
            return i;
        }
    }
    return -1;
}
