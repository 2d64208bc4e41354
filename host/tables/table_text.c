/* Tables for people: header lines, then columns side by side, numbers to the right, with as many
 * digits as are read at a glance; or each row as a block of lines, where there are many columns and
 * few rows. What programs read is CSV or JSON. */
#include "base/memory.h"
#include "tables/table_rows.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Digits of a number, and room for it with a unit. */
enum { DIGITS = 6, UNIT_DIGITS = 3, CELL_BYTES = 48 };

/* ---- units ------------------------------------------------------------------------------- */

typedef struct unit {
    double size;
    const char *name;
} unit;

static const unit seconds[] = {{86400, "days"}, {3600, "h"},  {60, "min"}, {1, "s"},
                               {1e-3, "ms"},    {1e-6, "us"}, {1e-9, "ns"}};
static const unit bytes[] = {{1e12, "TB"}, {1e9, "GB"}, {1e6, "MB"}, {1e3, "kB"}, {1, "B"}};

/* In the largest unit of which there are two, or one where units are powers of ten. */
static void show_in(char out[CELL_BYTES], double value, const unit *units, size_t num,
                    double least) {
    size_t i = 0;
    while (i + 1 < num && fabs(value) < units[i].size * (units[i].size > 1 ? least : 1)) {
        i++;
    }
    if (value == 0) {
        snprintf(out, CELL_BYTES, "0 %s", units == seconds ? "s" : "B");
    } else {
        snprintf(out, CELL_BYTES, "%.*g %s", UNIT_DIGITS, value / units[i].size, units[i].name);
    }
}

/* "seconds", or a name that ends in "_seconds". */
static bool is_named(const char *name, const char *word) {
    const size_t length = strlen(name);
    const size_t own = strlen(word);
    return length >= own && strcmp(name + length - own, word) == 0 &&
           (length == own || name[length - own - 1] == '_');
}

static bool shows_unit(char out[CELL_BYTES], const char *name, double value) {
    const double two = 2;
    if (!isfinite(value)) {
        return false;
    }
    if (is_named(name, "seconds")) {
        show_in(out, value, seconds, sizeof seconds / sizeof seconds[0], two);
        return true;
    }
    if (is_named(name, "bytes")) {
        show_in(out, value, bytes, sizeof bytes / sizeof bytes[0], 1);
        return true;
    }
    return false;
}

/* ---- cells ------------------------------------------------------------------------------- */

/* The text of a cell: its own, or what is written to out. */
static const char *show_cell(char out[CELL_BYTES], const char *name, const ps_cell *cell) {
    switch (cell->kind) {
    case PS_CELL_MISSING:
        return "-";
    case PS_CELL_TEXT:
        return cell->text;
    case PS_CELL_INTEGER:
        if (!shows_unit(out, name, (double)cell->integer)) {
            snprintf(out, CELL_BYTES, "%" PRId64, cell->integer);
        }
        return out;
    case PS_CELL_NUMBER:
        if (isnan(cell->number)) {
            return "-";
        }
        if (!shows_unit(out, name, cell->number)) {
            snprintf(out, CELL_BYTES, "%.*g", DIGITS, cell->number);
        }
        return out;
    }
    return "";
}

/* Places that a text takes: a character of UTF-8 takes one. */
static size_t width_of(const char *text) {
    size_t width = 0;
    for (; *text != '\0'; text++) {
        width += ((unsigned char)*text & 0xC0) != 0x80;
    }
    return width;
}

/* Control characters would move the cursor. */
static void print_text(const char *text, FILE *stream) {
    for (; *text != '\0'; text++) {
        putc((unsigned char)*text < ' ' || *text == 0x7f ? '?' : *text, stream);
    }
}

static void print_blanks(size_t num, FILE *stream) {
    fprintf(stream, "%*s", (int)num, "");
}

/* ---- header lines ------------------------------------------------------------------------ */

/* Seconds and bytes of a plan's phases, "powers; at most 0.0014 s; 4e+06 bytes": in the units of the
 * columns. A number of the name of seconds needs no unit behind it. */
static const char *replace_number(char out[CELL_BYTES], const char *text, bool are_seconds) {
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
    return name != NULL && shows_unit(out, name, value) ? end : NULL;
}

