#include "tables/table_pack.h"

#include "base/memory.h"
#include "base/text.h"
#include "tables/table_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char magic[] = "pstable2"; /* 2: the version */
enum { MAGIC_BYTES = sizeof magic - 1, NUMBER_BYTES = 8, BITS_OF_BYTE = 8 };

/* ---- packing ---- */

static void put_number(ps_text *out, uint64_t number) {
    char bytes[NUMBER_BYTES];
    for (int i = 0; i < NUMBER_BYTES; i++) {
        bytes[i] = (char)(unsigned char)(number >> (BITS_OF_BYTE * i) & 0xFF);
    }
    ps_text_append_bytes(out, bytes, NUMBER_BYTES);
}

static void put_text(ps_text *out, const char *text) {
    const size_t length = strlen(text);
    put_number(out, length);
    ps_text_append_bytes(out, text, length);
}

static void put_cell(ps_text *out, const ps_cell *cell) {
    const char kind = (char)cell->kind;
    uint64_t bits = 0;
    ps_text_append_bytes(out, &kind, 1);
    switch (cell->kind) {
    case PS_CELL_MISSING:
        break;
    case PS_CELL_NUMBER:
        memcpy(&bits, &cell->number, sizeof bits);
        put_number(out, bits);
        break;
    case PS_CELL_INTEGER:
        put_number(out, (uint64_t)cell->integer);
        break;
    case PS_CELL_TEXT:
        put_text(out, cell->text);
        break;
    }
}

static void put_array(ps_text *out, const ps_table_array_entry *array) {
    const ps_npy_array *const values = &array->values;
    put_text(out, array->name);
    put_number(out, values->is_complex);
    put_number(out, array->is_state);
    put_number(out, values->rank);
    for (unsigned axis = 0; axis < values->rank; axis++) {
        put_number(out, values->shape[axis]);
    }
    ps_text_append_bytes(out, (const char *)values->data,
                         values->num * (values->is_complex ? 2 : 1) * sizeof(double));
}

pspec_status ps_table_pack(const ps_table *table, void **bytes, size_t *num_bytes,
                           ps_error *error) {
    ps_text out = {0};
    *bytes = NULL;
    *num_bytes = 0;
    ps_text_append_bytes(&out, magic, MAGIC_BYTES);
    put_text(&out, table->command);
    put_number(&out, table->num_columns);
    for (size_t i = 0; i < table->num_columns; i++) {
        put_text(&out, table->columns[i]);
    }
    put_number(&out, table->num_meta);
    for (size_t i = 0; i < table->num_meta; i++) {
        put_text(&out, table->meta[i].key);
        put_cell(&out, &table->meta[i].value);
    }
    put_number(&out, table->num_rows);
    for (size_t i = 0; i < table->num_rows * table->num_columns; i++) {
        put_cell(&out, &table->cells[i]);
    }
    put_number(&out, table->num_arrays);
    for (size_t i = 0; i < table->num_arrays; i++) {
        put_array(&out, &table->arrays[i]);
    }
    if (out.failed) {
        ps_text_free(&out);
        return ps_fail(error, PSPEC_ERROR_MEMORY, "not enough memory to pack a table");
    }
    *bytes = out.data;
    *num_bytes = out.length;
    return PSPEC_OK;
}

/* ---- unpacking ---- */

typedef struct packed {
    const unsigned char *next;
    size_t left;
} packed;

static pspec_status fail_packed(const char *what, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_INPUT, "this is no packed table: %s", what);
}

static pspec_status take_number(packed *in, uint64_t *number, ps_error *error) {
    *number = 0;
    if (in->left < NUMBER_BYTES) {
        return fail_packed("it ends within a number", error);
    }
    for (int i = 0; i < NUMBER_BYTES; i++) {
        *number |= (uint64_t)in->next[i] << (BITS_OF_BYTE * i);
    }
    in->next += NUMBER_BYTES;
    in->left -= NUMBER_BYTES;
    return PSPEC_OK;
}

/* A number of things that take at least least_bytes each: there cannot be more than fit. */
static pspec_status take_count(packed *in, size_t least_bytes, size_t *count, ps_error *error) {
    uint64_t number = 0;
    PS_TRY(take_number(in, &number, error));
    if (number > in->left / least_bytes) {
        return fail_packed("a number is larger than what follows", error);
    }
    *count = (size_t)number;
    return PSPEC_OK;
}

static pspec_status take_text(packed *in, char **text, ps_error *error) {
    size_t length = 0;
    PS_TRY(take_count(in, 1, &length, error));
    if (memchr(in->next, '\0', length) != NULL) {
        return fail_packed("a text has a NUL inside", error);
    }
    PS_TRY(PS_NEW(text, length + 1, "text", error)); /* zeroed, so it ends in NUL */
    memcpy(*text, in->next, length);
    in->next += length;
    in->left -= length;
    return PSPEC_OK;
}

/* What follows the kind; the text belongs to the table. */
static pspec_status take_value(packed *in, ps_cell *cell, ps_error *error) {
    char *text = NULL;
    uint64_t bits = 0;
    if (cell->kind == PS_CELL_MISSING) {
        return PSPEC_OK;
    }
    if (cell->kind == PS_CELL_TEXT) {
        PS_TRY(take_text(in, &text, error));
        cell->text = text;
        return PSPEC_OK;
    }
    PS_TRY(take_number(in, &bits, error));
    if (cell->kind == PS_CELL_INTEGER) {
        memcpy(&cell->integer, &bits, sizeof bits);
        return PSPEC_OK;
    }
    memcpy(&cell->number, &bits, sizeof bits);
    return isnan(cell->number) ? fail_packed("a number is nan, which tables call missing", error)
                               : PSPEC_OK;
}

