/* Tables as CSV (RFC 4180, after "# key: value" lines), as JSON (RFC 8259), one row per line, and as
 * JSON lines. */
#include "base/text.h"
#include "files/decimal.h"
#include "fields/table_rows.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

static void print_number(double number, FILE *stream) {
    char text[PS_DECIMAL_BYTES];
    ps_decimal_format(text, number);
    fputs(text, stream);
}

/* ---- CSV ---- */

/* Quotes a field that would not be one otherwise. A '#' in front would look like a header line. */
static void print_csv_text(const char *text, FILE *stream) {
    if (strpbrk(text, ",\"\r\n") == NULL && text[0] != '#') {
        fputs(text, stream);
        return;
    }
    putc('"', stream);
    for (; *text != '\0'; text++) {
        if (*text == '"') {
            putc('"', stream);
        }
        putc(*text, stream);
    }
    putc('"', stream);
}

/* A header line has no quotes: whatever would end it is written as an escape. */
static void print_header_text(const char *text, FILE *stream) {
    for (; *text != '\0'; text++) {
        if (*text == '\n') {
            fputs("\\n", stream);
        } else if (*text == '\r') {
            fputs("\\r", stream);
        } else {
            putc(*text, stream);
        }
    }
}

static void print_csv_cell(const ps_cell *cell, void (*print_text)(const char *, FILE *),
                           FILE *stream) {
    switch (cell->kind) {
    case PS_CELL_MISSING:
        break;
    case PS_CELL_NUMBER:
        print_number(cell->number, stream);
        break;
    case PS_CELL_INTEGER:
        fprintf(stream, "%" PRId64, cell->integer);
        break;
    case PS_CELL_TEXT:
        print_text(cell->text, stream);
        break;
    }
}

void ps_table_write_csv_head(const ps_table *table, FILE *stream) {
    for (size_t i = 0; i < table->num_meta; i++) {
        fputs("# ", stream);
        print_header_text(table->meta[i].key, stream);
        fputs(": ", stream);
        print_csv_cell(&table->meta[i].value, print_header_text, stream);
        putc('\n', stream);
    }
    for (size_t i = 0; i < table->num_columns; i++) {
        print_csv_text(table->columns[i], stream);
        putc(i + 1 < table->num_columns ? ',' : '\n', stream);
    }
}

void ps_table_write_csv_rows(const ps_table *table, size_t first_row, FILE *stream) {
    for (size_t row = first_row; row < table->num_rows; row++) {
        for (size_t i = 0; i < table->num_columns; i++) {
            print_csv_cell(&table->cells[row * table->num_columns + i], print_csv_text, stream);
            putc(i + 1 < table->num_columns ? ',' : '\n', stream);
        }
    }
}

/* ---- JSON ---- */

static void print_json_text(const char *text, FILE *stream) {
    putc('"', stream);
    while (*text != '\0') {
        fputs(ps_text_next_json(&text).text, stream);
    }
    putc('"', stream);
}

static void print_json_cell(const ps_cell *cell, FILE *stream) {
    if (cell->kind == PS_CELL_TEXT) {
        print_json_text(cell->text, stream);
    } else if (cell->kind == PS_CELL_INTEGER) {
        fprintf(stream, "%" PRId64, cell->integer);
    } else if (cell->kind == PS_CELL_NUMBER && isfinite(cell->number)) {
        print_number(cell->number, stream);
    } else {
        fputs("null", stream);
    }
}

/* The entry with the same key that comes next after i, or num_meta. */
static size_t find_same_key(const ps_table *table, size_t i) {
    const char *const key = table->meta[i].key;
    do {
        i++;
    } while (i < table->num_meta && strcmp(table->meta[i].key, key) != 0);
    return i;
}

static bool is_first_of_key(const ps_table *table, size_t i) {
    for (size_t j = 0; j < i; j++) {
        if (strcmp(table->meta[j].key, table->meta[i].key) == 0) {
            return false;
        }
    }
    return true;
}

/* The value of a key, or all its values in an array. */
static void print_json_entry(const ps_table *table, size_t i, FILE *stream) {
    size_t next = find_same_key(table, i);
    const bool is_array = table->meta[i].is_repeated || next < table->num_meta;
    print_json_text(table->meta[i].key, stream);
    fputs(is_array ? ": [" : ": ", stream);
    print_json_cell(&table->meta[i].value, stream);
    for (; next < table->num_meta; next = find_same_key(table, next)) {
        fputs(", ", stream);
        print_json_cell(&table->meta[next].value, stream);
    }
    fputs(is_array ? "]" : "", stream);
}

/* What stands between parts: on lines of their own, or all on one. */
typedef struct json_spaces {
    const char *begin, *part, *entry, *end_entries;
} json_spaces;
static const json_spaces on_lines = {"\n  ", ",\n  ", "\n    ", "\n  "};
static const json_spaces on_one_line = {"", ", ", "", ""};

static void print_json_head(const ps_table *table, const json_spaces *spaces, FILE *stream) {
    fprintf(stream, "{%s\"schema\": %d%s\"command\": ", spaces->begin, PS_TABLE_SCHEMA,
            spaces->part);
    print_json_text(table->command, stream);
    fprintf(stream, "%s\"meta\": {", spaces->part);
    for (size_t i = 0; i < table->num_meta; i++) {
        if (is_first_of_key(table, i)) {
            fprintf(stream, "%s%s", i > 0 ? spaces == &on_lines ? "," : ", " : "", spaces->entry);
            print_json_entry(table, i, stream);
        }
    }
    fprintf(stream, "%s}%s\"columns\": [", spaces->end_entries, spaces->part);
    for (size_t i = 0; i < table->num_columns; i++) {
        fputs(i > 0 ? ", " : "", stream);
        print_json_text(table->columns[i], stream);
    }
    putc(']', stream);
}

static void print_json_row(const ps_table *table, size_t row, FILE *stream) {
    for (size_t i = 0; i < table->num_columns; i++) {
        fputs(i > 0 ? ", " : "{", stream);
        print_json_text(table->columns[i], stream);
        fputs(": ", stream);
        print_json_cell(&table->cells[row * table->num_columns + i], stream);
    }
    putc('}', stream);
}

static void print_json_rows(const ps_table *table, FILE *stream) {
    fputs(",\n  \"rows\": [", stream);
    for (size_t row = 0; row < table->num_rows; row++) {
        fputs(row > 0 ? ",\n    " : "\n    ", stream);
        print_json_row(table, row, stream);
    }
    fputs("\n  ]", stream);
}

void ps_table_write_json(const ps_table *table, bool with_rows, FILE *stream) {
    print_json_head(table, &on_lines, stream);
    if (with_rows) {
        print_json_rows(table, stream);
    }
    fputs("\n}\n", stream);
}

void ps_table_write_jsonl(const ps_table *table, FILE *stream) {
    print_json_head(table, &on_one_line, stream);
    fputs("}\n", stream);
    for (size_t row = 0; row < table->num_rows; row++) {
        print_json_row(table, row, stream);
        putc('\n', stream);
    }
}
