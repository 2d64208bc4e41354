#include "store/figures_text.h"

#include "base/memory.h"
#include "device/precision.h"
#include "files/decimal.h"
#include "files/digest.h"

#include "pointspec_version.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MAGIC "pointspec-figures 1 " PS_VERSION

/* What devices can be: from a slow simulator to a rack, and nothing that a planner could stumble
 * over. */
static const double least_rate = 1e3, least_launches = 1, most_rate = 1e18;
static const double least_scale = 1e-3, most_scale = 1e3;

/* ---- names --------------------------------------------------------------------------------- */

/* Names of devices on a line of their own, whatever is in them. */
static void append_name(ps_text *text, const char *key, const char *name) {
    ps_text_append(text, "%s ", key);
    for (; *name != '\0'; name++) {
        const char byte = (unsigned char)*name < ' ' ? '?' : *name;
        ps_text_append_bytes(text, &byte, 1);
    }
    ps_text_append(text, "\n");
}

void ps_figures_append_device(ps_text *text, const ps_device_limits *limits) {
    append_name(text, "device", limits->name);
    append_name(text, "platform", limits->platform);
    append_name(text, "driver", limits->driver);
}

/* ---- writing ------------------------------------------------------------------------------- */

static void append_number(ps_text *text, const char *key, const char *what, double value) {
    char number[PS_DECIMAL_BYTES];
    if (value > 0) {
        ps_decimal_format(number, value);
        ps_text_append(text, "%s %s %s\n", key, what, number);
    }
}

void ps_figures_add_checksum(ps_text *text) {
    char digest[PS_DIGEST_BYTES];
    ps_digest_bytes(ps_text_string(text), text->length, digest);
    ps_text_append(text, "checksum %s\n", digest);
}

pspec_status ps_figures_format(ps_text *text, const ps_figures *figures,
                               const ps_device_limits *limits, ps_error *error) {
    ps_text_append(text, MAGIC "\n");
    ps_figures_append_device(text, limits);
    append_name(text, "date", figures->date);
    append_number(text, "flops", "single", figures->flops[PS_SINGLE]);
    append_number(text, "flops", "double", figures->flops[PS_DOUBLE]);
    append_number(text, "bytes", "copied", figures->copied_bytes);
    append_number(text, "bytes", "sent", figures->sent_bytes);
    append_number(text, "launches", "small", figures->launches);
    for (size_t i = 0; i < figures->num_engines; i++) {
        const ps_engine_figure *row = &figures->engines[i];
        for (int precision = PS_SINGLE; precision <= PS_EXTENDED; precision++) {
            char key[64];
            snprintf(key, sizeof key, "scale %s", row->engine);
            append_number(text, key, ps_precision_name((ps_precision)precision),
                          row->scales[precision]);
        }
    }
    for (size_t i = 0; i < figures->num_host; i++) {
        append_number(text, "host", figures->host[i].kind, figures->host[i].scale);
    }
    PS_TRY(ps_text_check(text, error));
    ps_figures_add_checksum(text);
    return ps_text_check(text, error);
}

/* ---- parsing ------------------------------------------------------------------------------- */

static pspec_status fail(const char *why, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_INPUT, "%s", why);
}

/* A number in the range that ends the line. */
static bool take_number(const char *text, double least, double most, double *out) {
    const char *end = ps_decimal_parse(text, out);
    return end != NULL && *end == '\0' && *out >= least && *out <= most;
}

/* What follows the word and a blank at the beginning of the line; NULL: it begins otherwise. */
static char *after(char *line, const char *word) {
    const size_t length = strlen(word);
    return strncmp(line, word, length) == 0 && line[length] == ' ' ? line + length + 1 : NULL;
}

/* The precision that the text begins with, and what stands behind it. */
static char *take_precision(char *text, int *precision) {
    for (*precision = PS_SINGLE; *precision <= PS_EXTENDED; (*precision)++) {
        char *rest = after(text, ps_precision_name((ps_precision)*precision));
        if (rest != NULL) {
            return rest;
        }
    }
    return NULL;
}

/* Ends the word at the beginning; what follows its blank, NULL when there is no word or no blank.
 */
static char *cut_word(char *text) {
    char *const blank = strchr(text, ' ');
    if (blank == NULL || blank == text) {
        return NULL;
    }
    *blank = '\0';
    return blank + 1;
}

static bool take_scale(ps_figures *figures, char *text) {
    char *const rest = cut_word(text);
    int precision = 0;
    char *const number = rest != NULL ? take_precision(rest, &precision) : NULL;
    ps_engine_figure *const row = number != NULL ? ps_figures_row(figures, text) : NULL;
    return row != NULL && take_number(number, least_scale, most_scale, &row->scales[precision]);
}

