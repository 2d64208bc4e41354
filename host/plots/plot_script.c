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
    putc('"', stream);
    if (formula != NULL) { /* larger, so that what is raised can be read in small pictures, too */
        print_letters("{/*1.35 ", false, stream);
        print_letters(formula, false, stream);
        print_letters("}", false, stream);
    }
    print_letters(formula != NULL && label != NULL ? ", " : NULL, false, stream);
    print_letters(label, true, stream);
    putc('"', stream);
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
