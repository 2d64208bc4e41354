/* Tables for people: header lines, all of them, or those of the keys that a view names, as many as
 * it has room for; then columns side by side, numbers to the right, with as many digits as are read
 * at a glance, or each row as a block of lines, where there are many columns and few rows. A view
 * makes it fit a terminal. What programs read is CSV or JSON. */
#include "base/text.h"
#include "fields/table_cells.h"
#include "fields/table_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- values ------------------------------------------------------------------------------ */

/* Seconds and bytes of a plan's phases, "powers; at most 0.0014 s; 4e+06 bytes": in the units of the
 * columns. A number of the name of seconds needs no unit behind it. */
static const char *replace_number(char out[PS_CELL_BYTES], const char *text, bool are_seconds) {
    char *end = NULL;
    const double value = strtod(text, &end);
    const bool has_number = end != text && isfinite(value);
    const char *name = NULL;
    if (has_number && strncmp(end, " s", 2) == 0 && (end[2] == ';' || end[2] == '\0')) {
        name = "seconds";
        end += 2;
    } else if (has_number && strncmp(end, " bytes", 6) == 0) {
        name = "bytes";
        end += 6;
    } else if (has_number && are_seconds && *end == '\0') {
        name = "seconds";
    }
    return name != NULL && ps_cell_show_unit(out, name, value) ? end : NULL;
}

static void append_in_units(ps_text *out, const char *text, bool are_seconds) {
    char own[PS_CELL_BYTES];
    for (bool is_start = true; *text != '\0';) {
        const char *const end = is_start ? replace_number(own, text, are_seconds) : NULL;
        is_start = end == NULL && *text == ' ';
        if (end != NULL) {
            ps_text_append(out, "%s", own);
            text = end;
        } else {
            ps_text_append_bytes(out, text++, 1);
        }
    }
}

static void append_value(ps_text *out, const ps_table_entry *entry) {
    char own[PS_CELL_BYTES];
    const bool are_seconds =
        ps_cell_is_named(entry->key, "seconds"); /* "at most 0.42", of a plan */
    const bool has_units = are_seconds || strcmp(entry->key, "phase") == 0;
    if (entry->value.kind == PS_CELL_TEXT && has_units) {
        append_in_units(out, entry->value.text, are_seconds);
    } else {
        ps_text_append(out, "%s", ps_cell_show(own, entry->key, &entry->value, PS_TEXT_DIGITS));
    }
}

/* ---- lines ------------------------------------------------------------------------------- */

/* Is it the first of its key, and have all of these one value? */
static bool is_first(const ps_table *table, size_t i, bool *are_same) {
    ps_text own = {0};
    append_value(&own, &table->meta[i]);
    bool is = true;
    *are_same = true;
    for (size_t j = 0; j < table->num_meta; j++) {
        if (j != i && strcmp(table->meta[j].key, table->meta[i].key) == 0) {
            ps_text other = {0};
            append_value(&other, &table->meta[j]);
            is = is && j > i;
            *are_same = *are_same && strcmp(ps_text_string(&own), ps_text_string(&other)) == 0;
            ps_text_free(&other);
        }
    }
    ps_text_free(&own);
    return is;
}

static bool is_column(const ps_table *table, const char *name) {
    size_t i = 0;
    while (i < table->num_columns && strcmp(table->columns[i], name) != 0) {
        i++;
    }
    return i < table->num_columns;
}

/* "key: value", or "key: one; two" where the table has several, which stand in the order of its
 * questions; nothing where it has none, or where a column of that name has them row by row. *num:
 * how many. */
static void append_line(ps_text *line, const ps_table *table, const char *key, size_t *num) {
    bool are_same = true;
    *num = 0;
    for (size_t i = 0; i < table->num_meta; i++) {
        const ps_table_entry *const entry = &table->meta[i];
        if (strcmp(entry->key, key) != 0 || entry->value.kind == PS_CELL_MISSING) {
            continue;
        }
        if (is_first(table, i, &are_same) || line->length == 0) {
            if (!are_same && is_column(table, key)) {
                return;
            }
            ps_text_append(line, "%s: ", key);
            append_value(line, entry);
        } else if (!are_same) {
            ps_text_append(line, "; ");
            append_value(line, entry);
        }
        ++*num;
    }
}

/* A long sentence takes no more than half of the lines that are left, for others come after it. */
static pspec_status print_line(ps_text *line, const ps_text_view *view, size_t *left, FILE *stream,
                               ps_error *error) {
    enum { INDENT = 2 };
    const pspec_status status = ps_text_check(line, error);
    if (status == PSPEC_OK && line->length > 0) {
        const size_t most = (*left + 1) / 2;
        *left -= ps_places_wrap(ps_text_string(line), 0, INDENT, view->width, most, stream);
    }
    ps_text_free(line);
    return status;
}

static pspec_status print_first(const ps_table *table, size_t *num_shown, FILE *stream,
                                ps_error *error) {
    const ps_text_view *const view = &table->view;
    size_t left = view->most_lines;
    for (size_t i = 0; left > 0 && view->keys[i] != NULL; i++) {
        ps_text line = {0};
        size_t num = 0;
        append_line(&line, table, view->keys[i], &num);
        PS_TRY(print_line(&line, view, &left, stream, error));
        *num_shown += num;
    }
    return PSPEC_OK;
}

static pspec_status write_head(const ps_table *table, size_t *num_shown, FILE *stream,
                               ps_error *error) {
    *num_shown = 0;
    if (table->view.most_lines > 0) {
        return print_first(table, num_shown, stream, error);
    }
    for (size_t i = 0; i < table->num_meta; i++) {
        ps_text line = {0};
        ps_text_append(&line, "%s: ", table->meta[i].key);
        append_value(&line, &table->meta[i]);
        const pspec_status status = ps_text_check(&line, error);
        ps_places_print(ps_text_string(&line), line.length, stream);
        putc('\n', stream);
        ps_text_free(&line);
        PS_TRY(status);
    }
    *num_shown = table->num_meta;
    return PSPEC_OK;
}

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
    PS_TRY(write_head(table, &num_shown, stream, error));
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
