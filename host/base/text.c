#include "base/text.h"

#include "base/memory.h"
#include "base/process/memory_limit.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void ps_text_append_bytes(ps_text *text, const char *bytes, size_t num_bytes) {
    if (text->failed || num_bytes == 0) { /* bytes may be NULL then */
        return;
    }
    void *data = text->data;
    if (ps_grow(&data, &text->capacity, text->length + num_bytes + 1, 1, "text", NULL) !=
        PSPEC_OK) {
        text->failed = true;
        return;
    }
    text->data = data;
    memcpy(text->data + text->length, bytes, num_bytes);
    text->length += num_bytes;
    text->data[text->length] = '\0';
}

void ps_text_append(ps_text *text, const char *format, ...) {
    va_list arguments;
    va_list again;
    va_start(arguments, format);
    va_copy(again, arguments);
    const int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    char *piece = length >= 0 ? malloc((size_t)length + 1) : NULL;
    if (piece == NULL) {
        text->failed = true;
    } else {
        vsnprintf(piece, (size_t)length + 1, format, again);
        ps_text_append_bytes(text, piece, (size_t)length);
    }
    va_end(again);
    free(piece);
}

void ps_text_append_once(ps_text *list, const char *member, const char *separator) {
    const size_t length = strlen(member);
    for (const char *at = ps_text_string(list); *at != '\0';) {
        const char *const end = strstr(at, separator);
        const size_t own_length = end != NULL ? (size_t)(end - at) : strlen(at);
        if (own_length == length && strncmp(at, member, length) == 0) {
            return;
        }
        at += own_length + (end != NULL ? strlen(separator) : 0);
    }
    if (length > 0) {
        ps_text_append(list, "%s%s", list->length > 0 ? separator : "", member);
    }
}

void ps_text_append_word(ps_text *text, const char *word) {
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                "_-+=:,./@%^";
    ps_text_append(text, " ");
    if (word[0] != '\0' && word[strspn(word, plain)] == '\0') {
        ps_text_append(text, "%s", word);
        return;
    }
    ps_text_append(text, "'");
    for (; *word != '\0'; word++) {
        if (*word == '\'') {
            ps_text_append(text, "'\\''");
        } else {
            ps_text_append_bytes(text, word, 1);
        }
    }
    ps_text_append(text, "'");
}

const char *ps_text_string(const ps_text *text) {
    return text->data != NULL ? text->data : "";
}

pspec_status ps_text_check(const ps_text *text, ps_error *error) {
    return text->failed ? ps_fail(error, PSPEC_ERROR_MEMORY, "not enough memory for text")
                        : PSPEC_OK;
}

pspec_status ps_text_keep(const char **out, ps_pool *pool, ps_text *text, ps_error *error) {
    char *kept = NULL;
    pspec_status status = ps_text_check(text, error);
    if (status == PSPEC_OK) {
        status = PS_POOL_NEW(pool, &kept, text->length + 1, "text", error);
    }
    if (status == PSPEC_OK) {
        memcpy(kept, ps_text_string(text), text->length);
    }
    *out = kept;
    ps_text_free(text);
    return status;
}

void ps_text_free(ps_text *text) {
    free(text->data);
    *text = (ps_text){0};
}

/* Decimal numbers only: strtod also takes leading blanks, hexadecimal digits and names. */
static bool parse_double(const char *text, double *out) {
    char *end = NULL;
    if (text[strspn(text, "0123456789+-.eE")] != '\0') {
        return false;
    }
    *out = strtod(text, &end);
    return end != text && *end == '\0' && isfinite(*out);
}

pspec_status ps_parse_number(const char *text, const char *what, double minimum, double maximum,
                             double *out, ps_error *error) {
    if (!parse_double(text, out)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s: \"%s\" is not a finite number",
                       what, text);
    }
    if (*out < minimum || *out > maximum) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s: %s is not between %g and %g", what,
                       text, minimum, maximum);
    }
    return PSPEC_OK;
}

