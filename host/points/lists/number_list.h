/* Numbers of a file that grow as lines are read: what lists of frequencies, weights and rows share.
 * Private to host/points/lists. */
#ifndef PS_POINTS_LISTS_NUMBER_LIST_H
#define PS_POINTS_LISTS_NUMBER_LIST_H

#include "base/status.h"
#include "files/text_lines.h"

#include <stdbool.h>
#include <stdint.h>

/* Numbers as they are read, row by row. */
typedef struct ps_number_list {
    ps_input *input;
    ps_lines lines; /* of a text */
    double *values;
    size_t num_values, capacity;
    struct ps_text_header *header; /* of weights: names of columns, if the first line has these */
    char separator;                /* between such columns */
    unsigned columns;              /* of every row; 0: any number */
    const char *columns_shown;     /* as a word, of tables */
    /* it is not read beyond these, since a file may have no end */
    uint64_t most_values;   /* 0: any number */
    uint64_t memory_limit;  /* of bytes, that somebody typed; 0: half of what is free */
    const char *why_values; /* what most_values means, as in "weights, and a set has 5 points" */
} ps_number_list;

typedef pspec_status ps_line_parser(ps_number_list *list, const char *line, ps_error *error);

/* Blanks, tabs, and what CR LF leaves at the end of a line. */
const char *ps_number_list_skip(const char *text);

/* Room for num more values. */
pspec_status ps_number_list_reserve(ps_number_list *list, size_t num, const char *what,
                                    ps_error *error) PS_MUST_CHECK;
pspec_status ps_number_list_append(ps_number_list *list, double value,
                                   ps_error *error) PS_MUST_CHECK;

/* The finite number at *text, which is moved behind it; what: "a number", of refusals. */
pspec_status ps_number_list_token(const ps_number_list *list, const char **text, const char *what,
                                  double *value, ps_error *error) PS_MUST_CHECK;

/* Feeds every line that is neither blank nor a '#' line to parse. */
pspec_status ps_number_list_read(ps_number_list *list, ps_line_parser *parse,
                                 ps_error *error) PS_MUST_CHECK;

#endif
