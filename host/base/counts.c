#include "base/counts.h"

#include "base/text.h"

#include <string.h>

/* A number is far shorter; what is cut off is none. */
enum { MOST_LETTERS = 63 };

/* What a list is made of, and what is said of it. */
typedef struct list {
    ps_counts *out;
    const char *text, *what; /* the whole of it, for sentences */
    uint64_t minimum, maximum;
    ps_error *error;
} list;

static pspec_status add(const list *self, uint64_t value) {
    ps_counts *const out = self->out;
    for (size_t i = 0; i < out->num; i++) {
        if (out->values[i] == value) {
            return ps_fail(self->error, PSPEC_ERROR_INVALID_ARGUMENT, "%s: %llu stands there twice",
                           self->what, (unsigned long long)value);
        }
    }
    if (out->num == out->most) {
        return ps_fail(self->error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: \"%s\" has more than %zu numbers", self->what, self->text, out->most);
    }
    out->values[out->num++] = value;
    return PSPEC_OK;
}

static pspec_status take_number(const list *self, const char *text, uint64_t *out) {
    return ps_parse_count(text, self->what, self->minimum, self->maximum, out, self->error);
}

/* first and its doubles; what is beyond 2^64 is beyond any last. */
static pspec_status add_range(const list *self, const char *first, const char *last) {
    uint64_t value = 0;
    uint64_t end = 0;
    if (first[0] == '\0' || last[0] == '\0') {
        return ps_fail(self->error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: \"%s\": a range has two ends, as 16..256 has, which is "
                       "16,32,64,128,256",
                       self->what, self->text);
    }
    PS_TRY(take_number(self, first, &value));
    PS_TRY(take_number(self, last, &end));
    if (end < value) {
        return ps_fail(self->error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: \"%s\": the first number is the larger one", self->what, self->text);
    }
    while (value <= end / 2) {
        PS_TRY(add(self, value));
        value *= 2;
    }
    return add(self, value);
}

static pspec_status add_part(const list *self, char *part) {
    static const char dots[] = "..";
    char *const middle = strstr(part, dots);
    uint64_t value = 0;
    if (middle != NULL) {
        middle[0] = '\0';
        return add_range(self, part, middle + sizeof dots - 1);
    }
    if (part[0] == '\0' && self->text[0] != '\0') {
        return ps_fail(self->error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: \"%s\": a number is missing beside a comma", self->what, self->text);
    }
    PS_TRY(take_number(self, part, &value));
    return add(self, value);
}

pspec_status ps_counts_parse(ps_counts *out, const char *text, const char *what, uint64_t minimum,
                             uint64_t maximum, ps_error *error) {
    const list self = {out, text, what, minimum, maximum, error};
    for (const char *at = text;; at++) {
        char part[MOST_LETTERS + 1];
        const size_t length = strcspn(at, ",");
        if (length > MOST_LETTERS) {
            return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s: \"%s\" is not a whole number",
                           what, text);
        }
        memcpy(part, at, length);
        part[length] = '\0';
        PS_TRY(add_part(&self, part));
        at += length;
        if (*at == '\0') {
            return PSPEC_OK;
        }
    }
}
