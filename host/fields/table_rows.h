/* What a table holds, for the files that build it and write it. Private to host/fields. */
#ifndef PS_FIELDS_TABLE_ROWS_H
#define PS_FIELDS_TABLE_ROWS_H

#include "fields/table.h"

#include <stdbool.h>
#include <stdio.h>

/* Arrays of an NPZ file beside columns. The fields are bytes, texts that each end in NUL: the
 * version, the command, then a letter before the name of each column and array, before key and
 * value of each entry (and with it the kind of its cell), and one without text. Kinds of cells are
 * [rows][columns]. */
#define PS_TABLE_FIELDS "fields"
#define PS_TABLE_KINDS "cell_kinds"
#define PS_TABLE_FIELDS_VERSION "1"
enum {
    PS_TABLE_SINGLE = '0',
    PS_TABLE_REPEATED = '4',
    PS_TABLE_COLUMN = 'c',
    PS_TABLE_ARRAY = 'a',
    PS_TABLE_STATE = 's',
    PS_TABLE_BLOCKS = 'b',
    PS_TABLE_NO_CHARACTER = 0xdc00 /* added to a byte of a text that is no UTF-8 */
};

typedef struct ps_table_entry {
    char *key;
    ps_cell value; /* its text belongs to the table */
    bool is_repeated;
} ps_table_entry;

typedef struct ps_table_array_entry {
    char *name;
    bool is_state;
    ps_npy_array values;
} ps_table_array_entry;

struct ps_table {
    char *command;
    char **columns; /* names */
    size_t num_columns;
    ps_table_entry *meta;
    size_t num_meta, meta_capacity;
    ps_cell *cells; /* [num_rows][num_columns], texts belong to the table */
    size_t num_rows, cells_capacity;
    ps_table_array_entry *arrays;
    size_t num_arrays, arrays_capacity;
    bool has_blocks; /* as text, a block of lines for each row */
    ps_text_view view;
};

/* All write to a stream, whose errors the caller checks. */
/* Header lines and column names; rows from first_row on. */
void ps_table_write_csv_head(const ps_table *table, FILE *stream);
void ps_table_write_csv_rows(const ps_table *table, size_t first_row, FILE *stream);
/* A line for the head, and one for each row. */
void ps_table_write_jsonl(const ps_table *table, FILE *stream);
/* For people: all of it, and its columns side by side. */
pspec_status ps_table_write_text(const ps_table *table, FILE *stream,
                                 ps_error *error) PS_MUST_CHECK;
pspec_status ps_table_write_columns(const ps_table *table, FILE *stream,
                                    ps_error *error) PS_MUST_CHECK;
void ps_table_write_json(const ps_table *table, bool with_rows, FILE *stream);
pspec_status ps_table_write_npz(const ps_table *table, const char *path,
                                ps_error *error) PS_MUST_CHECK;

#endif
