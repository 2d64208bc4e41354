/* Columns side by side. Where they are wider than a line, names are broken at their underscores,
 * then digits are left out, then texts of the last column stand below their rows; what is wider
 * still comes in parts, one below the other, each of which begins with the columns that say what
 * the rows are. */
#include "base/memory.h"
#include "fields/table_cells.h"
#include "fields/table_rows.h"

#include <stdlib.h>
#include <string.h>

typedef struct column {
    size_t width;
    bool is_text; /* to the left */
    bool is_key;  /* no numbers but whole ones */
} column;

typedef struct layout {
    const ps_table *table;
    size_t width; /* of a line */
    int digits;
    bool stacks_names;
    bool has_notes;     /* texts of the last column stand below */
    size_t num_keys;    /* columns that every part begins with */
    size_t num_columns; /* that stand side by side */
    column *columns;
} layout;

enum { GAP = 2, NOTE_INDENT = 4 };

/* ---- names ------------------------------------------------------------------------------- */

/* The next line of a name, which is broken behind underscores where it is wider than the column. */
static size_t next_piece(const char *name, size_t width) {
    const size_t whole = strlen(name);
    size_t length = 0;
    while (whole > width && length < whole) {
        const size_t behind = length + strcspn(name + length, "_") + 1;
        const size_t end = behind < whole ? behind : whole;
        if (length > 0 && end > width) {
            return length;
        }
        length = end;
    }
    return whole;
}

static size_t count_pieces(const char *name, size_t width) {
    size_t num = 0;
    for (; *name != '\0'; num++) {
        name += next_piece(name, width);
    }
    return num;
}

/* The longest piece, and so the least width. */
static size_t widest_piece(const char *name, bool stacks) {
    size_t widest = 0;
    while (*name != '\0') {
        const size_t length = stacks ? next_piece(name, 1) : strlen(name);
        widest = length > widest ? length : widest;
        name += length;
    }
    return widest;
}

/* ---- layout ------------------------------------------------------------------------------ */

static void measure(layout *self) {
    const ps_table *const table = self->table;
    for (size_t i = 0; i < table->num_columns; i++) {
        self->columns[i] =
            (column){widest_piece(table->columns[i], self->stacks_names), false, true};
    }
    for (size_t i = 0; i < table->num_rows * table->num_columns; i++) {
        char own[PS_CELL_BYTES];
        column *const at = &self->columns[i % table->num_columns];
        const char *const text = ps_cell_show(own, table->columns[i % table->num_columns],
                                              &table->cells[i], self->digits);
        const size_t width = ps_places(text, strlen(text));
        at->width = width > at->width ? width : at->width;
        at->is_text = at->is_text || table->cells[i].kind == PS_CELL_TEXT;
        at->is_key = at->is_key && table->cells[i].kind != PS_CELL_NUMBER;
    }
}

static size_t total_width(const layout *self, size_t first, size_t end) {
    size_t total = 0;
    for (size_t i = first; i < end; i++) {
        total += self->columns[i].width + GAP;
    }
    return total;
}

static bool fits(const layout *self) {
    return self->width == 0 || total_width(self, 0, self->num_columns) <= self->width + GAP;
}

/* The first of the ways to show it that is not too wide, or the last. */
static void choose(layout *self) {
    static const struct {
        int digits;
        bool stacks;
    } ways[] = {{PS_TEXT_DIGITS, false}, {PS_TEXT_DIGITS, true}, {5, true}, {4, true}};
    enum { NUM_WAYS = sizeof ways / sizeof ways[0], WIDE = 20, MOST_KEYS = 3 };
    const size_t last = self->table->num_columns - 1;
    for (size_t i = 0; i < 2 * (size_t)NUM_WAYS && (i == 0 || !fits(self)); i++) {
        self->digits = ways[i % NUM_WAYS].digits;
        self->stacks_names = ways[i % NUM_WAYS].stacks;
        measure(self);
        self->has_notes = i >= NUM_WAYS && last > 0 && self->columns[last].is_text &&
                          self->columns[last].width > WIDE;
        self->num_columns = self->table->num_columns - self->has_notes;
    }
    while (self->num_keys < MOST_KEYS && self->num_keys + 1 < self->num_columns &&
           self->columns[self->num_keys].is_key) {
        self->num_keys++;
    }
}