static pspec_status take_cell(packed *in, ps_cell *cell, ps_error *error) {
    if (in->left == 0 || *in->next > PS_CELL_TEXT) {
        return fail_packed("a cell is of no known kind, or missing", error);
    }
    cell->kind = (ps_cell_kind)*in->next++;
    in->left--;
    return take_value(in, cell, error);
}

/* The table counts what is allocated, zeroes until it is filled, so that it can be destroyed at any
 * time. */
static pspec_status take_columns(packed *in, ps_table *table, ps_error *error) {
    size_t count = 0;
    PS_TRY(take_count(in, NUMBER_BYTES, &count, error));
    PS_TRY(PS_NEW(&table->columns, count, "columns", error));
    table->num_columns = count;
    for (size_t i = 0; i < count; i++) {
        PS_TRY(take_text(in, &table->columns[i], error));
    }
    return PSPEC_OK;
}

static pspec_status take_meta(packed *in, ps_table *table, ps_error *error) {
    size_t count = 0;
    PS_TRY(take_count(in, NUMBER_BYTES + 1, &count, error));
    PS_TRY(PS_NEW(&table->meta, count, "header of a table", error));
    table->num_meta = table->meta_capacity = count;
    for (size_t i = 0; i < count; i++) {
        PS_TRY(take_text(in, &table->meta[i].key, error));
        PS_TRY(take_cell(in, &table->meta[i].value, error));
    }
    return PSPEC_OK;
}

static pspec_status take_rows(packed *in, ps_table *table, ps_error *error) {
    const size_t num_columns = table->num_columns;
    size_t count = 0;
    PS_TRY(take_count(in, num_columns > 0 ? num_columns : 1, &count, error));
    if (num_columns == 0 && count > 0) {
        return fail_packed("it has rows, but no columns", error);
    }
    const size_t num_cells = count * num_columns; /* at most as many as bytes */
    PS_TRY(PS_NEW(&table->cells, num_cells, "rows of a table", error));
    table->num_rows = count;
    table->cells_capacity = num_cells;
    for (size_t i = 0; i < num_cells; i++) {
        PS_TRY(take_cell(in, &table->cells[i], error));
    }
    return PSPEC_OK;
}

static pspec_status take_shape(packed *in, ps_npy_array *out, bool *is_state, ps_error *error) {
    uint64_t is_complex = 0;
    uint64_t is_kept = 0;
    uint64_t rank = 0;
    PS_TRY(take_number(in, &is_complex, error));
    PS_TRY(take_number(in, &is_kept, error));
    PS_TRY(take_number(in, &rank, error));
    if (rank > PS_NPY_MAX_RANK) {
        return fail_packed("an array has too many axes", error);
    }
    *is_state = is_kept != 0;
    *out = (ps_npy_array){.rank = (unsigned)rank, .num = 1, .is_complex = is_complex != 0};
    for (unsigned axis = 0; axis < out->rank; axis++) {
        uint64_t size = 0;
        PS_TRY(take_number(in, &size, error));
        out->shape[axis] = (size_t)size;
        if (!ps_size_multiply(out->num, out->shape[axis], &out->num)) {
            return fail_packed("an array is larger than what follows", error);
        }
    }
    return PSPEC_OK;
}

static pspec_status take_array(packed *in, ps_table *table, ps_error *error) {
    char *name = NULL;
    ps_npy_array array;
    bool is_state = false;
    size_t num_bytes = 0;
    pspec_status status = take_text(in, &name, error);
    PS_TRY_OUT(status, status);
    PS_TRY_OUT(status, take_shape(in, &array, &is_state, error));
    if (!ps_size_multiply(array.num, (array.is_complex ? 2 : 1) * sizeof(double), &num_bytes) ||
        num_bytes > in->left) {
        PS_TRY_OUT(status, fail_packed("an array is larger than what follows", error));
    }
    PS_TRY_OUT(status, ps_allocate_for(&array.data, num_bytes, 1, "an array", error));
    memcpy(array.data, in->next, num_bytes);
    in->next += num_bytes;
    in->left -= num_bytes;
    status = ps_table_add_array(table, name, is_state, &array, error);
out:
    free(name);
    return status;
}

static pspec_status take_arrays(packed *in, ps_table *table, ps_error *error) {
    size_t count = 0;
    PS_TRY(take_count(in, NUMBER_BYTES, &count, error));
    for (size_t i = 0; i < count; i++) {
        PS_TRY(take_array(in, table, error));
    }
    return PSPEC_OK;
}

static pspec_status take_table(packed *in, ps_table *table, ps_error *error) {
    if (in->left < MAGIC_BYTES || memcmp(in->next, magic, MAGIC_BYTES) != 0) {
        return fail_packed("it begins in another way", error);
    }
    in->next += MAGIC_BYTES;
    in->left -= MAGIC_BYTES;
    PS_TRY(take_text(in, &table->command, error));
    PS_TRY(take_columns(in, table, error));
    PS_TRY(take_meta(in, table, error));
    PS_TRY(take_rows(in, table, error));
    PS_TRY(take_arrays(in, table, error));
    return in->left == 0 ? PSPEC_OK : fail_packed("more follows after its end", error);
}

pspec_status ps_table_unpack(ps_table **out, const void *bytes, size_t num_bytes, ps_error *error) {
    packed in = {bytes, num_bytes};
    ps_table *table = NULL;
    *out = NULL;
    PS_TRY(PS_NEW(&table, 1, "table", error));
    const pspec_status status = take_table(&in, table, error);
    if (status != PSPEC_OK) {
        ps_table_destroy(table);
        return status;
    }
    *out = table;
    return PSPEC_OK;
}
