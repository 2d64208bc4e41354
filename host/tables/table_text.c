/* Tables for people: header lines, then columns side by side, numbers to the right, with as many
 * digits as are read at a glance; or each row as a block of lines, where there are many columns and
 * few rows. A view makes it fit a terminal. What programs read is CSV or JSON. */
#include "tables/table_cells.h"
#include "tables/table_rows.h"

#include <string.h>

/* ---- blocks ------------------------------------------------------------------------------ */

static void print_blocks(const ps_table *table, FILE *stream) {
    const size_t width = table->view.width > 0 ? table->view.width : SIZE_MAX;
    size_t widest = 0;
    for (size_t i = 0; i < table->num_columns; i++) {
        const size_t length = strlen(table->columns[i]);
        widest = length > widest ? length : widest;
    }
    for (size_t i = 0; i < table->num_rows * table->num_columns; i++) {
        char own[PS_CELL_BYTES];
        const char *const name = table->columns[i % table->num_columns];
        if (i > 0 && i % table->num_columns == 0) {
            putc('\n', stream);
        }
        fprintf(stream, "%-*s  ", (int)widest, name);
        ps_places_wrap(ps_cell_show(own, name, &table->cells[i], PS_TEXT_DIGITS), widest + 2,
                       widest + 2, width, SIZE_MAX, stream);
    }
}

pspec_status ps_table_write_text(const ps_table *table, FILE *stream, ps_error *error) {
    size_t num_shown = 0;
    PS_TRY(ps_table_write_head(table, &num_shown, stream, error));
    if (num_shown > 0 && table->num_rows > 0) {
        putc('\n', stream);
    }
    if (table->num_rows > 0 && table->has_blocks) {
        print_blocks(table, stream);
    } else if (table->num_rows > 0) {
        PS_TRY(ps_table_write_columns(table, stream, error));
    }
    if (num_shown < table->num_meta) {
        fprintf(stream, "\n%zu more lines of the header: %s\n", table->num_meta - num_shown,
                table->view.rest);
    }
    return PSPEC_OK;
}
