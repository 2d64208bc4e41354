/* Tables as arrays of an NPZ file: the header, and a vector for each column. */
#include "base/memory.h"
#include "base/text.h"
#include "files/decimal.h"
#include "tables/table_rows.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct column {
    const ps_table *table;
    const char *name;
    size_t place;
} column;

static const ps_cell *cell_at(const column *self, size_t row) {
    return &self->table->cells[row * self->table->num_columns + self->place];
}

static size_t count_cells(const column *self, ps_cell_kind kind) {
    size_t num = 0;
    for (size_t row = 0; row < self->table->num_rows; row++) {
        num += cell_at(self, row)->kind == kind;
    }
    return num;
}

/* ---- texts --------------------------------------------------------------------------------- */

enum { CELL_BYTES = PS_DECIMAL_BYTES > 24 ? PS_DECIMAL_BYTES : 24 }; /* a number, or an integer */

static const char *show(char own[CELL_BYTES], const ps_cell *cell) {
    own[0] = '\0';
    if (cell->kind == PS_CELL_TEXT) {
        return cell->text;
    }
    if (cell->kind == PS_CELL_NUMBER) {
        ps_decimal_format(own, cell->number);
    } else if (cell->kind == PS_CELL_INTEGER) {
        snprintf(own, CELL_BYTES, "%" PRId64, cell->integer);
    }
    return own;
}

/* Characters, which out gets unless it is NULL; a byte that is none is U+FFFD. */
static size_t decode(uint32_t *out, const char *text) {
    const uint32_t unknown = 0xfffd;
    size_t num = 0;
    while (*text != '\0') {
        uint32_t code = 0;
        const size_t length = ps_text_decode(&code, text);
        if (out != NULL) {
            out[num] = length > 0 ? code : unknown;
        }
        num++;
        text += length > 0 ? length : 1;
    }
    return num;
}

/* NumPy has no texts of no characters. */
static size_t find_width(const column *self) {
    char own[CELL_BYTES];
    size_t width = 1;
    for (size_t row = 0; row < self->table->num_rows; row++) {
        const size_t length = decode(NULL, show(own, cell_at(self, row)));
        width = length > width ? length : width;
    }
    return width;
}

static pspec_status add_texts(const column *self, ps_npz *npz, ps_error *error) {
    char own[CELL_BYTES];
    const size_t num = self->table->num_rows;
    const size_t width = find_width(self);
    uint32_t *texts = NULL;
    PS_TRY(ps_allocate_for(&texts, num, width * sizeof *texts, "a column of text", error));
    for (size_t row = 0; row < num; row++) {
        decode(texts + row * width, show(own, cell_at(self, row)));
    }
    const ps_npz_array array = {self->name, 'U', width * sizeof *texts, 1, &num, texts};
    const pspec_status status = ps_npz_add(npz, &array, error);
    free(texts);
    return status;
}

/* ---- numbers ------------------------------------------------------------------------------- */

static pspec_status add_numbers(const column *self, bool are_integers, ps_npz *npz,
                                ps_error *error) {
    const size_t num = self->table->num_rows;
    union {
        int64_t integer;
        double number;
    } *values = NULL;
    PS_TRY(PS_NEW(&values, num, "a column", error));
    for (size_t row = 0; row < num; row++) {
        const ps_cell *const cell = cell_at(self, row);
        if (are_integers) {
            values[row].integer = cell->integer;
        } else {
            values[row].number = ps_cell_number(*cell);
        }
    }
    const ps_npz_array array = {self->name, are_integers ? 'i' : 'f', sizeof *values, 1, &num,
                                values};
    const pspec_status status = ps_npz_add(npz, &array, error);
    free(values);
    return status;
}

static pspec_status add_column(const column *self, ps_npz *npz, ps_error *error) {
    const size_t num = self->table->num_rows;
    return count_cells(self, PS_CELL_TEXT) > 0
               ? add_texts(self, npz, error)
               : add_numbers(self, num > 0 && count_cells(self, PS_CELL_INTEGER) == num, npz,
                             error);
}

/* ---- header -------------------------------------------------------------------------------- */

static pspec_status add_text(const char *text, ps_npz *npz, ps_error *error) {
    const size_t num = decode(NULL, text);
    uint32_t *codes = NULL;
    PS_TRY(PS_NEW(&codes, num, "a header", error));
    decode(codes, text);
    const ps_npz_array array = {PS_TABLE_META, 'U', num * sizeof *codes, 0, NULL, codes};
    const pspec_status status = ps_npz_add(npz, &array, error);
    free(codes);
    return status;
}

static pspec_status add_header(const ps_table *table, ps_npz *npz, ps_error *error) {
    char *text = NULL;
    size_t num_bytes = 0;
    FILE *const stream = open_memstream(&text, &num_bytes);
    pspec_status status =
        stream != NULL ? ps_table_write_json(table, false, stream, error) : PSPEC_OK;
    if ((stream == NULL || fclose(stream) != 0) && status == PSPEC_OK) {
        status = ps_fail(error, PSPEC_ERROR_MEMORY, "not enough memory for a header");
    }
    if (status == PSPEC_OK) {
        status = add_text(text, npz, error);
    }
    free(text);
    return status;
}

pspec_status ps_table_add_to_npz(const ps_table *table, ps_npz *npz, ps_error *error) {
    PS_TRY(add_header(table, npz, error));
    for (size_t i = 0; i < table->num_columns; i++) {
        PS_TRY(add_column(&(column){table, table->columns[i], i}, npz, error));
    }
    for (size_t i = 0; i < table->num_arrays; i++) {
        const ps_npy_array *const values = &table->arrays[i].values;
        const ps_npz_array array = {table->arrays[i].name,
                                    values->is_complex ? 'c' : 'f',
                                    (values->is_complex ? 2 : 1) * sizeof *values->data,
                                    values->rank,
                                    values->shape,
                                    values->data};
        PS_TRY(ps_npz_add(npz, &array, error));
    }
    return PSPEC_OK;
}

pspec_status ps_table_write_npz(const ps_table *table, const char *path, ps_error *error) {
    ps_npz *npz = NULL;
    PS_TRY(ps_npz_open(&npz, path, PS_NPZ_LIMIT, error));
    const pspec_status status = ps_table_add_to_npz(table, npz, error);
    if (status == PSPEC_OK) {
        return ps_npz_commit(&npz, error);
    }
    ps_npz_discard(&npz);
    return status;
}
