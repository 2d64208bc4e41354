#include "points/lists/weight_list.h"

#include "files/decimal.h"
#include "files/npy.h"
#include "files/output_file.h"
#include "points/lists/number_list.h"
#include "points/text/text_fields.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A first line that is nothing but the name of a column. */
static bool is_name(const char *line) {
    ps_field name;
    bool is_more = true;
    return ps_fields_count(line, ',') == 1 && ps_field_next(&line, ',', &is_more, &name) &&
           ps_field_is_name(name);
}

static pspec_status parse_weights(ps_number_list *list, const char *text, size_t line_number,
                                  ps_error *error) {
    if (!list->has_name && list->num_values == 0 && is_name(text)) {
        list->has_name = true;
        return PSPEC_OK;
    }
    while (*text != '\n') {
        double value = 0;
        PS_TRY(ps_number_list_token(list, &text, line_number, "a finite number", &value, error));
        PS_TRY(ps_number_list_append(list, value, error));
        text = ps_number_list_skip(text);
        if (*text == ',') { /* columns would not say which one is meant */
            return ps_fail(error, PSPEC_ERROR_INPUT,
                           "%s, line %zu: a comma; weights are separated by blanks or lines",
                           list->input->name, line_number);
        }
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
    ps_number_list list = {.input = &input, .most_values = num_wanted, .why_values = why};
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
