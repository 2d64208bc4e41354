/* Columns of a table as vectors of one type: what NPZ files and the library have. */
#ifndef PS_FIELDS_TABLE_VECTOR_H
#define PS_FIELDS_TABLE_VECTOR_H

#include "files/decimal.h"
#include "fields/table.h"

/* Integers where all cells are integers, and there are some; texts where one of them is, or an
 * integer that is none of the doubles beside it, "" of what is missing; else doubles, nan of what is
 * missing. */
typedef struct ps_table_vector {
    ps_cell_kind kind; /* never missing */
    union {
        double *numbers;
        int64_t *integers;
        const char **texts; /* their bytes stand behind them */
        void *values;       /* freed by the caller */
    };
} ps_table_vector;

/* The digits of a number, which are put to own, or the text of a cell; "" of what is missing. */
enum { PS_TABLE_CELL_BYTES = PS_DECIMAL_BYTES > 24 ? PS_DECIMAL_BYTES : 24 }; /* or an integer */
const char *ps_table_show(char own[PS_TABLE_CELL_BYTES], const ps_cell *cell);

/* The column is below their number. */
pspec_status ps_table_vector_make(ps_table_vector *out, const ps_table *table, size_t column,
                                  ps_error *error) PS_MUST_CHECK;

#endif
