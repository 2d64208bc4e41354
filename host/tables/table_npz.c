/* Tables as arrays of an NPZ file: the header as JSON for others, a list of all fields, the kinds
 * of cells, and a vector for each column. */
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

/* Characters, which out gets unless it is NULL; a byte that is none is U+DC80 to U+DCFF, as Python
 * has it in names of files. */
static size_t decode(uint32_t *out, const char *text) {
    size_t num = 0;
    while (*text != '\0') {
        uint32_t code = 0;
        const size_t length = ps_text_decode(&code, text);
        if (out != NULL) {
            out[num] = length > 0 ? code : (uint32_t)PS_TABLE_NO_CHARACTER + (unsigned char)*text;
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

/* Integers beside numbers that are none, or missing, must be exact as doubles. */
static bool is_exact(const column *self) {
    const int64_t most = (int64_t)1 << 53;
    bool all = true;
    for (size_t row = 0; row < self->table->num_rows; row++) {
        const ps_cell *const cell = cell_at(self, row);
        all = all &&
              (cell->kind != PS_CELL_INTEGER || (cell->integer >= -most && cell->integer <= most));
    }
    return all;
}

static pspec_status add_column(const column *self, ps_npz *npz, ps_error *error) {
    const size_t num = self->table->num_rows;
    const bool are_integers = num > 0 && count_cells(self, PS_CELL_INTEGER) == num;
    return count_cells(self, PS_CELL_TEXT) > 0 || (!are_integers && !is_exact(self))
               ? add_texts(self, npz, error)
               : add_numbers(self, are_integers, npz, error);
}

/* ---- fields -------------------------------------------------------------------------------- */

static void put_text(ps_text *out, const char *text) {
    ps_text_append_bytes(out, text, strlen(text) + 1);
}

static void put_fields(ps_text *out, const ps_table *table) {
    char own[CELL_BYTES];
    put_text(out, PS_TABLE_FIELDS_VERSION);
    put_text(out, table->command);
    for (size_t i = 0; i < table->num_columns; i++) {
        ps_text_append(out, "%c", PS_TABLE_COLUMN);
        put_text(out, table->columns[i]);
    }
    for (size_t i = 0; i < table->num_meta; i++) {
        const ps_table_entry *const entry = &table->meta[i];
        ps_text_append(out, "%c",
                       (entry->is_repeated ? PS_TABLE_REPEATED : PS_TABLE_SINGLE) +
                           (char)entry->value.kind);
        put_text(out, entry->key);
        put_text(out, show(own, &entry->value));
    }
    for (size_t i = 0; i < table->num_arrays; i++) {
        ps_text_append(out, "%c", table->arrays[i].is_state ? PS_TABLE_STATE : PS_TABLE_ARRAY);
        put_text(out, table->arrays[i].name);
    }
    if (table->has_blocks) {
        ps_text_append(out, "%c", PS_TABLE_BLOCKS);
    }
}

static pspec_status add_fields(const ps_table *table, ps_npz *npz, ps_error *error) {
    ps_text fields = {0};
    put_fields(&fields, table);
    pspec_status status = ps_text_check(&fields, error);
    if (status == PSPEC_OK) {
        const ps_npz_array array = {PS_TABLE_FIELDS, 'u', 1, 1, &fields.length, fields.data};
        status = ps_npz_add(npz, &array, error);
    }
    ps_text_free(&fields);
    return status;
}

static pspec_status add_kinds(const ps_table *table, ps_npz *npz, ps_error *error) {
    const size_t shape[] = {table->num_rows, table->num_columns};
    const size_t num = shape[0] * shape[1];
    uint8_t *kinds = NULL;
    PS_TRY(PS_NEW(&kinds, num, "kinds of cells", error));
    for (size_t i = 0; i < num; i++) {
        kinds[i] = (uint8_t)table->cells[i].kind;
    }
    const ps_npz_array array = {PS_TABLE_KINDS, 'u', 1, 2, shape, kinds};
    const pspec_status status = ps_npz_add(npz, &array, error);
    free(kinds);
    return status;
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
    PS_TRY(add_fields(table, npz, error));
    PS_TRY(add_kinds(table, npz, error));
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