/* A line of figures. */
static bool take_line(ps_figures *figures, char *line) {
    char *text = after(line, "date");
    int precision = 0;
    if (text != NULL) {
        const bool fits = strlen(text) < sizeof figures->date;
        snprintf(figures->date, sizeof figures->date, "%s", fits ? text : "");
        return fits;
    }
    if ((text = after(line, "flops")) != NULL) {
        char *const number = take_precision(text, &precision);
        return number != NULL && precision < PS_EXTENDED &&
               take_number(number, least_rate, most_rate, &figures->flops[precision]);
    }
    if ((text = after(line, "bytes copied")) != NULL) {
        return take_number(text, least_rate, most_rate, &figures->copied_bytes);
    }
    if ((text = after(line, "bytes sent")) != NULL) {
        return take_number(text, least_rate, most_rate, &figures->sent_bytes);
    }
    if ((text = after(line, "launches small")) != NULL) {
        return take_number(text, least_launches, most_rate, &figures->launches);
    }
    if ((text = after(line, "host")) != NULL) {
        char *const number = cut_word(text);
        ps_host_figure *const row = number != NULL ? ps_figures_host_row(figures, text) : NULL;
        return row != NULL && take_number(number, least_scale, most_scale, &row->scale);
    }
    text = after(line, "scale");
    return text != NULL && take_scale(figures, text);
}

/* The lines between device and checksum; text is cut into them. */
static pspec_status take_lines(ps_figures *figures, char *text, ps_error *error) {
    while (*text != '\0') {
        char *const end = strchr(text, '\n');
        if (end == NULL) {
            return fail("a line that does not end", error);
        }
        *end = '\0';
        if (!take_line(figures, text)) {
            return fail("a line that is none of its own", error);
        }
        text = end + 1;
    }
    return PSPEC_OK;
}

/* Where the last line begins, if the sum in it is right. */
static pspec_status check_sum(const char *text, size_t length, size_t *body, ps_error *error) {
    static const char key[] = "checksum ";
    char digest[PS_DIGEST_BYTES];
    size_t begin = length > 0 ? length - 1 : 0;
    while (begin > 0 && text[begin - 1] != '\n') {
        begin--;
    }
    ps_digest_bytes(text, begin, digest);
    *body = begin;
    const size_t key_bytes = sizeof key - 1;
    const size_t digest_bytes = strlen(digest);
    const bool is_right = length - begin == key_bytes + digest_bytes + 1 &&
                          memcmp(text + begin, key, key_bytes) == 0 &&
                          memcmp(text + begin + key_bytes, digest, digest_bytes) == 0 &&
                          text[length - 1] == '\n';
    return is_right ? PSPEC_OK : fail("its checksum is wrong", error);
}

/* Version and device at the beginning; *used bytes are theirs. */
static pspec_status check_device(const char *text, const ps_device_limits *limits, size_t *used,
                                 ps_error *error) {
    static const char magic[] = MAGIC "\n";
    ps_text device = {0};
    ps_figures_append_device(&device, limits);
    pspec_status status = ps_text_check(&device, error);
    if (status == PSPEC_OK && strncmp(text, magic, sizeof magic - 1) != 0) {
        status = fail("it is of another version of pointspec", error);
    } else if (status == PSPEC_OK &&
               strncmp(text + sizeof magic - 1, device.data, device.length) != 0) {
        status = fail("it is of another device or driver", error);
    }
    *used = sizeof magic - 1 + device.length;
    ps_text_free(&device);
    return status;
}

static pspec_status parse(ps_figures *figures, char *text, size_t length,
                          const ps_device_limits *limits, ps_error *error) {
    size_t body = 0;
    size_t used = 0;
    PS_TRY(check_sum(text, length, &body, error));
    if (memchr(text, '\0', length) != NULL) {
        return fail("it is no text", error);
    }
    text[body] = '\0';
    PS_TRY(check_device(text, limits, &used, error));
    return take_lines(figures, text + used, error);
}

pspec_status ps_figures_parse(ps_figures *figures, const char *text, size_t length,
                              const ps_device_limits *limits, ps_error *error) {
    char *copy = NULL;
    *figures = (ps_figures){0};
    PS_TRY(PS_NEW(&copy, length + PS_DECIMAL_PADDING, "figures of a device", error));
    memcpy(copy, text, length);
    const pspec_status status = parse(figures, copy, length, limits, error);
    free(copy);
    if (status != PSPEC_OK) {
        *figures = (ps_figures){0};
        return status;
    }
    figures->is_measured = true;
    char digest[PS_DIGEST_BYTES];
    ps_digest_bytes(text, length, digest);
    snprintf(figures->note, sizeof figures->note, "measured on %s (%.16s)", figures->date, digest);
    return PSPEC_OK;
}
