#include "points/lists/frequency_list.h"

#include "base/memory.h"
#include "points/lists/number_list.h"
#include "points/columns.h"

#include <math.h>
#include <stdlib.h>

enum { MAX_FREQUENCY = 1 << 30 };

static pspec_status check_frequency(const ps_number_list *list, double value, ps_error *error) {
    if (value != floor(value) || fabs(value) > MAX_FREQUENCY) {
        return ps_lines_fail(&list->lines, error,
                             "frequency %.17g is not a whole number between -%d and %d", value,
                             MAX_FREQUENCY, MAX_FREQUENCY);
    }
    return PSPEC_OK;
}

static pspec_status check_columns(ps_number_list *list, size_t columns, ps_error *error) {
    if (columns > PS_MAX_DIMENSION) {
        return ps_lines_fail(&list->lines, error, "%zu columns; frequency vectors have at most %d",
                             columns, PS_MAX_DIMENSION);
    }
    if (list->columns != 0 && columns != list->columns) {
        return ps_lines_fail(&list->lines, error, "%zu column%s, the first line has %u", columns,
                             columns == 1 ? "" : "s", list->columns);
    }
    list->columns = (unsigned)columns;
    return PSPEC_OK;
}

static pspec_status parse_frequency(ps_number_list *list, const char *text, ps_error *error) {
    size_t columns = 0;
    bool is_after_comma = false;
    while (*text != '\n' || is_after_comma) {
        double value = 0;
        PS_TRY(ps_number_list_token(list, &text, "a number", &value, error));
        PS_TRY(check_frequency(list, value, error));
        PS_TRY(ps_number_list_append(list, value, error));
        columns++;
        text = ps_number_list_skip(text);
        is_after_comma = *text == ',';
        text = ps_number_list_skip(text + is_after_comma);
    }
    return check_columns(list, columns, error);
}

static pspec_status convert_frequencies(const ps_number_list *list, int **vectors,
                                        ps_error *error) {
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
    ps_number_list list = {.input = &input, .memory_limit = memory_limit};
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, ps_input_open(&input, path, error));
    PS_TRY_OUT(status, ps_number_list_read(&list, parse_frequency, error));
    PS_TRY_OUT(status, convert_frequencies(&list, vectors, error));
    *num_vectors = list.num_values / list.columns;
    *dimension = list.columns;
out:
    free(list.values);
    ps_input_close(&input);
    return status;
}
