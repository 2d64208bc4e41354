/* Tables in NPZ files, read back to the bit. */
#include "base/memory.h"
#include "base/text.h"
#include "files/decimal.h"
#include "files/descriptor.h"
#include "fields/table_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct reader {
    ps_table *table;
    const ps_npz_file *file;
    const char *next, *end; /* of the fields */
    ps_error *error;
} reader;

static pspec_status fail_table(const reader *in, const char *what) {
    return ps_fail(in->error, PSPEC_ERROR_INPUT, "\"%s\" is no table of pointspec: %s",
                   ps_npz_name(in->file), what);
}

static const ps_npz_array *find_bytes(const reader *in, const char *name, unsigned rank) {
    const ps_npz_array *const found = ps_npz_find(in->file, name);
    return found != NULL && found->kind == 'u' && found->rank == rank ? found : NULL;
}

/* ---- texts --------------------------------------------------------------------------------- */

static void put_bits(ps_text *out, unsigned code) {
    const char byte = (char)(unsigned char)code;
    ps_text_append_bytes(out, &byte, 1);
}

/* In UTF-8, up to a NUL; what cannot be a character was a byte. */
static void put_characters(ps_text *out, const char *codes, size_t num) {
    for (size_t i = 0; i < num; i++) {
        const unsigned bits = 6; /* of a byte that goes on */
        uint32_t code = 0;
        memcpy(&code, codes + i * sizeof code, sizeof code);
        if (code == 0) {
            return;
        }
        if (code < 0x80 || code - PS_TABLE_NO_CHARACTER < 0x100) {
            put_bits(out, code);
            continue;
        }
        const unsigned more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
        put_bits(out, (0xff00U >> (more + 1) & 0xffU) | code >> bits * more);
        for (unsigned left = more; left-- > 0;) {
            put_bits(out, 0x80 | (code >> bits * left & 0x3f));
        }
    }
}

/* As ps_decimal_format writes it, with the padding of ps_decimal_parse behind it. */
static bool take_number(const char *text, double *out) {
    const char *const end = ps_decimal_parse(text, out);
    if (end == NULL) {
        *out = text[0] == '-' ? -INFINITY : INFINITY;
        return strcmp(text + (text[0] == '-'), "inf") == 0;
    }
    return *end == '\0';
}

/* The cell of this kind that `show` makes this text of; text: as in take_number. */
static bool take_shown(ps_cell *out, unsigned kind, const char *text) {
    char *end = NULL;
    *out = (ps_cell){.kind = (ps_cell_kind)kind};
    switch (kind) {
    case PS_CELL_MISSING:
        return text[0] == '\0';
    case PS_CELL_NUMBER:
        return take_number(text, &out->number);
    case PS_CELL_INTEGER:
        out->integer = strtoll(text, &end, 10);
        return end != text && *end == '\0';
    case PS_CELL_TEXT:
        out->text = text;
        return true;
    default:
        return false;
    }
}

/* ---- fields -------------------------------------------------------------------------------- */

static pspec_status take_text(reader *in, const char **text) {
    const char *const end = memchr(in->next, '\0', (size_t)(in->end - in->next));
    if (end == NULL) {
        return fail_table(in, "its fields are cut off");
    }
    *text = in->next;
    in->next = end + 1;
    return PSPEC_OK;
}

static pspec_status take_entry(reader *in, unsigned letter) {
    const bool is_repeated = letter >= PS_TABLE_REPEATED;
    const char *key = NULL;
    const char *text = NULL;
    ps_cell value;
    PS_TRY(take_text(in, &key));
    PS_TRY(take_text(in, &text));
    if (!take_shown(&value, letter - (is_repeated ? PS_TABLE_REPEATED : PS_TABLE_SINGLE), text)) {
        return fail_table(in, "an entry of its header is of no known kind");
    }
    PS_TRY(ps_table_add_meta(in->table, key, value, in->error));
    in->table->meta[in->table->num_meta - 1].is_repeated = is_repeated;
    return PSPEC_OK;
}

