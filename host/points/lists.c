/* Lists that come beside points: frequency vectors, weights, tables of two columns. */
#include "base/memory.h"
#include "base/process/memory_limit.h"
#include "files/decimal.h"
#include "files/npy.h"
#include "files/output_file.h"
#include "files/text_lines.h"
#include "points/points_format.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    MAX_FREQUENCY = 1 << 30,
    FIRST_VALUES = 1024,
    /* A list that is only somewhat too long is read on: the refusal then says how long it is. */
    FEW_MORE = 1 << 16
};

/* Numbers as they are read, row by row. */
typedef struct number_list {
    ps_input *input;
    double *values;
    size_t num_values, capacity;
    unsigned columns;          /* of every row; 0: any number */
    const char *columns_shown; /* as a word, of tables */
    /* it is not read beyond these, since a file may have no end */
    uint64_t most_values;   /* 0: any number */
    uint64_t memory_limit;  /* of bytes, that somebody typed; 0: half of what is free */
    const char *why_values; /* what most_values means, as in "weights, and a set has 5 points" */
} number_list;

typedef pspec_status line_parser(number_list *list, const char *line, size_t line_number,
                                 ps_error *error);

static pspec_status fail_large(const number_list *list, double limit, const char *by,
                               ps_error *error) {
    char size[PS_SIZE_TEXT];
    return ps_fail(error, PSPEC_ERROR_MEMORY,
                   "%s takes more than %s, %s, after %zu numbers and goes on", list->input->name,
                   ps_size_show(size, limit), by, list->num_values);
}

/* Looked at when the list grows. */
static pspec_status check_memory(const number_list *list, size_t needed, ps_error *error) {
    const double least_checked = 16 << 20; /* looking takes 0.1 ms */
    const double bytes = (double)needed * (double)sizeof(double);
    char by[PS_MEMORY_PLACE + 32];
    ps_memory_room room;
    if (list->memory_limit > 0) {
        return bytes <= (double)list->memory_limit
                   ? PSPEC_OK
                   : fail_large(list, (double)list->memory_limit, "the limit of --memory", error);
    }
    if (bytes < least_checked) {
        return PSPEC_OK;
    }
    ps_memory_room_find(&room, list->capacity * sizeof(double));
    snprintf(by, sizeof by, "half of what %s leaves", room.by);
    return bytes <= (double)room.bytes / 2 ? PSPEC_OK
                                           : fail_large(list, (double)room.bytes / 2, by, error);
}

/* Room for num more values. */
static pspec_status reserve(number_list *list, size_t num, const char *what, ps_error *error) {
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

static pspec_status append(number_list *list, double value, ps_error *error) {
    PS_TRY(reserve(list, 1, "numbers", error));
    list->values[list->num_values++] = value;
    return PSPEC_OK;
}

/* Blanks, tabs, and what CR LF leaves at the end of a line. */
static const char *skip_blanks(const char *text) {
    while (*text == ' ' || *text == '\t' || (text[0] == '\r' && text[1] == '\n')) {
        text++;
    }
    return text;
}

static size_t token_length(const char *text) {
    size_t length = 0;
    while (text[length] != '\n' && text[length] != ',' &&
           skip_blanks(text + length) == text + length) {
        length++;
    }
    return length;
}

static pspec_status read_token(const number_list *list, const char **text, size_t line_number,
                               const char *what, double *value, ps_error *error) {
    const size_t length = token_length(*text);
    if (ps_decimal_parse(*text, value) != *text + length || !isfinite(*value)) {
        char shown[PS_TOKEN_BYTES];
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s, line %zu: \"%s\" is not %s",
                       list->input->name, line_number, ps_token_show(shown, *text, length), what);
    }
    *text += length;
    return PSPEC_OK;
}

/* Feeds every line that is neither blank nor a '#' line to parse. */
static pspec_status read_lines(number_list *list, line_parser *parse, ps_error *error) {
    ps_lines lines = {0};
    bool has_line = false;
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, ps_lines_open(&lines, list->input, error));
    PS_TRY_OUT(status, ps_lines_fill(&lines, &has_line, error));
    while (has_line) {
        const char *const text = skip_blanks(lines.cursor);
        if (*text != '\n' && *text != '#') {
            PS_TRY_OUT(status, parse(list, text, lines.line_number, error));
        }
        ps_lines_skip(&lines);
        PS_TRY_OUT(status, ps_lines_fill(&lines, &has_line, error));
    }
    if (list->num_values == 0) {
        status = ps_fail(error, PSPEC_ERROR_INPUT, "%s holds no numbers", list->input->name);
    }
