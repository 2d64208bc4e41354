#include "fields/table.h"

#include "base/memory.h"
#include "base/text.h"
#include "files/npy.h"
#include "files/output_file.h"
#include "fields/table_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* ---- building ---- */

static pspec_status copy_text(char **out, const char *text, ps_error *error) {
    *out = strdup(text != NULL ? text : "");
    return *out != NULL ? PSPEC_OK
                        : ps_fail(error, PSPEC_ERROR_MEMORY, "not enough memory for text");
}

static pspec_status copy_cell(ps_cell *out, ps_cell cell, ps_error *error) {
    *out = cell;
    out->text = NULL;
    if (cell.kind == PS_CELL_TEXT) {
        char *text = NULL;
        PS_TRY(copy_text(&text, cell.text, error));
        out->text = text;
    }
    if (cell.kind == PS_CELL_NUMBER && isnan(cell.number)) {
        out->kind = PS_CELL_MISSING;
    }
    return PSPEC_OK;
}

static void free_cell(const ps_cell *cell) {
    free((void *)(uintptr_t)cell->text); /* const for the callers that pass cells */
}

static pspec_status copy_columns(ps_table *table, const char *const *columns, size_t num_columns,
                                 ps_error *error) {
    PS_TRY(PS_NEW(&table->columns, num_columns, "columns", error));
    while (table->num_columns < num_columns) { /* counts those that are to be freed */
        PS_TRY(copy_text(&table->columns[table->num_columns], columns[table->num_columns], error));
        table->num_columns++;
    }
    return PSPEC_OK;
}

pspec_status ps_table_create(ps_table **out, const char *command, const char *const *columns,
                             size_t num_columns, ps_error *error) {
    *out = NULL;
    ps_table *table = NULL;
    PS_TRY(PS_NEW(&table, 1, "table", error));
    pspec_status status = copy_columns(table, columns, num_columns, error);
    if (status == PSPEC_OK) {
        status = copy_text(&table->command, command, error);
    }
    if (status != PSPEC_OK) {
        ps_table_destroy(table);
        return status;
    }
    *out = table;
    return PSPEC_OK;
}

pspec_status ps_table_add_meta(ps_table *table, const char *key, ps_cell value, ps_error *error) {
    void *memory = table->meta;
    PS_TRY(ps_grow(&memory, &table->meta_capacity, table->num_meta + 1, sizeof(ps_table_entry),
                   "header of a table", error));
    table->meta = memory;
    ps_table_entry *const entry = &table->meta[table->num_meta];
    *entry = (ps_table_entry){0};
    PS_TRY(copy_text(&entry->key, key, error));
    const pspec_status status = copy_cell(&entry->value, value, error);
    if (status != PSPEC_OK) {
        free(entry->key);
        return status;
    }
    table->num_meta++;
    return PSPEC_OK;
}

void ps_table_set_repeated(ps_table *table, const char *key) {
    for (size_t i = 0; i < table->num_meta; i++) {
        table->meta[i].is_repeated |= strcmp(table->meta[i].key, key) == 0;
    }
}

pspec_status ps_table_set_meta(ps_table *table, const char *key, ps_cell value, ps_error *error) {
    ps_cell copy;
    size_t i = 0;
    while (strcmp(table->meta[i].key, key) != 0) {
        i++;
    }
    PS_TRY(copy_cell(&copy, value, error));
    free_cell(&table->meta[i].value);
    table->meta[i].value = copy;
    return PSPEC_OK;
}

pspec_status ps_table_add_metas(ps_table *table, const ps_meta *entries, size_t num,
                                ps_error *error) {
    for (size_t i = 0; i < num; i++) {
        PS_TRY(ps_table_add_meta(table, entries[i].key, entries[i].value, error));
    }
    return PSPEC_OK;
}

pspec_status ps_table_add_row(ps_table *table, const ps_cell *cells, ps_error *error) {
    const size_t first = table->num_rows * table->num_columns;
    void *memory = table->cells;
    PS_TRY(ps_grow(&memory, &table->cells_capacity, first + table->num_columns, sizeof(ps_cell),
                   "rows of a table", error));
    table->cells = memory;
    for (size_t i = 0; i < table->num_columns; i++) {
        const pspec_status status = copy_cell(&table->cells[first + i], cells[i], error);
        if (status != PSPEC_OK) {
            while (i > 0) {
                free_cell(&table->cells[first + --i]);
            }
            return status;
        }
    }
    table->num_rows++;
    return PSPEC_OK;
}

