#include "fields/table_vector.h"

#include "base/memory.h"
#include "fields/table_rows.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

static const char what[] = "a column";

static const ps_cell *cell_at(const ps_table *table, size_t column, size_t row) {
    return &table->cells[row * table->num_columns + column];
}

/* Integers beside cells that are none must be exact as doubles, or they are digits. */
static ps_cell_kind find_kind(const ps_table *table, size_t column) {
    const int64_t most = (int64_t)1 << 53;
    size_t num_integers = 0;
    bool is_exact = true;
    for (size_t row = 0; row < table->num_rows; row++) {
        const ps_cell *const cell = cell_at(table, column, row);
        if (cell->kind == PS_CELL_TEXT) {
            return PS_CELL_TEXT;
        }
        num_integers += cell->kind == PS_CELL_INTEGER;
        is_exact = is_exact && (cell->kind != PS_CELL_INTEGER ||
                                (cell->integer >= -most && cell->integer <= most));
    }
    return num_integers > 0 && num_integers == table->num_rows ? PS_CELL_INTEGER
           : is_exact                                          ? PS_CELL_NUMBER
                                                               : PS_CELL_TEXT;
}

/* ---- texts --------------------------------------------------------------------------------- */

const char *ps_table_show(char own[PS_TABLE_CELL_BYTES], const ps_cell *cell) {
    own[0] = '\0';
    if (cell->kind == PS_CELL_TEXT) {
        return cell->text;
    }
    if (cell->kind == PS_CELL_NUMBER) {
        ps_decimal_format(own, cell->number);
    } else if (cell->kind == PS_CELL_INTEGER) {
        snprintf(own, PS_TABLE_CELL_BYTES, "%" PRId64, cell->integer);
    }
    return own;
}

static pspec_status make_texts(ps_table_vector *out, const ps_table *table, size_t column,
                               ps_error *error) {
    char own[PS_TABLE_CELL_BYTES];
    size_t num_bytes = table->num_rows * sizeof *out->texts;
    for (size_t row = 0; row < table->num_rows; row++) {
        num_bytes += strlen(ps_table_show(own, cell_at(table, column, row))) + 1;
    }
    PS_TRY(ps_allocate(&out->values, num_bytes, 1, what, error));
    char *next = (char *)(out->texts + table->num_rows);
    for (size_t row = 0; row < table->num_rows; row++) {
        const char *const text = ps_table_show(own, cell_at(table, column, row));
        const size_t length = strlen(text) + 1;
        out->texts[row] = memcpy(next, text, length);
        next += length;
    }
    return PSPEC_OK;
}

/* ---- all ----------------------------------------------------------------------------------- */

pspec_status ps_table_vector_make(ps_table_vector *out, const ps_table *table, size_t column,
                                  ps_error *error) {
    *out = (ps_table_vector){.kind = find_kind(table, column)};
    if (out->kind == PS_CELL_TEXT) {
        return make_texts(out, table, column, error);
    }
    PS_TRY(PS_NEW(&out->numbers, table->num_rows, what, error)); /* an integer is as large */
    for (size_t row = 0; row < table->num_rows; row++) {
        const ps_cell *const cell = cell_at(table, column, row);
        if (out->kind == PS_CELL_INTEGER) {
            out->integers[row] = cell->integer;
        } else {
            out->numbers[row] = ps_cell_number(*cell);
        }
    }
    return PSPEC_OK;
}
