/** @file
 * Tables: what answers, plans and lists come as. Included by pointspec.h.
 */
#ifndef POINTSPEC_TABLE_H
#define POINTSPEC_TABLE_H

#include "pointspec/context.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Header entries, named columns and rows. Owns all that it points to. */
typedef struct pspec_table pspec_table;

/** @name Tables
 * @{ */

/** What a cell holds. The numbers are never reused. */
typedef enum pspec_cell_kind {
    PSPEC_CELL_MISSING = 0, /**< nothing: not known, or not defined */
    PSPEC_CELL_NUMBER = 1,  /**< a real number */
    PSPEC_CELL_INTEGER = 2, /**< a count, or another whole number */
    PSPEC_CELL_TEXT = 3     /**< words */
} pspec_cell_kind;

/** A cell of a row, or the value of a header entry. */
typedef struct pspec_cell {
    pspec_cell_kind kind; /**< which of the others counts */
    double number;        /**< that of #PSPEC_CELL_NUMBER and #PSPEC_CELL_INTEGER; else nan */
    int64_t integer;      /**< that of #PSPEC_CELL_INTEGER; else 0 */
    const char *text;     /**< that of #PSPEC_CELL_TEXT, which belongs to the table; else NULL */
} pspec_cell;

/** NULL is allowed. */
PSPEC_EXPORT void pspec_table_destroy(pspec_table *table);

/** What the table is of: "power", "angular", ..., "plan". Belongs to the table. */
PSPEC_EXPORT const char *pspec_table_name(const pspec_table *table);

/** Number of rows. */
PSPEC_EXPORT size_t pspec_table_num_rows(const pspec_table *table);
/** Number of columns. */
PSPEC_EXPORT size_t pspec_table_num_columns(const pspec_table *table);
/** The name of a column, which the manual page of the command explains with its unit; NULL where
 * there is no such column. Belongs to the table. */
PSPEC_EXPORT const char *pspec_table_column_name(const pspec_table *table, size_t column);
/** The first column of that name; pspec_table_num_columns() where there is none. */
PSPEC_EXPORT size_t pspec_table_find_column(const pspec_table *table, const char *name);
/** A cell; #PSPEC_CELL_MISSING where there is no such row or column. */
PSPEC_EXPORT pspec_cell pspec_table_cell(const pspec_table *table, size_t row, size_t column);
/** A whole column as numbers, to numbers[num_rows] with room from the caller: nan where a cell is
 * no number, and everywhere where there is no such column. Integers above 2^53 are rounded. */
PSPEC_EXPORT void pspec_table_numbers(const pspec_table *table, size_t column, double *numbers);

/** Number of header entries: what was asked, by which engine it was answered, how exactly. */
PSPEC_EXPORT size_t pspec_table_num_entries(const pspec_table *table);
/** Header entry i, in the order of the file formats, and its key, unless key is NULL: both belong
 * to the table. A key may come several times, as "sampler" where several were asked for. Where
 * there is no such entry *key is NULL and the value missing. */
PSPEC_EXPORT pspec_cell pspec_table_entry(const pspec_table *table, size_t i, const char **key);
/** The value of the first header entry of that key; missing: there is none. */
PSPEC_EXPORT pspec_cell pspec_table_find_entry(const pspec_table *table, const char *key);

/** "", or the sentence with which the program would end in exit status 3: a check found another
 * spectrum than the saved one or sets that are not homogeneous, a record was not repeated, a device
 * is not in order. Belongs to the table. */
PSPEC_EXPORT const char *pspec_table_verdict(const pspec_table *table);

/** Writes the table to a file that appears when it is complete, byte for byte as the program does.
 * format: "csv", "json", "jsonl", "npy", "npz", "text", or NULL: by the ending of path, else csv. NPY is float64
 * [rows][columns], with a JSON file of names and header beside it; NPZ has an array for each column
 * and that JSON text as the array "meta". The context is for the sentence
 * of an error: #PSPEC_ERROR_INVALID_ARGUMENT where there is no such format, for "-" (the library
 * writes no standard output), and for NPY of a table with words; #PSPEC_ERROR_IO where the file
 * cannot be written. */
PSPEC_EXPORT pspec_status pspec_table_write(const pspec_table *table, pspec_context *context,
                                            const char *path, const char *format);

/** @} */

#ifdef __cplusplus
}
#endif

#endif