/* ---- parts ------------------------------------------------------------------------------- */

/* No blanks at the end of a line. */
static void print_place(const column *place, const char *text, size_t length, bool is_last,
                        FILE *stream) {
    const size_t blanks = place->width - ps_places(text, length);
    if (!place->is_text) {
        ps_blanks_print(blanks, stream);
    }
    ps_places_print(text, length, stream);
    if (place->is_text && !is_last) {
        ps_blanks_print(blanks, stream);
    }
    fputs(is_last ? "\n" : "  ", stream);
}

/* The columns of a part: the keys, and those from first on. */
typedef struct part {
    size_t first, end;
} part;

static size_t begin_of(const layout *self, const part *columns) {
    return self->num_keys > 0 ? 0 : columns->first;
}

static size_t skip(const layout *self, const part *columns, size_t i) {
    return i + 1 == self->num_keys ? columns->first : i + 1;
}

/* The text of a column in a line of so many, of which names fill the last ones. */
static const char *find_piece(const layout *self, size_t i, size_t line, size_t num_lines,
                              size_t *length) {
    const size_t width = self->columns[i].width;
    const char *name = self->table->columns[i];
    const size_t above = num_lines - count_pieces(name, width);
    for (size_t j = above; j < line; j++) {
        name += next_piece(name, width);
    }
    *length = line < above ? 0 : next_piece(name, width);
    return name;
}

static void print_names(const layout *self, const part *columns, FILE *stream) {
    size_t num_lines = 1;
    for (size_t i = begin_of(self, columns); i < columns->end; i = skip(self, columns, i)) {
        const size_t num = count_pieces(self->table->columns[i], self->columns[i].width);
        num_lines = num > num_lines ? num : num_lines;
    }
    for (size_t line = 0; line < num_lines; line++) {
        size_t last = 0;
        size_t length = 0;
        for (size_t i = begin_of(self, columns); i < columns->end; i = skip(self, columns, i)) {
            find_piece(self, i, line, num_lines, &length);
            last = length > 0 ? i : last;
        }
        for (size_t i = begin_of(self, columns); i <= last; i = skip(self, columns, i)) {
            const char *const name = find_piece(self, i, line, num_lines, &length);
            print_place(&self->columns[i], name, length, i == last, stream);
        }
    }
}

static void print_row(const layout *self, const part *columns, size_t row, FILE *stream) {
    const ps_table *const table = self->table;
    const ps_cell *const cells = table->cells + row * table->num_columns;
    for (size_t i = begin_of(self, columns); i < columns->end; i = skip(self, columns, i)) {
        char own[PS_CELL_BYTES];
        const char *const text = ps_cell_show(own, table->columns[i], &cells[i], self->digits);
        print_place(&self->columns[i], text, strlen(text), i + 1 == columns->end, stream);
    }
    if (self->has_notes && columns->end == self->num_columns) {
        char own[PS_CELL_BYTES];
        ps_blanks_print(NOTE_INDENT, stream);
        ps_places_wrap(
            ps_cell_show(own, table->columns[columns->end], &cells[columns->end], self->digits),
            NOTE_INDENT, NOTE_INDENT, self->width, SIZE_MAX, stream);
    }
}

/* As many columns as stand beside the keys, and one at least. */
static part next_part(const layout *self, size_t first) {
    part columns = {first, first + 1};
    const size_t keys = total_width(self, 0, self->num_keys);
    while (columns.end < self->num_columns &&
           (self->width == 0 ||
            keys + total_width(self, first, columns.end + 1) <= self->width + GAP)) {
        columns.end++;
    }
    return columns;
}

pspec_status ps_table_write_columns(const ps_table *table, FILE *stream, ps_error *error) {
    layout self = {.table = table, .width = table->view.width};
    PS_TRY(PS_NEW(&self.columns, table->num_columns, "columns", error));
    choose(&self);
    for (size_t first = self.num_keys; first < self.num_columns;) {
        const part columns = next_part(&self, first);
        fputs(first > self.num_keys ? "\n" : "", stream);
        print_names(&self, &columns, stream);
        for (size_t row = 0; row < table->num_rows; row++) {
            print_row(&self, &columns, row, stream);
        }
        first = columns.end;
    }
    free(self.columns);
    return PSPEC_OK;
}