pspec_status ps_parse_count(const char *text, const char *what, uint64_t minimum, uint64_t maximum,
                            uint64_t *out, ps_error *error) {
    /* Digits alone are read exactly; 1e6 goes through a double, which is exact below 2^53. */
    const double exact_limit = 9007199254740992.0;
    char *end = NULL;
    errno = 0;
    const bool digits_only = text[0] != '\0' && text[strspn(text, "0123456789")] == '\0';
    *out = digits_only ? strtoull(text, &end, 10) : 0;
    double number = 0;
    if (!digits_only) {
        if (!parse_double(text, &number) || number != floor(number)) {
            return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s: \"%s\" is not a whole number",
                           what, text);
        }
        *out = number >= 0 && number < exact_limit ? (uint64_t)number : 0;
    }
    const bool is_out_of_range = errno == ERANGE || number < 0 || number >= exact_limit;
    if (is_out_of_range || *out < minimum || *out > maximum) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s: %s is not between %llu and %llu",
                       what, text, (unsigned long long)minimum, (unsigned long long)maximum);
    }
    return PSPEC_OK;
}

pspec_status ps_parse_size(const char *text, const char *what, uint64_t *out, ps_error *error) {
    static const char units[] = PS_SIZE_UNITS;
    enum { MOST_LETTERS = 40 };
    char number[MOST_LETTERS + 1];
    double value = 0;
    const size_t length = strlen(text);
    const char last = length > 0 ? text[length - 1] : '\0';
    const char upper = last >= 'a' && last <= 'z' ? (char)(last - 'a' + 'A') : last;
    const char *const unit = upper != '\0' ? strchr(units, upper) : NULL;
    const double bytes_of_unit = unit != NULL ? pow(PS_SIZE_STEP, (double)(unit - units + 1)) : 1;
    ps_error ignored = {0};
    snprintf(number, sizeof number, "%.*s", (int)(unit != NULL ? length - 1 : length), text);
    const bool is_size = length <= MOST_LETTERS &&
                         (unit == NULL ? ps_parse_count(text, what, 1, INT64_MAX, out, &ignored)
                                       : ps_parse_number(number, what, 1 / bytes_of_unit,
                                                         (double)INT64_MAX / 2 / bytes_of_unit,
                                                         &value, &ignored)) == PSPEC_OK;
    if (!is_size) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: \"%s\" is not a size above 0, such as 400M, 1.5G or 2e9", what, text);
    }
    *out = unit != NULL ? (uint64_t)(value * bytes_of_unit) : *out;
    return PSPEC_OK;
}

static bool is_same_letter(char a, char b) {
    return tolower((unsigned char)a) == tolower((unsigned char)b);
}

size_t ps_text_distance(const char *a, const char *b) {
    enum { LONGEST = 64 }; /* option and sampler names are far shorter */
    size_t row[LONGEST + 1];
    const size_t a_length = strlen(a);
    const size_t b_length = strlen(b);
    if (a_length > LONGEST || b_length > LONGEST) {
        return LONGEST;
    }
    for (size_t j = 0; j <= b_length; j++) {
        row[j] = j;
    }
    for (size_t i = 1; i <= a_length; i++) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= b_length; j++) {
            const size_t above = row[j];
            size_t best = diagonal + !is_same_letter(a[i - 1], b[j - 1]);
            best = above + 1 < best ? above + 1 : best;
            best = row[j - 1] + 1 < best ? row[j - 1] + 1 : best;
            diagonal = above;
            row[j] = best;
        }
    }
    return row[b_length];
}

bool ps_text_ends_in(const char *text, const char *ending) {
    const size_t length = strlen(text);
    const size_t wanted = strlen(ending);
    return length >= wanted && strcmp(text + length - wanted, ending) == 0;
}

int ps_text_find_word(const char *text, size_t length, const char *words) {
    int index = 0;
    for (const char *word = words; *word != '\0'; index++) {
        const size_t own = strcspn(word, "|");
        if (own == length && strncmp(text, word, length) == 0) {
            return index;
        }
        word += own + (word[own] == '|');
    }
    return -1;
}

