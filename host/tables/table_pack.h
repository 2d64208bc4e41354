/* A table as bytes, and back: to the bit, with every header entry in its place. For the cache of
 * results; what people and other programs read is CSV, JSON and NPY.
 *
 * The magic, then numbers of 8 bytes, the lowest first, and texts as their length and bytes:
 * command; number of columns and their names; number of header entries, each a key and a cell;
 * number of rows and their cells; number of arrays, each a name, three numbers (complex, state,
 * rank), its shape and its doubles. A cell is one byte, ps_cell_kind, and what belongs to it.
 */
#ifndef PS_TABLES_TABLE_PACK_H
#define PS_TABLES_TABLE_PACK_H

#include "tables/table.h"

/* *bytes is to be freed by the caller. */
pspec_status ps_table_pack(const ps_table *table, void **bytes, size_t *num_bytes,
                           ps_error *error) PS_MUST_CHECK;

/* Any bytes may come; those that no table was packed to are PSPEC_ERROR_INPUT. Memory is in
 * proportion to num_bytes. */
pspec_status ps_table_unpack(ps_table **out, const void *bytes, size_t num_bytes,
                             ps_error *error) PS_MUST_CHECK;

#endif
