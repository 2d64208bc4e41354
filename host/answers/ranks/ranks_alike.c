/* Ranks of other programs, devices or environments have other bits: they are found before any work.
 */
#include "answers/ranks/ranks_work.h"

#include "base/memory.h"

#include <string.h>

/* The next line, and its thing and value. */
typedef struct line {
    const char *thing, *value;
    int thing_bytes, value_bytes;
} line;

static line next_line(const char **at) {
    const size_t length = strcspn(*at, "\n");
    const char *const colon = memchr(*at, ':', length);
    line out = {*at, *at, (int)length, (int)length};
    if (colon != NULL) {
        out.thing_bytes = (int)(colon - *at);
        out.value = colon + 2;
        out.value_bytes = (int)length - out.thing_bytes - 2;
    }
    *at += length + ((*at)[length] == '\n');
    return out;
}

static bool are_same(const line *a, const line *b) {
    return a->thing_bytes == b->thing_bytes && a->value_bytes == b->value_bytes &&
           memcmp(a->thing, b->thing, (size_t)a->thing_bytes) == 0 &&
           memcmp(a->value, b->value, (size_t)a->value_bytes) == 0;
}

/* In a sentence of one line. */
enum { MOST_SHOWN = 400 };

static int shown_bytes(const line *shown) {
    return shown->value_bytes < MOST_SHOWN ? shown->value_bytes : MOST_SHOWN;
}

static pspec_status compare(const char *first, const char *other, size_t rank, ps_error *error) {
    while (*first != '\0' || *other != '\0') {
        const line a = next_line(&first);
        const line b = next_line(&other);
        if (!are_same(&a, &b)) {
            return ps_fail(error, PSPEC_ERROR_INPUT,
                           "ranks of one job have the same %.*s: that of rank %zu is \"%.*s\", "
                           "that of rank 0 \"%.*s\"",
                           a.thing_bytes, a.thing, rank, shown_bytes(&b), b.value, shown_bytes(&a),
                           a.value);
        }
    }
    return PSPEC_OK;
}

static pspec_status compare_all(ps_ranks *ranks, const char *own, ps_rank_bytes *parts,
                                ps_error *error) {
    for (size_t rank = 1; rank < ps_ranks_num(ranks); rank++) {
        const ps_rank_bytes *const part = &parts[rank];
        const char *const text = part->data;
        if (part->num > 1 && text[part->num - 1] == '\0') {
            PS_TRY(compare(own, text, rank, error));
        }
    }
    return PSPEC_OK;
}

pspec_status ps_ranks_compare(ps_ranks *ranks, const ps_text *lines, pspec_status status,
                              void *bytes, size_t num, ps_error *error) {
    const char *const text = ps_text_string(lines);
    const ps_rank_bytes own = {(void *)text, strlen(text) + 1};
    ps_rank_bytes *parts = NULL;
    if (status == PSPEC_OK) {
        status = ps_text_check(lines, error);
    }
    if (status == PSPEC_OK) {
        status = PS_NEW(&parts, ps_ranks_num(ranks), "texts of ranks", error);
    }
    status = ps_ranks_gather(ranks, status, &own, parts, error);
    if (status == PSPEC_OK && ps_ranks_own(ranks) == 0) {
        status = compare_all(ranks, text, parts, error);
    }
    ps_ranks_free(parts, ps_ranks_num(ranks));
    return ps_ranks_conclude(ranks, status, bytes, num, error);
}
