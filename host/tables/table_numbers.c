/* Numbers out of tables. */
#include "tables/table.h"

#include <math.h>
#include <string.h>

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

void ps_table_read_column(const ps_table *table, const char *name, double *out) {
    size_t column = 0;
    const bool is_there = ps_table_find_column(table, name, &column);
    for (size_t row = 0; row < ps_table_num_rows(table); row++) {
        out[row] = is_there ? ps_cell_number(ps_table_cell(table, row, column)) : NAN;
    }
}