out:
    ps_lines_close(&lines);
    return status;
}

/* ---- frequencies ---- */

static pspec_status check_frequency(const number_list *list, double value, size_t line_number,
                                    ps_error *error) {
    if (value != floor(value) || fabs(value) > MAX_FREQUENCY) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s, line %zu: frequency %.17g is not a whole number between -%d and %d",
                       list->input->name, line_number, value, MAX_FREQUENCY, MAX_FREQUENCY);
    }
    return PSPEC_OK;
}

static pspec_status check_columns(number_list *list, size_t columns, size_t line_number,
                                  ps_error *error) {
    if (columns > PS_MAX_DIMENSION) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s, line %zu: %zu columns; frequency vectors have at most %d",
                       list->input->name, line_number, columns, PS_MAX_DIMENSION);
    }
    if (list->columns != 0 && columns != list->columns) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s, line %zu: %zu column%s, the first line has %u", list->input->name,
                       line_number, columns, columns == 1 ? "" : "s", list->columns);
    }
    list->columns = (unsigned)columns;
    return PSPEC_OK;
}

static pspec_status parse_frequency(number_list *list, const char *text, size_t line_number,
                                    ps_error *error) {
    size_t columns = 0;
    bool is_after_comma = false;
    while (*text != '\n' || is_after_comma) {
        double value = 0;
        PS_TRY(read_token(list, &text, line_number, "a number", &value, error));
        PS_TRY(check_frequency(list, value, line_number, error));
        PS_TRY(append(list, value, error));
        columns++;
        text = skip_blanks(text);
        is_after_comma = *text == ',';
        text = skip_blanks(text + is_after_comma);
    }
    return check_columns(list, columns, line_number, error);
}

static pspec_status convert_frequencies(const number_list *list, int **vectors, ps_error *error) {
    PS_TRY(PS_NEW(vectors, list->num_values, "frequencies", error));
    for (size_t i = 0; i < list->num_values; i++) {
        (*vectors)[i] = (int)list->values[i];
    }
    return PSPEC_OK;
}

pspec_status ps_read_frequencies(const char *path, uint64_t memory_limit, int **vectors,
                                 size_t *num_vectors, unsigned *dimension, ps_error *error) {
    *vectors = NULL;
    ps_input input = {0};
    number_list list = {.input = &input, .memory_limit = memory_limit};
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, ps_input_open(&input, path, error));
    PS_TRY_OUT(status, read_lines(&list, parse_frequency, error));
    PS_TRY_OUT(status, convert_frequencies(&list, vectors, error));
    *num_vectors = list.num_values / list.columns;
    *dimension = list.columns;
out:
    free(list.values);
    ps_input_close(&input);
    return status;
}

/* ---- weights ---- */

static pspec_status parse_weights(number_list *list, const char *text, size_t line_number,
                                  ps_error *error) {
    while (*text != '\n') {
        double value = 0;
        PS_TRY(read_token(list, &text, line_number, "a finite number", &value, error));
        PS_TRY(append(list, value, error));
        text = skip_blanks(text);
        if (*text == ',') { /* columns would not say which one is meant */
            return ps_fail(error, PSPEC_ERROR_INPUT,
                           "%s, line %zu: a comma; weights are separated by blanks or lines",
                           list->input->name, line_number);
        }
    }
    return PSPEC_OK;
}

/* In blocks, so that a pipe that promises too much does not claim the memory for it. */
static pspec_status read_npy_elements(number_list *list, const ps_npy_header *header,
                                      ps_error *error) {
    enum { BLOCK_ELEMENTS = 1 << 16 };
    while (list->num_values < header->num_elements) {
        const size_t left = header->num_elements - list->num_values;
        const size_t num = left < BLOCK_ELEMENTS ? left : BLOCK_ELEMENTS;
        PS_TRY(reserve(list, num, "weights", error));
        double *const block = list->values + list->num_values;
        PS_TRY(ps_npy_read_elements(list->input, header, block, num, error));
        for (size_t i = 0; i < num; i++) {
            if (!isfinite(block[i])) {
                return ps_fail(error, PSPEC_ERROR_INPUT,
                               "%s: weight %zu is %g, not a finite number", list->input->name,
                               list->num_values + i + 1, block[i]);
            }
        }
        list->num_values += num;
    }
    return ps_npy_check_end(list->input, error);
}

