/* --select NAME=VALUE: of all rows those that have this value in the column of that name. Private
 * to host/points. */
#ifndef PS_POINTS_ROW_FILTER_H
#define PS_POINTS_ROW_FILTER_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

/* {0} takes all rows. */
typedef struct ps_row_filter {
    const char *value; /* NULL: every row is taken */
    unsigned column;
    bool is_number;
    double number; /* that the value is */
} ps_row_filter;

/* Bytes of the name in "type=1"; 0 for NULL. */
size_t ps_row_filter_name(const char *select);
/* Finds the column in a line of names. alias: the column that "type" and "element" mean where none
 * is called so, or NULL. where: "FILE, line 1". */
pspec_status ps_row_filter_find(ps_row_filter *out, const char *select, const char *names,
                                char separator, const char *alias, const char *where,
                                ps_error *error) PS_MUST_CHECK;
/* Has the line this text, or another one of the same number, in that column? */
bool ps_row_filter_takes(const ps_row_filter *filter, const char *line, char separator);
/* The same for a number of a file of these; is_single: it was rounded to float32 there. */
bool ps_row_filter_takes_number(const ps_row_filter *filter, double number, bool is_single);

#endif