void ps_text_keep_nearest(const char *name, const char *known, const char **nearest) {
    if (*nearest == NULL || ps_text_distance(name, known) < ps_text_distance(name, *nearest)) {
        *nearest = known;
    }
}

ps_suggestion ps_text_suggest(const char *typed, const char *known, size_t distance,
                              const char *before, const char *after) {
    /* A slip changes one letter, or two in five of a longer name, so that "powre" is near "power",
     * and three at most, so that "bluenoise" is not near "whitenoise"; and a name may be cut short,
     * to no less than two letters. */
    enum { SLIP = 1, CHANGED = 2, LETTERS = 5, MOST_CHANGED = 3, LEAST_BEGINNING = 2 };
    ps_suggestion out = {""};
    const size_t typed_length = strlen(typed);
    const size_t known_length = strlen(known);
    const size_t length = typed_length > known_length ? typed_length : known_length;
    const bool is_beginning =
        typed_length >= LEAST_BEGINNING && strncmp(typed, known, typed_length) == 0;
    const bool is_slip =
        distance <= SLIP || (distance <= MOST_CHANGED && distance * LETTERS <= length * CHANGED);
    if (is_slip || is_beginning) {
        snprintf(out.text, sizeof out.text, "%s%s%s", before, known, after);
    }
    return out;
}

/* ---- characters -------------------------------------------------------------------------- */

/* The bytes of the UTF-8 character that begins with that byte; 0: none does. */
static size_t count_bytes(unsigned char first) {
    return first < 0x80   ? 1
           : first < 0xc2 ? 0
           : first < 0xe0 ? 2
           : first < 0xf0 ? 3
           : first < 0xf5 ? 4
                          : 0;
}

/* Neither the shortest form nor a half of a pair nor beyond Unicode is a character. */
static bool is_character(uint32_t code, size_t length) {
    static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    return code >= least[length] && code <= 0x10ffff && (code < 0xd800 || code > 0xdfff);
}

size_t ps_text_decode(uint32_t *code, const char *text) {
    const unsigned char first = (unsigned char)text[0];
    const size_t length = count_bytes(first);
    *code = length > 1 ? first & (0xffU >> (length + 1)) : first;
    for (size_t i = 1; i < length; i++) {
        if (((unsigned char)text[i] & 0xc0U) != 0x80) {
            return 0;
        }
        *code = *code << 6 | ((unsigned char)text[i] & 0x3fU);
    }
    return is_character(*code, length) ? length : 0;
}

size_t ps_text_character(const char *text) {
    uint32_t code = 0;
    const size_t length = ps_text_decode(&code, text);
    const bool is_control = code < ' ' || (code >= 0x7f && code <= 0x9f);
    return is_control || (code & 0xfffe) == 0xfffe ? 0 : length; /* the two last of a plane */
}

/* YAML refuses control characters and marks in a file, and takes some breaks of lines for blanks.
 */
static bool is_plain(uint32_t code) {
    return code >= ' ' && (code < 0x7f || code >= 0xa0) && code != 0x2028 && code != 0x2029 &&
           code != 0xfeff && code != 0xfffe && code != 0xffff;
}

ps_json_character ps_text_next_json(const char **text) {
    ps_json_character out = {"\\ufffd"};
    uint32_t code = 0;
    const size_t length = ps_text_decode(&code, *text);
    if (length == 1 && strchr("\"\\", (int)code) != NULL) {
        snprintf(out.text, sizeof out.text, "\\%c", (int)code);
    } else if (length > 0 && is_plain(code)) {
        snprintf(out.text, sizeof out.text, "%.*s", (int)length, *text);
    } else if (length > 0) {
        snprintf(out.text, sizeof out.text, "\\u%04x", (unsigned)code & 0xffffU);
    }
    *text += length > 0 ? length : 1;
    return out;
}