static pspec_status read_npy(number_list *list, ps_error *error) {
    ps_npy_header header;
    PS_TRY(ps_npy_read_header(list->input, &header, error));
    if (header.rank != 1) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s: an array with %u axes; weights have one",
                       list->input->name, header.rank);
    }
    if (header.num_elements == 0) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s holds no numbers", list->input->name);
    }
    return read_npy_elements(list, &header, error);
}

pspec_status ps_read_weights(const char *path, uint64_t num_wanted, double **weights,
                             size_t *num_weights, ps_error *error) {
    *weights = NULL;
    ps_input input = {0};
    char why[96];
    snprintf(why, sizeof why, "weights, and a set has %llu points", (unsigned long long)num_wanted);
    number_list list = {.input = &input, .most_values = num_wanted, .why_values = why};
    pspec_status status = PSPEC_OK;
    bool is_npy = false;
    PS_TRY_OUT(status, ps_input_open_array(&input, path, "weights", error));
    PS_TRY_OUT(status, ps_npy_is_next(&input, &is_npy, error));
    PS_TRY_OUT(status, is_npy ? read_npy(&list, error) : read_lines(&list, parse_weights, error));
    *weights = list.values;
    *num_weights = list.num_values;
    list.values = NULL;
out:
    free(list.values);
    ps_input_close(&input);
    return status;
}

pspec_status ps_weights_check_name(const char *path, ps_error *error) {
    const char *const ending = ps_output_ending(path);
    return ending[0] == '\0' || strcmp(ending, ".npy") == 0 || strcmp(ending, ".txt") == 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "\"%s\": weights are written to .npy or .txt, not %s", path, ending);
}

pspec_status ps_write_weights(const char *path, const double *weights, size_t num_weights,
                              ps_error *error) {
    ps_output_file *file = NULL;
    char text[PS_DECIMAL_BYTES + 1];
    if (strcmp(ps_output_ending(path), ".npy") == 0) {
        return ps_npy_write(path, 1, &num_weights, weights, error);
    }
    PS_TRY(ps_output_open(&file, path, error));
    for (size_t j = 0; j < num_weights; j++) {
        const size_t length = ps_decimal_format(text, weights[j]);
        text[length] = '\n';
        ps_output_write(file, text, 1, length + 1);
    }
    return ps_output_commit(&file, error);
}

/* ---- tables ---- */

/* The values of the list are rows, each with the line that it stood in. */
static pspec_status parse_row(number_list *list, const char *text, size_t line_number,
                              ps_error *error) {
    for (unsigned column = 0; column < list->columns; column++) {
        double value = 0;
        PS_TRY(read_token(list, &text, line_number, "a finite number", &value, error));
        PS_TRY(append(list, value, error));
        text = skip_blanks(text);
        text = skip_blanks(text + (column + 1 < list->columns && *text == ','));
    }
    if (*text != '\n') {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s, line %zu: more than %s numbers; rows have %s columns",
                       list->input->name, line_number, list->columns_shown, list->columns_shown);
    }
    return append(list, (double)line_number, error);
}

pspec_status ps_read_rows(const char *path, unsigned columns, double **rows, size_t *num_rows,
                          ps_error *error) {
    const uint64_t most_rows = 1 << 22; /* a table of a lobe has hundreds */
    char columns_shown[32];
    char why[96];
    *rows = NULL;
    snprintf(columns_shown, sizeof columns_shown, columns == 2 ? "two" : "%u", columns);
    snprintf(why, sizeof why, "numbers, more than a table of %s columns may have", columns_shown);
    ps_input input = {0};
    number_list list = {.input = &input,
                        .columns = columns,
                        .columns_shown = columns_shown,
                        .most_values = (columns + 1) * most_rows,
                        .why_values = why};
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, ps_input_open(&input, path, error));
    PS_TRY_OUT(status, read_lines(&list, parse_row, error));
    *num_rows = list.num_values / (columns + 1);
    *rows = list.values;
    list.values = NULL;
out:
    free(list.values);
    ps_input_close(&input);
    return status;
}

pspec_status ps_read_pairs(const char *path, ps_pair **pairs, size_t *num_pairs, ps_error *error) {
    enum { COLUMNS = 2 };
    double *rows = NULL;
    *pairs = NULL;
    PS_TRY(ps_read_rows(path, COLUMNS, &rows, num_pairs, error));
    const pspec_status status = PS_NEW(pairs, *num_pairs, "rows", error);
    for (size_t i = 0; status == PSPEC_OK && i < *num_pairs; i++) {
        const double *const row = rows + i * (COLUMNS + 1);
        (*pairs)[i] = (ps_pair){row[0], row[1], (size_t)row[2]};
    }
    free(rows);
    return status;
}
