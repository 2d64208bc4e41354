/* Tables for people: header lines, then columns side by side, numbers to the right, with as many
 * digits as are read at a glance; or each row as a block of lines, where there are many columns and
 * few rows. A view makes it fit a terminal. What programs read is CSV or JSON. */
#include "tables/table_cells.h"
#include "tables/table_rows.h"

#include <string.h>

static void print_text(const char *text, FILE *stream) {
    ps_places_print(text, strlen(text), stream);
}

/* ---- blocks ------------------------------------------------------------------------------ */

static void print_blocks(const ps_table *table, FILE *stream) {
    size_t widest = 0;
    for (size_t i = 0; i < table->num_columns; i++) {
        const size_t width = strlen(table->columns[i]);
        widest = width > widest ? width : widest;
    }
    for (size_t i = 0; i < table->num_rows * table->num_columns; i++) {
        char own[PS_CELL_BYTES];
        const char *const name = table->columns[i % table->num_columns];
        if (i > 0 && i % table->num_columns == 0) {
            putc('\n', stream);
        }
        fprintf(stream, "%-*s  ", (int)widest, name);
        print_text(ps_cell_show(own, name, &table->cells[i], PS_TEXT_DIGITS), stream);
        putc('\n', stream);
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
