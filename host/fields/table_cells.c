#include "fields/table_cells.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

/* ---- units ------------------------------------------------------------------------------- */

enum { UNIT_DIGITS = 3 };

typedef struct unit {
    double size;
    const char *name;
} unit;

static const unit seconds[] = {{86400, "days"}, {3600, "h"},  {60, "min"}, {1, "s"},
                               {1e-3, "ms"},    {1e-6, "us"}, {1e-9, "ns"}};
static const unit bytes[] = {{1e12, "TB"}, {1e9, "GB"}, {1e6, "MB"}, {1e3, "kB"}, {1, "B"}};

/* In the largest unit of which there are two, or one where units are powers of ten. */
static void show_in(char out[PS_CELL_BYTES], double value, const unit *units, size_t num,
                    double least) {
    size_t i = 0;
    while (i + 1 < num && fabs(value) < units[i].size * (units[i].size > 1 ? least : 1)) {
        i++;
    }
    if (value == 0) {
        snprintf(out, PS_CELL_BYTES, "0 %s", units == seconds ? "s" : "B");
    } else {
        snprintf(out, PS_CELL_BYTES, "%.*g %s", UNIT_DIGITS, value / units[i].size, units[i].name);
    }
}

bool ps_cell_is_named(const char *name, const char *word) {
    const size_t length = strlen(name);
    const size_t own = strlen(word);
    return length >= own && strcmp(name + length - own, word) == 0 &&
           (length == own || name[length - own - 1] == '_');
}

bool ps_cell_show_unit(char out[PS_CELL_BYTES], const char *name, double value) {
    const double two = 2;
    if (!isfinite(value)) {
        return false;
    }
    if (ps_cell_is_named(name, "seconds")) {
        show_in(out, value, seconds, sizeof seconds / sizeof seconds[0], two);
        return true;
    }
    if (ps_cell_is_named(name, "bytes")) {
        show_in(out, value, bytes, sizeof bytes / sizeof bytes[0], 1);
        return true;
    }
    return false;
}

/* ---- cells ------------------------------------------------------------------------------- */

const char *ps_cell_text(ps_cell cell) {
    return cell.kind == PS_CELL_TEXT ? cell.text : "";
}

double ps_cell_number(ps_cell cell) {
    return cell.kind == PS_CELL_NUMBER    ? cell.number
           : cell.kind == PS_CELL_INTEGER ? (double)cell.integer
                                          : NAN;
}

const char *ps_cell_show(char out[PS_CELL_BYTES], const char *name, const ps_cell *cell,
                         int digits) {
    switch (cell->kind) {
    case PS_CELL_MISSING:
        return "-";
    case PS_CELL_TEXT:
        return cell->text;
    case PS_CELL_INTEGER:
        if (!ps_cell_show_unit(out, name, (double)cell->integer)) {
            snprintf(out, PS_CELL_BYTES, "%" PRId64, cell->integer);
        }
        return out;
    case PS_CELL_NUMBER:
        if (isnan(cell->number)) {
            return "-";
        }
        if (!ps_cell_show_unit(out, name, cell->number)) {
            snprintf(out, PS_CELL_BYTES, "%.*g", digits, cell->number);
        }
        return out;
    }
    return "";
}

/* ---- places ------------------------------------------------------------------------------ */

size_t ps_places(const char *text, size_t num_bytes) {
    size_t places = 0;
    for (size_t i = 0; i < num_bytes; i++) {
        places += ((unsigned char)text[i] & 0xC0) != 0x80;
    }
    return places;
}

void ps_places_print(const char *text, size_t num_bytes, FILE *stream) {
    for (size_t i = 0; i < num_bytes; i++) {
        putc((unsigned char)text[i] < ' ' || text[i] == 0x7f ? '?' : text[i], stream);
    }
}

void ps_blanks_print(size_t num, FILE *stream) {
    fprintf(stream, "%*s", (int)num, "");
}

/* A word on the line that is being filled, or the end of it. */
static void print_word(const char *word, size_t length, bool is_first, FILE *stream) {
    if (stream != NULL) {
        fputs(is_first ? "" : " ", stream);
        ps_places_print(word, length, stream);
    }
}

size_t ps_places_wrap(const char *text, size_t from, size_t indent, size_t width, size_t most,
                      FILE *stream) {
    static const char more[] = "..";
    size_t num_lines = 1;
    size_t used = from;
    bool is_first = true; /* word of its line */
    while (*text != '\0') {
        const size_t length = strcspn(text, " ");
        const size_t places = ps_places(text, length);
        const size_t room = width - (num_lines == most && text[length] != '\0' ? sizeof more : 0);
        if (!is_first && used + 1 + places > room) {
            if (num_lines == most) {
                print_word(more, sizeof more - 1, false, stream);
                break;
            }
            num_lines++;
            used = indent;
            is_first = true;
            if (stream != NULL) {
                putc('\n', stream);
                ps_blanks_print(indent, stream);
            }
        }
        print_word(text, length, is_first, stream);
        used += places + !is_first;
        is_first = false;
        text += length + (text[length] == ' ');
    }
    if (stream != NULL) {
        putc('\n', stream);
    }
    return num_lines;
}