static pspec_status take_array(reader *in, bool is_state) {
    const char *name = NULL;
    ps_npy_array array;
    PS_TRY(take_text(in, &name));
    const ps_npz_array *const stored = ps_npz_find(in->file, name);
    if (stored == NULL || (stored->kind != 'f' && stored->kind != 'c') ||
        ps_table_find_array(in->table, name) != NULL) {
        return fail_table(in, "an array is not there, or twice");
    }
    PS_TRY(ps_npy_make_array(&array, stored->rank, stored->shape, stored->kind == 'c', in->error));
    memcpy(array.data, stored->data, array.num * stored->element_bytes);
    return ps_table_add_array(in->table, name, is_state, &array, in->error);
}

/* Names of columns come first, and are counted before. */
static pspec_status take_columns(reader *in, const char *command) {
    const char **names = NULL;
    size_t num = 0;
    size_t room = 0;
    pspec_status status = PSPEC_OK;
    while (status == PSPEC_OK && in->next < in->end && *in->next == PS_TABLE_COLUMN) {
        void *memory = names;
        in->next++;
        PS_TRY_OUT(status, ps_grow(&memory, &room, num + 1, sizeof *names, "columns", in->error));
        names = memory;
        status = take_text(in, &names[num++]);
    }
    if (status == PSPEC_OK) {
        status = ps_table_create(&in->table, command, names, num, in->error);
    }
out:
    free(names);
    return status;
}

static pspec_status take_fields(reader *in) {
    const char *version = NULL;
    const char *command = NULL;
    PS_TRY(take_text(in, &version));
    if (strcmp(version, PS_TABLE_FIELDS_VERSION) != 0) {
        return fail_table(in, "it is of another version; save it again");
    }
    PS_TRY(take_text(in, &command));
    PS_TRY(take_columns(in, command));
    while (in->next < in->end) {
        const unsigned letter = (unsigned char)*in->next++;
        if (letter == PS_TABLE_BLOCKS) {
            ps_table_set_blocks(in->table);
        } else if (letter == PS_TABLE_ARRAY || letter == PS_TABLE_STATE) {
            PS_TRY(take_array(in, letter == PS_TABLE_STATE));
        } else {
            PS_TRY(take_entry(in, letter));
        }
    }
    return PSPEC_OK;
}

/* ---- columns ------------------------------------------------------------------------------- */

/* Of a column that has numbers alone. */
static bool take_value(ps_cell *out, unsigned kind, const ps_npz_array *array, size_t row) {
    const double most = 0x1p53; /* of integers in doubles */
    const char *const at = (const char *)array->data + row * array->element_bytes;
    *out = (ps_cell){.kind = (ps_cell_kind)kind};
    if (array->kind == 'i') {
        memcpy(&out->integer, at, sizeof out->integer);
        return kind == PS_CELL_INTEGER;
    }
    memcpy(&out->number, at, sizeof out->number);
    if (kind == PS_CELL_INTEGER && fabs(out->number) <= most) {
        out->integer = (int64_t)out->number;
        out->number = 0;
        return true;
    }
    if (kind == PS_CELL_MISSING) {
        out->number = 0;
        return true;
    }
    return kind == PS_CELL_NUMBER && !isnan(out->number);
}

static pspec_status take_cell(const reader *in, ps_cell *out, unsigned kind,
                              const ps_npz_array *array, size_t row) {
    const size_t width = array->element_bytes / sizeof(uint32_t);
    const char padding[PS_DECIMAL_PADDING] = "";
    ps_text text = {0};
    if (array->kind == 'U') {
        put_characters(&text, (const char *)array->data + row * array->element_bytes, width);
        ps_text_append_bytes(&text, padding, sizeof padding);
    }
    const pspec_status status = ps_text_check(&text, in->error);
    const bool is_good =
        status == PSPEC_OK && (array->kind == 'U' ? take_shown(out, kind, ps_text_string(&text))
                                                  : take_value(out, kind, array, row));
    if (is_good && kind == PS_CELL_TEXT) {
        out->text = text.data; /* of the table */
        return PSPEC_OK;
    }
    ps_text_free(&text);
    PS_TRY(status);
    return is_good ? PSPEC_OK : fail_table(in, "a cell is of no known kind");
}

