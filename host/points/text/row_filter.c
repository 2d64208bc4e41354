#include "points/text/row_filter.h"

#include "files/decimal.h"
#include "files/text_lines.h"
#include "points/text/text_fields.h"

#include <string.h>

size_t ps_row_filter_name(const char *select) {
    return select != NULL ? strcspn(select, "=") : 0;
}

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

pspec_status ps_row_filter_find(ps_row_filter *out, const char *select, const char *names,
                                char separator, const char *alias, const char *where,
                                ps_error *error) {
    const size_t length = ps_row_filter_name(select);
    *out = (ps_row_filter){0};
    if (select == NULL) {
        return PSPEC_OK;
    }
    int column = ps_field_find(names, separator, select, length);
    const bool is_known =
        strncmp(select, "type=", length + 1) == 0 || strncmp(select, "element=", length + 1) == 0;
    if (column < 0 && is_known && alias != NULL) {
        column = ps_field_find(names, separator, alias, strlen(alias));
    }
    if (column < 0) {
        char shown[PS_TOKEN_BYTES];
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s: --select %s, and the columns are \"%s\"",
                       where, select, ps_token_show(shown, names, strcspn(names, "\r\n")));
    }
    set_value(out, select + length + 1);
    out->column = (unsigned)column;
    return PSPEC_OK;
}

bool ps_row_filter_takes(const ps_row_filter *filter, const char *line, char separator) {
    ps_field field = {.text = NULL};
    bool is_more = true;
    double number = 0;
    if (filter->value == NULL) {
        return true;
    }
    for (unsigned i = 0; i <= filter->column; i++) {
        if (!ps_field_next(&line, separator, &is_more, &field)) {
            return false;
        }
    }
    const bool is_same = ps_field_is(field, filter->value, strlen(filter->value));
    return is_same || (filter->is_number && field.length > 0 &&
                       ps_decimal_parse(field.text, &number) == field.text + field.length &&
                       number == filter->number);
}

bool ps_row_filter_takes_number(const ps_row_filter *filter, double number, bool is_single) {
    return filter->value == NULL ||
           (filter->is_number &&
            number == (is_single ? (double)(float)filter->number : filter->number));
}
