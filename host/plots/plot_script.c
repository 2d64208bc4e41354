/* What the scripts of all figures share: texts, colours, axes. */
#include "plots/plot_script.h"

#include "base/text.h"

#include <ctype.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

/* Okabe and Ito's colours, which the colour-blind can tell apart; beyond them dashes change. */
static const char *const colours[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                      "#E69F00", "#56B4E9", "#000000"};
enum { NUM_COLOURS = sizeof colours / sizeof colours[0] };

const char ps_script_ticks[] = "set xtics in mirror\nset ytics in mirror\n"
                               "set grid linecolor '#d8d8d8' linewidth 0.8 dashtype solid\n";

/* ---- words ---------------------------------------------------------------------------------- */

/* A text constant of gnuplot. Only letters, blanks and whole characters beyond ASCII stand as they
 * are: everything else is an octal number, so that no quote, backslash or backtick is left to be
 * understood; digits, too, which would go on with the number before them. What no text has (control
 * characters, bytes that are not UTF-8) would spoil lines and XML. */
static void print_letters(const char *text, bool is_escaped, FILE *stream) {
    static const char special[] = "^_{}@&~\\";
    while (text != NULL && *text != '\0') {
        const unsigned char byte = (unsigned char)*text;
        const size_t length = ps_text_character(text);
        if (is_escaped && strchr(special, byte) != NULL) {
            fputs("\\134", stream);
        }
        if (length > 1) {
            fwrite(text, 1, length, stream);
        } else if (length == 0) {
            fputs(byte < 0x80 ? " " : PS_TEXT_UNKNOWN, stream);
        } else if (isalpha(byte) || byte == ' ') {
            putc(byte, stream);
        } else {
            fprintf(stream, "\\%03o", byte);
        }
        text += length > 0 ? length : 1;
    }
}

void ps_script_print_text(const char *text, FILE *stream) {
    putc('"', stream);
    print_letters(text, false, stream);
    putc('"', stream);
}

void ps_script_print_formula(const char *formula, const char *label, FILE *stream) {
    enum { SIZE_BYTES = 32 };
    putc('"', stream);
    if (formula != NULL) {
        char size[SIZE_BYTES];
        snprintf(size, sizeof size, "{/*%g ", PS_SCRIPT_FORMULA_SIZE);
        print_letters(size, false, stream);
        print_letters(formula, false, stream);
        print_letters("}", false, stream);
    }
    print_letters(formula != NULL && label != NULL ? ", " : NULL, false, stream);
    print_letters(label, true, stream);
    putc('"', stream);
}

static size_t character(const char *text) {
    const size_t length = ps_text_character(text);
    return length > 0 ? length : 1; /* a byte that is none */
}

size_t ps_script_count_characters(const char *text) {
    size_t num = 0;
    for (; text != NULL && *text != '\0'; text += character(text)) {
        num++;
    }
    return num;
}

static const char *skip_characters(const char *text, size_t num) {
    for (size_t i = 0; i < num && *text != '\0'; i++) {
        text += character(text);
    }
    return text;
}

const char *ps_script_cut(char cut[PS_SCRIPT_CUT_BYTES], const char *text, size_t most) {
    enum { MOST_CUT = 200, LEAST_CUT = 3 }; /* characters have up to four bytes */
    const size_t num = ps_script_count_characters(text);
    const size_t room = most > MOST_CUT ? MOST_CUT : most < LEAST_CUT ? LEAST_CUT : most;
    if (num <= room) {
        return text;
    }
    const int head = (int)(skip_characters(text, room / 2) - text);
    snprintf(cut, PS_SCRIPT_CUT_BYTES, "%.*s…%s", head, text,
             skip_characters(text, num - (room - 1 - room / 2)));
    return cut;
}

void ps_script_print_value(double value, FILE *stream) {
    if (isfinite(value)) {
        fprintf(stream, " %.9g", value);
    } else {
        fputs(" NaN", stream);
    }
}

void ps_script_print_colour(size_t kind, FILE *stream) {
    fprintf(stream, "linecolor rgb '%s'", colours[kind % NUM_COLOURS]);
}

void ps_script_print_style(size_t kind, FILE *stream) {
    ps_script_print_colour(kind, stream);
    fprintf(stream, " dashtype %zu", kind / NUM_COLOURS % 4 + 1);
}

void ps_script_print_label(const char *axis, const char *label, const char *offset, FILE *stream) {
    fprintf(stream, "set %slabel ", axis);
    ps_script_print_text(label, stream);
    fprintf(stream, " offset %s\n", offset);
}

void ps_script_print_scale(const char *axis, bool is_log, FILE *stream) {
    if (is_log) {
        fprintf(stream, "set logscale %s\nset format %s '10^{%%T}'\n", axis, axis);
    }
}

void ps_script_print_asked(const ps_figure *figure, FILE *stream) {
    const ps_plot_axes *const axes = &figure->axes;
    if (axes->has_x) {
        fprintf(stream, "set xrange [%.9g:%.9g]\n", axes->x[0], axes->x[1]);
    }
    if (axes->has_y) {
        fprintf(stream, "set yrange [%.9g:%.9g]\n", axes->y[0], axes->y[1]);
    }
}

void ps_script_print_margins(const ps_script_box *where, FILE *stream) {
    fprintf(stream,
            "set lmargin at screen %.5f\nset rmargin at screen %.5f\n"
            "set tmargin at screen %.5f\nset bmargin at screen %.5f\n",
            where->left / where->page_width, where->right / where->page_width,
            1 - where->top / where->page_height, 1 - where->bottom / where->page_height);
}

/* ---- places --------------------------------------------------------------------------------- */

bool ps_script_is_shown(const ps_figure *figure, const ps_series *series, size_t place) {
    const double x = series->x[place];
    const double y = series->y[place];
    return isfinite(x) && isfinite(y) && (!figure->is_log_x || x > 0) &&
           (!figure->is_log_y || y > 0);
}

bool ps_script_has_places(const ps_figure *figure, const ps_panel *panel) {
    for (size_t i = 0; i < panel->num_series; i++) {
        for (size_t place = 0; place < panel->series[i].num; place++) {
            if (ps_script_is_shown(figure, &panel->series[i], place)) {
                return true;
            }
        }
    }
    return false;
}

static bool is_place(const ps_figure *figure, const ps_series *series, const double *numbers,
                     size_t place) {
    return place < series->num && isfinite(numbers[place]) &&
           (numbers != series->y || ps_script_is_shown(figure, series, place));
}

bool ps_script_has_lone(const ps_figure *figure, const ps_series *series, const double *numbers) {
    for (size_t i = 0; i < series->num; i++) {
        if (is_place(figure, series, numbers, i) && !is_place(figure, series, numbers, i - 1) &&
            !is_place(figure, series, numbers, i + 1)) {
            return true;
        }
    }
    return false;
}