static pspec_status add_array(ps_table *table, const char *name, bool is_state,
                              const ps_npy_array *array, ps_error *error) {
    void *memory = table->arrays;
    PS_TRY(ps_grow(&memory, &table->arrays_capacity, table->num_arrays + 1,
                   sizeof(ps_table_array_entry), "arrays of a table", error));
    table->arrays = memory;
    ps_table_array_entry *const entry = &table->arrays[table->num_arrays];
    *entry = (ps_table_array_entry){.is_state = is_state, .values = *array};
    PS_TRY(copy_text(&entry->name, name, error));
    table->num_arrays++;
    return PSPEC_OK;
}

pspec_status ps_table_add_array(ps_table *table, const char *name, bool is_state,
                                const ps_npy_array *array, ps_error *error) {
    const pspec_status status = add_array(table, name, is_state, array, error);
    if (status != PSPEC_OK) {
        free(array->data);
    }
    return status;
}

void ps_table_destroy(ps_table *table) {
    if (table == NULL) {
        return;
    }
    for (size_t i = 0; i < table->num_meta; i++) {
        free(table->meta[i].key);
        free_cell(&table->meta[i].value);
    }
    for (size_t i = 0; i < table->num_rows * table->num_columns; i++) {
        free_cell(&table->cells[i]);
    }
    for (size_t i = 0; i < table->num_columns; i++) {
        free(table->columns[i]);
    }
    for (size_t i = 0; i < table->num_arrays; i++) {
        free(table->arrays[i].name);
        ps_npy_array_free(&table->arrays[i].values);
    }
    free(table->arrays);
    free(table->meta);
    free(table->cells);
    free(table->columns);
    free(table->command);
    free(table);
}

/* ---- reading ---- */

const char *ps_table_command(const ps_table *table) {
    return table->command;
}

size_t ps_table_num_columns(const ps_table *table) {
    return table->num_columns;
}

const char *ps_table_column_name(const ps_table *table, size_t column) {
    return table->columns[column];
}

bool ps_table_find_column(const ps_table *table, const char *name, size_t *column) {
    for (size_t i = 0; i < table->num_columns; i++) {
        if (strcmp(table->columns[i], name) == 0) {
            *column = i;
            return true;
        }
    }
    return false;
}

void ps_table_set_blocks(ps_table *table) {
    table->has_blocks = true;
}

void ps_table_set_view(ps_table *table, const ps_text_view *view) {
    table->view = *view;
}

size_t ps_table_num_rows(const ps_table *table) {
    return table->num_rows;
}

ps_cell ps_table_cell(const ps_table *table, size_t row, size_t column) {
    return table->cells[row * table->num_columns + column];
}

ps_cell ps_table_find_cell(const ps_table *table, size_t row, const char *name) {
    size_t column = 0;
    return ps_table_find_column(table, name, &column) ? ps_table_cell(table, row, column)
                                                      : PS_MISSING;
}

size_t ps_table_num_meta(const ps_table *table) {
    return table->num_meta;
}

ps_cell ps_table_meta(const ps_table *table, size_t i, const char **key) {
    *key = table->meta[i].key;
    return table->meta[i].value;
}

size_t ps_table_num_arrays(const ps_table *table) {
    return table->num_arrays;
}

const ps_npy_array *ps_table_array(const ps_table *table, size_t i, const char **name,
                                   bool *is_state) {
    *name = table->arrays[i].name;
    *is_state = table->arrays[i].is_state;
    return &table->arrays[i].values;
}

const ps_npy_array *ps_table_find_array(const ps_table *table, const char *name) {
    size_t i = 0;
    while (i < table->num_arrays && strcmp(table->arrays[i].name, name) != 0) {
        i++;
    }
    return i < table->num_arrays ? &table->arrays[i].values : NULL;
}

/* ---- choosing ---- */

/* All formats, the default first: of any table, of numbers alone, of tables that are whole. */
#define FORMATS(any, numbers, whole)                                                               \
    any(CSV, "csv") any(JSON, "json") numbers(NPY, "npy") any(NPZ, "npz") any(JSONL, "jsonl")      \
        whole(TEXT, "text")
#define NAME(id, name) [PS_FORMAT_##id] = (name),
#define WORD(id, name) "|" name
#define NONE(id, name)

static const char *const format_names[] = {FORMATS(NAME, NAME, NAME)};
enum { NUM_FORMATS = sizeof format_names / sizeof format_names[0] };

const char *ps_table_formats(bool has_words, bool has_late_rows) {
    static const char *const words[2][2] = {{FORMATS(WORD, WORD, WORD), FORMATS(WORD, WORD, NONE)},
                                            {FORMATS(WORD, NONE, WORD), FORMATS(WORD, NONE, NONE)}};
    return words[has_words][has_late_rows] + 1; /* behind the first bar */
}

