/* Result tables, the named fields of an answer: header lines, columns, rows; written as CSV, JSON,
 * JSON lines, NPY, NPZ or text. Arrays of any shape beside them are in NPZ alone, and in files of
 * their own.
 *
 * CSV: "# key: value" header lines, one line of column names, one line per row, shortest digits; a
 * missing number is an empty field. JSON: {"schema": 3, "command", "meta", "columns", "rows"}, each
 * row an object by the names of the columns, each value of "meta" the array of all that its key
 * has; missing is null. JSON lines: a line with all but the rows, then a line for each row. NPY:
 * float64 [rows][columns], missing is nan, and a JSON file of the same name (out.npy: out.json)
 * holds the rest. NPZ: each column a vector by its name, int64 where all of its cells are integers,
 * text where one of them is, else float64 with nan for what is missing; what that JSON file has, as
 * the array "meta"; "fields" and "cell_kinds", by which it is read back (table_rows.h). A number
 * that is nan counts as missing. JSON has no infinities: null. Text is for
 * people (table_text.c): few digits, units for seconds and bytes.
 */
#ifndef PS_FIELDS_TABLE_H
#define PS_FIELDS_TABLE_H

#include "base/status.h"
#include "files/npy_array.h"
#include "files/packed/npz.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum ps_cell_kind {
    PS_CELL_MISSING = 0,
    PS_CELL_NUMBER,
    PS_CELL_INTEGER,
    PS_CELL_TEXT
} ps_cell_kind;

typedef struct ps_cell {
    ps_cell_kind kind;
    double number;
    int64_t integer;
    const char *text; /* borrowed while the cell is passed; copied by ps_table_add_row */
} ps_cell;

#define PS_NUMBER(value) ((ps_cell){PS_CELL_NUMBER, (value), 0, NULL})
#define PS_INTEGER(value) ((ps_cell){PS_CELL_INTEGER, 0, (int64_t)(value), NULL})
#define PS_TEXT(value) ((ps_cell){PS_CELL_TEXT, 0, 0, (value)})
#define PS_MISSING ((ps_cell){PS_CELL_MISSING, 0, 0, NULL})

/* Of tables in files, in headers as `schema`. 1: rows were arrays, and single values of "meta"
 * none. */
enum { PS_TABLE_SCHEMA = 3 };

typedef struct ps_table ps_table;

typedef enum ps_table_format {
    PS_FORMAT_CSV = 0,
    PS_FORMAT_JSON,
    PS_FORMAT_NPY,
    PS_FORMAT_JSONL,
    PS_FORMAT_TEXT,
    PS_FORMAT_NPZ
} ps_table_format;

/* The names of the columns are copied. */
pspec_status ps_table_create(ps_table **out, const char *command, const char *const *columns,
                             size_t num_columns, ps_error *error) PS_MUST_CHECK;
/* Header entries, kept in order; the same key may occur several times (CSV: several lines; JSON: an
 * array). A value of kind missing is written as an empty value / null. */
pspec_status ps_table_add_meta(ps_table *table, const char *key, ps_cell value,
                               ps_error *error) PS_MUST_CHECK;
/* In JSON, where the key of a single value may come several times: all values of it are an array,
 * however many there are. */
void ps_table_set_repeated(ps_table *table, const char *key);
/* Another value for the first header entry of that key, which there is. */
pspec_status ps_table_set_meta(ps_table *table, const char *key, ps_cell value,
                               ps_error *error) PS_MUST_CHECK;
/* Several of them. */
typedef struct ps_meta {
    const char *key;
    ps_cell value;
} ps_meta;
pspec_status ps_table_add_metas(ps_table *table, const ps_meta *entries, size_t num,
                                ps_error *error) PS_MUST_CHECK;
pspec_status ps_table_add_row(ps_table *table, const ps_cell *cells, ps_error *error) PS_MUST_CHECK;
/* An array beside the columns, which no other has the name of. Its data belong to the table from
 * then on, also after an error. is_state: what the rest of the table can be made of again. */
pspec_status ps_table_add_array(ps_table *table, const char *name, bool is_state,
                                const ps_npy_array *array, ps_error *error) PS_MUST_CHECK;
