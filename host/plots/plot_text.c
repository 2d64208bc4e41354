/* Texts and numbers in scripts. */
#include "plots/plot_script.h"

#include "base/text.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* A text constant of gnuplot. Only letters, blanks and whole characters beyond ASCII stand as they
 * are: everything else is an octal number, so that no quote, backslash or backtick is left to be
 * understood; digits, too, which would go on with the number before them. What no text has (control
 * characters, bytes that are not UTF-8) would spoil lines and XML. */
static void print_letters(ps_text *out, const char *text, bool is_escaped) {
    static const char special[] = "^_{}@&~\\";
    while (text != NULL && *text != '\0') {
        const unsigned char byte = (unsigned char)*text;
        const size_t length = ps_text_character(text);
        if (is_escaped && strchr(special, byte) != NULL) {
            ps_text_append(out, "\\134");
        }
        if (length > 1) {
            ps_text_append_bytes(out, text, length);
        } else if (length == 0) {
            ps_text_append(out, "%s", byte < 0x80 ? " " : PS_TEXT_UNKNOWN);
        } else {
            ps_text_append(out, isalpha(byte) || byte == ' ' ? "%c" : "\\%03o", byte);
        }
        text += length > 0 ? length : 1;
    }
}

void ps_script_print_text(ps_text *out, const char *text) {
    ps_text_append(out, "\"");
    print_letters(out, text, false);
    ps_text_append(out, "\"");
}

void ps_script_print_formula(ps_text *out, const char *formula, const char *label) {
    enum { SIZE_BYTES = 32 };
    ps_text_append(out, "\"");
    if (formula != NULL) {
        char size[SIZE_BYTES];
        snprintf(size, sizeof size, "{/*%g ", PS_SCRIPT_FORMULA_SIZE);
        print_letters(out, size, false);
        print_letters(out, formula, false);
        print_letters(out, label != NULL ? "}, " : "}", false);
    }
    print_letters(out, label, true);
    ps_text_append(out, "\"");
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

void ps_script_print_value(ps_text *out, double value) {
    if (isfinite(value)) {
        ps_text_append(out, " %.9g", value);
    } else {
        ps_text_append(out, " NaN");
    }
}