static void print_in_units(const char *text, bool are_seconds, FILE *stream) {
    char own[CELL_BYTES];
    char letter[2] = "";
    for (bool is_start = true; *text != '\0';) {
        const char *const end = is_start ? replace_number(own, text, are_seconds) : NULL;
        if (end != NULL) {
            fputs(own, stream);
            text = end;
        } else {
            letter[0] = *text++;
            print_text(letter, stream);
        }
        is_start = letter[0] == ' ';
    }
}

static void print_head(const ps_table *table, FILE *stream) {
    for (size_t i = 0; i < table->num_meta; i++) {
        char own[CELL_BYTES];
        const ps_table_entry *const entry = &table->meta[i];
        print_text(entry->key, stream);
        fputs(": ", stream);
        const bool are_seconds = is_named(entry->key, "seconds"); /* "at most 0.42", of a plan */
        if (entry->value.kind == PS_CELL_TEXT &&
            (are_seconds || strcmp(entry->key, "phase") == 0)) {
            print_in_units(entry->value.text, are_seconds, stream);
        } else {
            print_text(show_cell(own, entry->key, &entry->value), stream);
        }
        putc('\n', stream);
    }
    if (table->num_meta > 0 && table->num_rows > 0) {
        putc('\n', stream);
    }
}

/* ---- columns ----------------------------------------------------------------------------- */

typedef struct column {
    size_t width;
    bool is_text; /* to the left */
} column;

static void measure(const ps_table *table, column *columns) {
    for (size_t i = 0; i < table->num_columns; i++) {
        columns[i] = (column){width_of(table->columns[i]), false};
    }
    for (size_t i = 0; i < table->num_rows * table->num_columns; i++) {
        char own[CELL_BYTES];
        const size_t at = i % table->num_columns;
        const size_t width = width_of(show_cell(own, table->columns[at], &table->cells[i]));
        columns[at].width = width > columns[at].width ? width : columns[at].width;
        columns[at].is_text = columns[at].is_text || table->cells[i].kind == PS_CELL_TEXT;
    }
}

/* No blanks at the end of a line. */
static void print_place(const column *place, const char *text, bool is_last, FILE *stream) {
    const size_t blanks = place->width - width_of(text);
    if (!place->is_text) {
        print_blanks(blanks, stream);
    }
    print_text(text, stream);
    if (place->is_text && !is_last) {
        print_blanks(blanks, stream);
    }
    fputs(is_last ? "\n" : "  ", stream);
}

static void print_columns(const ps_table *table, const column *columns, FILE *stream) {
    const size_t last = table->num_columns - 1;
    for (size_t i = 0; i <= last; i++) {
        print_place(&columns[i], table->columns[i], i == last, stream);
    }
    for (size_t i = 0; i < table->num_rows * table->num_columns; i++) {
        char own[CELL_BYTES];
        const size_t at = i % table->num_columns;
        print_place(&columns[at], show_cell(own, table->columns[at], &table->cells[i]), at == last,
                    stream);
    }
}

/* ---- blocks ------------------------------------------------------------------------------ */

static void print_blocks(const ps_table *table, FILE *stream) {
    column names = {0, true};
    for (size_t i = 0; i < table->num_columns; i++) {
        const size_t width = width_of(table->columns[i]);
        names.width = width > names.width ? width : names.width;
    }
    for (size_t i = 0; i < table->num_rows * table->num_columns; i++) {
        char own[CELL_BYTES];
        const size_t at = i % table->num_columns;
        if (i > 0 && at == 0) {
            putc('\n', stream);
        }
        print_place(&names, table->columns[at], false, stream);
        print_text(show_cell(own, table->columns[at], &table->cells[i]), stream);
        putc('\n', stream);
    }
}

pspec_status ps_table_write_text(const ps_table *table, FILE *stream, ps_error *error) {
    column *columns = NULL;
    print_head(table, stream);
    if (table->num_rows == 0) {
        return PSPEC_OK;
    }
    if (table->has_blocks) {
        print_blocks(table, stream);
        return PSPEC_OK;
    }
    PS_TRY(PS_NEW(&columns, table->num_columns, "columns", error));
    measure(table, columns);
    print_columns(table, columns, stream);
    free(columns);
    return PSPEC_OK;
}
