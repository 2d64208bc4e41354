/* Tables as arrays of an NPZ file: the header as JSON for others, a list of all fields, the kinds
 * of cells, and a vector for each column. */
#include "base/memory.h"
#include "base/text.h"
#include "fields/table_rows.h"
#include "fields/table_vector.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

/* ---- columns ------------------------------------------------------------------------------- */

/* NumPy has no texts of no characters. */
static size_t find_width(const char *const *texts, size_t num) {
    size_t width = 1;
    for (size_t row = 0; row < num; row++) {
        const size_t length = decode(NULL, texts[row]);
        width = length > width ? length : width;
    }
    return width;
}

static pspec_status add_texts(const char *name, const char *const *texts, size_t num, ps_npz *npz,
                              ps_error *error) {
    const size_t width = find_width(texts, num);
    uint32_t *codes = NULL;
    PS_TRY(ps_allocate_for(&codes, num, width * sizeof *codes, "a column of text", error));
    for (size_t row = 0; row < num; row++) {
        decode(codes + row * width, texts[row]);
    }
    const ps_npz_array array = {name, 'U', width * sizeof *codes, 1, &num, codes};
    const pspec_status status = ps_npz_add(npz, &array, error);
    free(codes);
    return status;
}

static pspec_status add_column(const ps_table *table, size_t column, ps_npz *npz, ps_error *error) {
    const char *const name = table->columns[column];
    ps_table_vector vector;
    PS_TRY(ps_table_vector_make(&vector, table, column, error));
    const ps_npz_array array = {name,
                                vector.kind == PS_CELL_INTEGER ? 'i' : 'f',
                                sizeof *vector.numbers,
                                1,
                                &table->num_rows,
                                vector.values};
    const pspec_status status = vector.kind == PS_CELL_TEXT
                                    ? add_texts(name, vector.texts, table->num_rows, npz, error)
                                    : ps_npz_add(npz, &array, error);
    free(vector.values);
    return status;
}

/* ---- fields -------------------------------------------------------------------------------- */

static void put_text(ps_text *out, const char *text) {
    ps_text_append_bytes(out, text, strlen(text) + 1);
}

static void put_fields(ps_text *out, const ps_table *table) {
    char own[PS_TABLE_CELL_BYTES];
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
        put_text(out, ps_table_show(own, &entry->value));
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
    if (stream != NULL) {
        ps_table_write_json(table, false, stream);
    }
    const pspec_status status =
        stream != NULL && fclose(stream) == 0
            ? add_text(text, npz, error)
            : ps_fail(error, PSPEC_ERROR_MEMORY, "not enough memory for a header");
    free(text);
    return status;
}

pspec_status ps_table_add_to_npz(const ps_table *table, ps_npz *npz, ps_error *error) {
    PS_TRY(add_header(table, npz, error));
    PS_TRY(add_fields(table, npz, error));
    PS_TRY(add_kinds(table, npz, error));
    for (size_t i = 0; i < table->num_columns; i++) {
        PS_TRY(add_column(table, i, npz, error));
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