pspec_status ps_table_choose_format(ps_table_format *out, const char *name, const char *path,
                                    ps_error *error) {
    const char *const ending = path != NULL ? ps_output_ending(path) : "";
    *out = PS_FORMAT_CSV;
    for (size_t i = 0; i < NUM_FORMATS; i++) {
        if (name != NULL ? strcmp(name, format_names[i]) == 0
                         : i != PS_FORMAT_TEXT && ending[0] != '\0' &&
                               strcasecmp(ending + 1, format_names[i]) == 0) {
            *out = (ps_table_format)i;
            return PSPEC_OK;
        }
    }
    if (name != NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "format \"%s\" is not known; there are csv, json, jsonl, npy, npz and text",
                       name);
    }
    return ending[0] == '\0' ||
                   strcasecmp(ending, ".gz") == 0 /* refused with a reason of its own */
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "\"%s\": the ending %s is none of .csv, .json, .jsonl, .npy and .npz, by "
                         "which the format is chosen; with --format the name is free",
                         path, ending);
}

/* ---- writing ---- */

static pspec_status to_numbers(const ps_table *table, double **out, ps_error *error) {
    const size_t num_cells = table->num_rows * table->num_columns;
    for (size_t i = 0; i < num_cells; i++) {
        if (table->cells[i].kind == PS_CELL_TEXT) {
            return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                           "column \"%s\" holds text, which NPY cannot; use NPZ, CSV or JSON",
                           table->columns[i % table->num_columns]);
        }
    }
    PS_TRY(PS_NEW(out, num_cells, "table", error));
    for (size_t i = 0; i < num_cells; i++) {
        (*out)[i] = ps_cell_number(table->cells[i]);
    }
    return PSPEC_OK;
}

/* out.npy -> out.json */
static pspec_status open_names(ps_output_file **out, const char *path, ps_error *error) {
    const size_t length = strlen(path);
    const size_t ending = length > 4 && strcasecmp(path + length - 4, ".npy") == 0 ? 4 : 0;
    ps_text name = {0};
    ps_text_append_bytes(&name, path, length - ending);
    ps_text_append(&name, ".json");
    const pspec_status status =
        name.failed ? ps_fail(error, PSPEC_ERROR_MEMORY, "not enough memory for a file name")
                    : ps_output_open(out, ps_text_string(&name), error);
    ps_text_free(&name);
    return status;
}

/* Both files are complete before either gets its name. */
static pspec_status write_npy(const ps_table *table, const char *path, ps_error *error) {
    const size_t shape[] = {table->num_rows, table->num_columns};
    ps_output_file *file = NULL;
    ps_output_file *names = NULL;
    double *numbers = NULL;
    pspec_status status = PSPEC_OK;
    if (strcmp(path, "-") == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "NPY needs a file name: the column names go to a second file beside it");
    }
    PS_TRY_OUT(status, to_numbers(table, &numbers, error));
    PS_TRY_OUT(status, ps_output_open(&file, path, error));
    PS_TRY_OUT(status, open_names(&names, path, error));
    ps_npy_write_header(file, "f8", 2, shape);
    ps_output_write(file, numbers, sizeof *numbers, shape[0] * shape[1]);
    ps_table_write_json(table, false, ps_output_stream(names));
    PS_TRY_OUT(status, ps_output_check(file, error));
    PS_TRY_OUT(status, ps_output_check(names, error));
    PS_TRY_OUT(status, ps_output_commit(&file, error));
    PS_TRY_OUT(status, ps_output_commit(&names, error));
out:
    ps_output_discard(&file);
    ps_output_discard(&names);
    free(numbers);
    return status;
}

pspec_status ps_table_write(const ps_table *table, const char *path, ps_table_format format,
                            ps_error *error) {
    if (format == PS_FORMAT_NPY) {
        return write_npy(table, path, error);
    }
    if (format == PS_FORMAT_NPZ) {
        return ps_table_write_npz(table, path, error);
    }
    ps_output_file *file = NULL;
    pspec_status status = PSPEC_OK;
    PS_TRY(ps_output_open(&file, path, error));
    if (format == PS_FORMAT_JSON) {
        ps_table_write_json(table, true, ps_output_stream(file));
    } else if (format == PS_FORMAT_JSONL) {
        ps_table_write_jsonl(table, ps_output_stream(file));
    } else if (format == PS_FORMAT_TEXT) {
        PS_TRY_OUT(status, ps_table_write_text(table, ps_output_stream(file), error));
    } else {
        ps_table_write_csv_head(table, ps_output_stream(file));
        ps_table_write_csv_rows(table, 0, ps_output_stream(file));
    }
    return ps_output_commit(&file, error);
out:
    ps_output_discard(&file);
    return status;
}

ps_cell ps_table_find_meta(const ps_table *table, const char *key) {
    for (size_t i = 0; i < ps_table_num_meta(table); i++) {
        const char *own = NULL;
        const ps_cell value = ps_table_meta(table, i, &own);
        if (strcmp(own, key) == 0) {
            return value;
        }
    }
    return PS_MISSING;
}
