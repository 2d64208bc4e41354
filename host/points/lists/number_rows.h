/* Tables of numbers, such as those of lobes. */
#ifndef PS_POINTS_LISTS_NUMBER_ROWS_H
#define PS_POINTS_LISTS_NUMBER_ROWS_H

#include "base/status.h"

#include <stddef.h>
#include <stdint.h>

/* Reads lines of so many finite numbers separated by blanks or a comma, '#' lines skipped: rows
 * [num_rows][columns + 1], the last number of each its line; freed by the caller. */
pspec_status ps_read_rows(const char *path, unsigned columns, double **rows, size_t *num_rows,
                          ps_error *error) PS_MUST_CHECK;

/* Two numbers of a line, and which line it was. */
typedef struct ps_pair {
    double first, second;
    size_t line;
} ps_pair;

/* Reads lines of two finite numbers separated by blanks or a comma, '#' lines skipped; *pairs is
 * freed by the caller. */
pspec_status ps_read_pairs(const char *path, ps_pair **pairs, size_t *num_pairs,
                           ps_error *error) PS_MUST_CHECK;

#endif
