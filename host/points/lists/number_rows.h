/* Tables of numbers, such as those of lobes. */
#ifndef PS_POINTS_LISTS_NUMBER_ROWS_H
#define PS_POINTS_LISTS_NUMBER_ROWS_H

#include "base/status.h"

#include <stddef.h>

/* Reads lines of so many finite numbers separated by blanks or a comma, '#' lines skipped: rows
 * [num_rows][columns + 1], the last number of each its line; freed by the caller. */
pspec_status ps_read_rows(const char *path, unsigned columns, double **rows, size_t *num_rows,
                          ps_error *error) PS_MUST_CHECK;

#endif
