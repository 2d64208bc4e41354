#include "points/lists/number_rows.h"

#include "points/lists/number_list.h"

#include <stdio.h>
#include <stdlib.h>

/* The values of the list are rows, each with the line that it stood in. */
static pspec_status parse_row(ps_number_list *list, const char *text, ps_error *error) {
    for (unsigned column = 0; column < list->columns; column++) {
        double value = 0;
        PS_TRY(ps_number_list_token(list, &text, "a finite number", &value, error));
        PS_TRY(ps_number_list_append(list, value, error));
        text = ps_number_list_skip(text);
        text = ps_number_list_skip(text + (column + 1 < list->columns && *text == ','));
    }
    if (*text != '\n') {
        return ps_lines_fail(&list->lines, error, "more than %s numbers; rows have %s columns",
                             list->columns_shown, list->columns_shown);
    }
    return ps_number_list_append(list, (double)list->lines.line_number, error);
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
    ps_number_list list = {.input = &input,
                           .columns = columns,
                           .columns_shown = columns_shown,
                           .most_values = (columns + 1) * most_rows,
                           .why_values = why};
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, ps_input_open(&input, path, error));
    PS_TRY_OUT(status, ps_number_list_read(&list, parse_row, error));
    *num_rows = list.num_values / (columns + 1);
    *rows = list.values;
    list.values = NULL;
out:
    free(list.values);
    ps_input_close(&input);
    return status;
}