static pspec_status take_column(const reader *in, size_t column, const uint8_t *kinds) {
    ps_table *const table = in->table;
    const char *const name = table->columns[column];
    const ps_npz_array *const array = ps_npz_find(in->file, name);
    size_t first = 0; /* of that name: memory is in proportion to the file */
    if (!ps_table_find_column(table, name, &first) || first != column || array == NULL ||
        strchr("fiU", array->kind) == NULL || array->rank != 1 ||
        array->shape[0] != table->num_rows) {
        return fail_table(in, "a column has not its rows");
    }
    for (size_t row = 0; row < table->num_rows; row++) {
        const size_t i = row * table->num_columns + column;
        PS_TRY(take_cell(in, &table->cells[i], kinds[i], array, row));
    }
    return PSPEC_OK;
}

static pspec_status take_rows(const reader *in) {
    const ps_npz_array *const kinds = find_bytes(in, PS_TABLE_KINDS, 2);
    ps_table *const table = in->table;
    if (kinds == NULL || kinds->shape[1] != table->num_columns ||
        (table->num_columns == 0 && kinds->shape[0] > 0)) {
        return fail_table(in, "it has not the kinds of its cells");
    }
    const size_t num = kinds->shape[0] * table->num_columns; /* at most as many as bytes */
    PS_TRY(PS_NEW(&table->cells, num, "rows of a table", in->error));
    table->num_rows = kinds->shape[0];
    table->cells_capacity = num;
    for (size_t column = 0; column < table->num_columns; column++) {
        PS_TRY(take_column(in, column, kinds->data));
    }
    return PSPEC_OK;
}

/* ---- all ----------------------------------------------------------------------------------- */

static pspec_status take_table(reader *in) {
    const ps_npz_array *const fields = find_bytes(in, PS_TABLE_FIELDS, 1);
    char *copy = NULL;
    if (fields == NULL) {
        return fail_table(in, "it has no list of fields");
    }
    const size_t num = fields->shape[0];
    PS_TRY(PS_NEW(&copy, num + PS_DECIMAL_PADDING, "fields", in->error));
    memcpy(copy, fields->data, num);
    in->next = copy;
    in->end = copy + num;
    pspec_status status = take_fields(in);
    if (status == PSPEC_OK) {
        status = take_rows(in);
    }
    free(copy);
    return status;
}

pspec_status ps_table_take_npz(ps_table **out, const ps_npz_file *file, ps_error *error) {
    reader in = {.file = file, .error = error};
    const pspec_status status = take_table(&in);
    if (status != PSPEC_OK) {
        ps_table_destroy(in.table);
        in.table = NULL;
    }
    *out = in.table;
    return status;
}

/* Its first array is the header. */
pspec_status ps_table_is_npz(bool *is_one, const char *path, ps_error *error) {
    enum { NAME = 30 }; /* where the name stands in a zip archive */
    static const char name[] = PS_TABLE_META ".npy";
    char bytes[NAME + sizeof name - 1];
    struct stat facts;
    size_t count = 0;
    const int descriptor = ps_descriptor_open(path);
    if (descriptor < 0) {
        return ps_read_fail(path, error);
    }
    pspec_status status = fstat(descriptor, &facts) == 0 ? PSPEC_OK : ps_read_fail(path, error);
    if (status == PSPEC_OK && S_ISREG(facts.st_mode)) {
        status = ps_descriptor_read(descriptor, path, bytes, sizeof bytes, &count, error);
    }
    close(descriptor);
    *is_one = status == PSPEC_OK && count == sizeof bytes && memcmp(bytes, "PK", 2) == 0 &&
              memcmp(bytes + NAME, name, sizeof name - 1) == 0;
    return status;
}

pspec_status ps_table_read_npz(ps_table **out, const char *path, ps_error *error) {
    ps_npz_file *file = NULL;
    *out = NULL;
    const int descriptor = ps_descriptor_open(path);
    if (descriptor < 0) {
        return ps_read_fail(path, error);
    }
    pspec_status status = ps_npz_read(&file, descriptor, path, PS_NPZ_LIMIT, error);
    close(descriptor);
    if (status == PSPEC_OK) {
        status = ps_table_take_npz(out, file, error);
    }
    ps_npz_free(file);
    return status;
}
