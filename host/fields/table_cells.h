/* Cells and lines of tables for people, and of their help. */
#ifndef PS_FIELDS_TABLE_CELLS_H
#define PS_FIELDS_TABLE_CELLS_H

#include "fields/table.h"

#include <stdio.h>

/* Digits of a number, and room for it with a unit. */
enum { PS_TEXT_DIGITS = 6, PS_CELL_BYTES = 48 };

/* The text of a cell of a column of this name: its own, or what is written to out. */
const char *ps_cell_show(char out[PS_CELL_BYTES], const char *name, const ps_cell *cell,
                         int digits);
/* Seconds and bytes in the largest unit of which there are enough; false: the name says neither. */
bool ps_cell_show_unit(char out[PS_CELL_BYTES], const char *name, double value);
/* "seconds", or a name that ends in "_seconds". */
bool ps_cell_is_named(const char *name, const char *word);

/* Places that a text takes: a character of UTF-8 takes one. */
size_t ps_places(const char *text, size_t num_bytes);
/* Control characters would move the cursor. */
void ps_places_print(const char *text, size_t num_bytes, FILE *stream);
void ps_blanks_print(size_t num, FILE *stream);
/* Prints a text from where the line is now, column `from`, in lines of `width` places, broken at
 * blanks, that from the second on begin with `indent` of them; after `most` lines it ends in
 * "..". Returns how many lines there are; stream NULL: only that. */
size_t ps_places_wrap(const char *text, size_t from, size_t indent, size_t width, size_t most,
                      FILE *stream);

#endif
