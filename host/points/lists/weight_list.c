#include "points/lists/weight_list.h"

#include "files/decimal.h"
#include "files/text_lines.h"
#include "points/lists/number_list.h"
#include "points/text/text_fields.h"
#include "points/text/text_header.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Names of columns: all but one are an index. */
static pspec_status take_names(ps_number_list *list, const char *line, ps_error *error) {
    const char separator = memchr(line, ';', strcspn(line, "\n")) != NULL ? ';' : ',';
    ps_text_header *const header = list->header;
    PS_TRY(ps_text_header_read(header, line, line, separator, &(ps_text_choice){0}, &list->lines,
                               error));
    list->separator = separator;
    return header->num_chosen == 1
               ? PSPEC_OK
               : ps_lines_fail(&list->lines, error,
                               "columns %s; weights are one, and those of a file of points are "
                               "--weights column",
                               header->used);
}

static pspec_status fail_number(const ps_number_list *list, ps_field field, ps_error *error) {
    char shown[PS_TOKEN_BYTES];
    if (memchr(field.text, ',', field.length) != NULL) { /* columns do not say which is meant */
        return ps_lines_fail(&list->lines, error,
                             "a comma; weights are separated by blanks or lines");
    }
    return ps_lines_fail(&list->lines, error, "\"%s\" is not a finite number",
                         ps_token_show(shown, field.text, field.length));
}

/* The row of a column with a name. */
static pspec_status parse_row(ps_number_list *list, const char *line, ps_error *error) {
    double value = 0;
    bool is_taken = false;
    const bool is_row =
        ps_text_header_row(list->header, line, list->separator, &value, &is_taken) != NULL;
    if (is_row && isfinite(value)) {
        return ps_number_list_append(list, value, error);
    }
    return is_row ? ps_lines_fail(&list->lines, error, "weight %g is not a finite number", value)
                  : ps_text_header_refuse(list->header, line, list->separator, &list->lines, error);
}

static pspec_status parse_weights(ps_number_list *list, const char *line, ps_error *error) {
    ps_field field;
    bool is_more = true;
    double value = 0;
    if (list->header->is_there) {
        return parse_row(list, line, error);
    }
    if (list->num_values == 0 && (ps_text_header_is(line, ',') || ps_text_header_is(line, ';'))) {
        return take_names(list, line, error);
    }
    while (ps_field_next(&line, ' ', &is_more, &field)) {
        if (field.length == 0 ||
            ps_decimal_parse(field.text, &value) != field.text + field.length || !isfinite(value)) {
            return fail_number(list, field, error);
        }
        PS_TRY(ps_number_list_append(list, value, error));
    }
    return PSPEC_OK;
}

/* In blocks, so that a pipe that promises too much does not claim the memory for it. */
static pspec_status read_npy_elements(ps_number_list *list, const ps_npy_header *header,
                                      ps_error *error) {
    enum { BLOCK_ELEMENTS = 1 << 16 };
    while (list->num_values < header->num_elements) {
        const size_t left = header->num_elements - list->num_values;
        const size_t num = left < BLOCK_ELEMENTS ? left : BLOCK_ELEMENTS;
        PS_TRY(ps_number_list_reserve(list, num, "weights", error));
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

static pspec_status read_npy(ps_number_list *list, ps_error *error) {
    ps_npy_header header;
    PS_TRY(ps_npy_read_header(list->input, &header, false, error));
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
    ps_text_header header = {0};
    ps_number_list list = {
        .input = &input, .header = &header, .most_values = num_wanted, .why_values = why};
    pspec_status status = PSPEC_OK;
    bool is_npy = false;
    PS_TRY_OUT(status, ps_input_open_array(&input, path, "weights", error));
    PS_TRY_OUT(status, ps_npy_is_next(&input, &is_npy, error));
    PS_TRY_OUT(status,
               is_npy ? read_npy(&list, error) : ps_number_list_read(&list, parse_weights, error));
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

pspec_status ps_write_weights(const char *path, const ps_npy_array *weights, ps_error *error) {
    ps_output_file *file = NULL;
    char text[PS_DECIMAL_BYTES + 1];
    if (strcmp(ps_output_ending(path), ".npy") == 0) {
        return ps_npy_write_array(path, weights, error);
    }
    PS_TRY(ps_output_open(&file, path, error));
    for (size_t j = 0; j < weights->num; j++) {
        const size_t length = ps_decimal_format(text, weights->data[j]);
        text[length] = '\n';
        ps_output_write(file, text, 1, length + 1);
    }
    return ps_output_commit(&file, error);
}
