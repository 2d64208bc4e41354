/* The public library: tables. */
#include "api/public_objects.h"
#include "base/memory.h"
#include "base/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct pspec_table {
    ps_table *table; /* owned */
    ps_text verdict;
};

pspec_status ps_public_table(pspec_table **out, ps_table *table, const char *verdict,
                             ps_error *error) {
    void *memory = NULL;
    *out = NULL;
    pspec_status status = ps_allocate(&memory, 1, sizeof(pspec_table), "a table", error);
    if (status != PSPEC_OK) {
        ps_table_destroy(table);
        return status;
    }
    pspec_table *const self = memory;
    self->table = table;
    ps_text_append(&self->verdict, "%s", verdict);
    status = ps_text_check(&self->verdict, error);
    if (status != PSPEC_OK) {
        pspec_table_destroy(self);
        return status;
    }
    *out = self;
    return PSPEC_OK;
}

void pspec_table_destroy(pspec_table *table) {
    if (table != NULL) {
        ps_table_destroy(table->table);
        ps_text_free(&table->verdict);
        free(table);
    }
}

/* ---- reading ----------------------------------------------------------------------------- */

static pspec_cell public_cell(ps_cell cell) {
    pspec_cell out = {PSPEC_CELL_MISSING, (double)NAN, 0, NULL};
    switch (cell.kind) {
    case PS_CELL_MISSING:
        break;
    case PS_CELL_NUMBER:
        out.kind = isnan(cell.number) ? PSPEC_CELL_MISSING : PSPEC_CELL_NUMBER;
        out.number = cell.number;
        break;
    case PS_CELL_INTEGER:
        out.kind = PSPEC_CELL_INTEGER;
        out.number = (double)cell.integer;
        out.integer = cell.integer;
        break;
    case PS_CELL_TEXT:
        out.kind = PSPEC_CELL_TEXT;
        out.text = cell.text;
        break;
    }
    return out;
}

const char *pspec_table_name(const pspec_table *table) {
    return ps_table_command(table->table);
}

size_t pspec_table_num_rows(const pspec_table *table) {
    return ps_table_num_rows(table->table);
}

size_t pspec_table_num_columns(const pspec_table *table) {
    return ps_table_num_columns(table->table);
}

const char *pspec_table_column_name(const pspec_table *table, size_t column) {
    return column < pspec_table_num_columns(table) ? ps_table_column_name(table->table, column)
                                                   : NULL;
}

size_t pspec_table_find_column(const pspec_table *table, const char *name) {
    size_t column = 0;
    return name != NULL && ps_table_find_column(table->table, name, &column)
               ? column
               : pspec_table_num_columns(table);
}

pspec_cell pspec_table_cell(const pspec_table *table, size_t row, size_t column) {
    const bool is_there =
        row < pspec_table_num_rows(table) && column < pspec_table_num_columns(table);
    return public_cell(is_there ? ps_table_cell(table->table, row, column) : PS_MISSING);
}

void pspec_table_numbers(const pspec_table *table, size_t column, double *numbers) {
    for (size_t row = 0; row < pspec_table_num_rows(table); row++) {
        numbers[row] = pspec_table_cell(table, row, column).number;
    }
}

size_t pspec_table_num_entries(const pspec_table *table) {
    return ps_table_num_meta(table->table);
}

pspec_cell pspec_table_entry(const pspec_table *table, size_t i, const char **key) {
    const char *found = NULL;
    const ps_cell value =
        i < pspec_table_num_entries(table) ? ps_table_meta(table->table, i, &found) : PS_MISSING;
    if (key != NULL) {
        *key = found;
    }
    return public_cell(value);
}

pspec_cell pspec_table_find_entry(const pspec_table *table, const char *key) {
    return public_cell(key != NULL ? ps_table_find_meta(table->table, key) : PS_MISSING);
}

const char *pspec_table_verdict(const pspec_table *table) {
    return ps_text_string(&table->verdict);
}

/* ---- writing ----------------------------------------------------------------------------- */

pspec_status pspec_table_write(const pspec_table *table, pspec_context *context, const char *path,
                               const char *format) {
    ps_table_format chosen = PS_FORMAT_CSV;
    if (context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    ps_error *const error = &context->error;
    if (table == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "there is no table to write");
    }
    if (path == NULL || strcmp(path, "-") == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "a table is written to a file, and standard output is none");
    }
    PS_TRY(ps_table_choose_format(&chosen, format, path, error));
    return ps_table_write(table->table, path, chosen, error);
}
