/* Rows of numbers in a long text, parsed by several threads. For host/files and host/points. */
#ifndef PS_FILES_TEXT_ROWS_H
#define PS_FILES_TEXT_ROWS_H

#include "base/workers.h"
#include "files/text_lines.h"

enum { PS_MOST_PARSERS = 8 };

/* {0} and the first two fields is ready for use. */
typedef struct ps_row_parser {
    char separator; /* ' ', ',' or ';' */
    unsigned columns;
    unsigned most_threads; /* the caller counted; 0: as many as there are processors */
    ps_workers *workers;
    bool has_tried;                 /* to start the workers: at the first long text */
    double *spare[PS_MOST_PARSERS]; /* [spare_rows][columns], rows of all workers but the first */
    size_t spare_rows;
    size_t row_bytes; /* of a row so far, on the average */
} ps_row_parser;

void ps_row_parser_free(ps_row_parser *parser);

/* Parses rows of the whole lines from text to end into rows, at most capacity of them. Returns the
 * beginning of the first line that was not taken: it is no row, or one more than there was room for
 * or was worth while. The first line is taken if it is a row at all. */
const char *ps_rows_parse(ps_row_parser *parser, const char *text, const char *end, double *rows,
                          size_t capacity, size_t *num_rows);

#endif
