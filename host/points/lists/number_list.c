#include "points/lists/number_list.h"

#include "base/memory.h"
#include "base/process/memory_limit.h"
#include "files/decimal.h"
#include "files/text_lines.h"

#include <math.h>
#include <stdio.h>

enum {
    FIRST_VALUES = 1024,
    /* A list that is only somewhat too long is read on: the refusal then says how long it is. */
    FEW_MORE = 1 << 16
};

/* Looked at when the list grows. */
static pspec_status check_memory(const ps_number_list *list, size_t needed, ps_error *error) {
    const double bytes = (double)needed * (double)sizeof(double);
    char size[PS_SIZE_TEXT];
    ps_memory_share share;
    if (list->memory_limit == 0 && bytes < PS_LEAST_SHARE) {
        return PSPEC_OK;
    }
    ps_memory_share_find(&share, list->memory_limit, list->capacity * sizeof(double));
    return bytes <= share.bytes
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_MEMORY,
                         "%s takes more than %s, %s, after %zu numbers and goes on",
                         list->input->name, ps_size_show(size, share.bytes), share.by,
                         list->num_values);
}

pspec_status ps_number_list_reserve(ps_number_list *list, size_t num, const char *what,
                                    ps_error *error) {
    const size_t needed = list->num_values + num;
    void *memory = list->values;
    if (list->most_values > 0 && list->num_values > list->most_values + FEW_MORE) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s holds more than %zu %s", list->input->name,
                       list->num_values, list->why_values);
    }
    if (needed <= list->capacity) {
        return PSPEC_OK;
    }
    const size_t half_more = list->capacity + list->capacity / 2;
    PS_TRY(check_memory(list, needed > half_more ? needed : half_more, error));
    PS_TRY(ps_grow(&memory, &list->capacity, needed > FIRST_VALUES ? needed : FIRST_VALUES,
                   sizeof(double), what, error));
    list->values = memory;
    return PSPEC_OK;
}

pspec_status ps_number_list_append(ps_number_list *list, double value, ps_error *error) {
    PS_TRY(ps_number_list_reserve(list, 1, "numbers", error));
    list->values[list->num_values++] = value;
    return PSPEC_OK;
}

const char *ps_number_list_skip(const char *text) {
    while (*text == ' ' || *text == '\t' || (text[0] == '\r' && text[1] == '\n')) {
        text++;
    }
    return text;
}

static size_t token_length(const char *text) {
    size_t length = 0;
    while (text[length] != '\n' && text[length] != ',' &&
           ps_number_list_skip(text + length) == text + length) {
        length++;
    }
    return length;
}

pspec_status ps_number_list_token(const ps_number_list *list, const char **text, const char *what,
                                  double *value, ps_error *error) {
    const size_t length = token_length(*text);
    if (ps_decimal_parse(*text, value) != *text + length || !isfinite(*value)) {
        char shown[PS_TOKEN_BYTES];
        return ps_lines_fail(&list->lines, error, "\"%s\" is not %s",
                             ps_token_show(shown, *text, length), what);
    }
    *text += length;
    return PSPEC_OK;
}

pspec_status ps_number_list_read(ps_number_list *list, ps_line_parser *parse, ps_error *error) {
    ps_lines *const lines = &list->lines;
    bool has_line = false;
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, ps_lines_open(lines, list->input, error));
    PS_TRY_OUT(status, ps_lines_fill(lines, &has_line, error));
    while (has_line) {
        const char *const text = ps_number_list_skip(lines->cursor);
        if (*text != '\n' && *text != '#') {
            PS_TRY_OUT(status, parse(list, text, error));
        }
        ps_lines_skip(lines);
        PS_TRY_OUT(status, ps_lines_fill(lines, &has_line, error));
    }
    if (list->num_values == 0) {
        status = ps_fail(error, PSPEC_ERROR_INPUT, "%s holds no numbers", list->input->name);
    }
out:
    ps_lines_close(lines);
    return status;
}