/* As text, a block of lines for each row: for many columns and few rows. */
void ps_table_set_blocks(ps_table *table);
/* As text, so that it fits a terminal. {0}: all header lines, and columns however wide. */
typedef struct ps_text_view {
    size_t width;      /* of a line; 0: any */
    size_t most_lines; /* of the header; 0: any */
    const char *const
        *keys;        /* of the header, those first that are to be seen first; NULL ends it */
    const char *rest; /* what shows the other lines, for a last line that counts them */
} ps_text_view;
void ps_table_set_view(ps_table *table, const ps_text_view *view);
/* The names of the formats, "one|two", the default first: without NPY where rows have words, and
 * without text where they come over minutes. */
const char *ps_table_formats(bool has_words, bool has_late_rows);
/* Format by its name or, with name NULL, by the ending of path (none: CSV). Another ending is
 * PSPEC_ERROR_INVALID_ARGUMENT. */
pspec_status ps_table_choose_format(ps_table_format *out, const char *name, const char *path,
                                    ps_error *error) PS_MUST_CHECK;
/* Writes to path, "-" for standard output (NPY to standard output is refused: it needs two files).
 * NPY of a table with text columns is refused, with the column named. */
pspec_status ps_table_write(const ps_table *table, const char *path, ps_table_format format,
                            ps_error *error) PS_MUST_CHECK;

/* ---- tables whose rows come over minutes: as CSV on standard output every row is there as soon as
 * it is known; files, and other formats, are written at the end, as ps_table_write does */

typedef struct ps_table_stream ps_table_stream;

/* The table has its header lines; it belongs to the caller and stays until the stream is closed or
 * discarded. */
pspec_status ps_table_stream_open(ps_table_stream **out, const ps_table *table, const char *path,
                                  ps_table_format format, ps_error *error) PS_MUST_CHECK;
/* Shows the rows that were added since. */
pspec_status ps_table_stream_update(ps_table_stream *stream, ps_error *error) PS_MUST_CHECK;
/* Writes what is left. The handle is freed in every case and *stream set to NULL. */
pspec_status ps_table_stream_close(ps_table_stream **stream, ps_error *error) PS_MUST_CHECK;
/* A NULL handle is allowed. */
void ps_table_stream_discard(ps_table_stream **stream);

/* ---- NPZ files ------------------------------------------------------------------------------- */

/* The table as arrays of an NPZ file that may have others, none of the name of a column; the header
 * is called so. */
#define PS_TABLE_META "meta"
pspec_status ps_table_add_to_npz(const ps_table *table, ps_npz *npz, ps_error *error) PS_MUST_CHECK;
/* A table as it was written there, to the bit, but for its view. Of other files it is
 * PSPEC_ERROR_INPUT (files/packed/npz.h). */
pspec_status ps_table_take_npz(ps_table **out, const ps_npz_file *file,
                               ps_error *error) PS_MUST_CHECK;
/* Is that a regular file that begins like one of those? */
pspec_status ps_table_is_npz(bool *is_one, const char *path, ps_error *error) PS_MUST_CHECK;
pspec_status ps_table_read_npz(ps_table **out, const char *path, ps_error *error) PS_MUST_CHECK;

/* ---- reading: texts stay as long as the table does; indices must be below the numbers -------- */

const char *ps_table_command(const ps_table *table);
size_t ps_table_num_columns(const ps_table *table);
const char *ps_table_column_name(const ps_table *table, size_t column);
/* The first column of that name; false: there is none. */
bool ps_table_find_column(const ps_table *table, const char *name, size_t *column);
size_t ps_table_num_rows(const ps_table *table);
ps_cell ps_table_cell(const ps_table *table, size_t row, size_t column);
/* Of the first column of that name; missing: there is none. */
ps_cell ps_table_find_cell(const ps_table *table, size_t row, const char *name);
size_t ps_table_num_meta(const ps_table *table);
/* Header entry i, in the order in which they were added. */
ps_cell ps_table_meta(const ps_table *table, size_t i, const char **key);
/* The value of the first header entry of that key; missing: there is none. */
ps_cell ps_table_find_meta(const ps_table *table, const char *key);
size_t ps_table_num_arrays(const ps_table *table);
/* Array i, in the order in which they were added. */
const ps_npy_array *ps_table_array(const ps_table *table, size_t i, const char **name,
                                   bool *is_state);
/* NULL: there is no array of that name. */
const ps_npy_array *ps_table_find_array(const ps_table *table, const char *name);
/* A number, or nan; a text, or "". */
double ps_cell_number(ps_cell cell);
const char *ps_cell_text(ps_cell cell);

/* NULL is allowed. */
void ps_table_destroy(ps_table *table);

#endif
