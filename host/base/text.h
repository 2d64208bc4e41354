/* Growing text, and reading numbers that people type. */
#ifndef PS_BASE_TEXT_H
#define PS_BASE_TEXT_H

#include "base/memory.h"
#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A text that grows; {0} is the empty text. Once an append runs out of memory, failed stays set
 * and further appends do nothing, so that callers check once, at the end. */
typedef struct ps_text {
    char *data; /* NUL-terminated, or NULL while empty */
    size_t length, capacity;
    bool failed;
} ps_text;

void ps_text_append(ps_text *text, const char *format, ...) PS_PRINTF(2, 3);
void ps_text_append_bytes(ps_text *text, const char *bytes, size_t num_bytes);
/* A member of a list, after `separator` where it is not the first, unless the list has it, or it is
 * empty. */
void ps_text_append_once(ps_text *list, const char *member, const char *separator);
/* A blank and a word that a shell takes back as it is. */
void ps_text_append_word(ps_text *text, const char *word);
const char *ps_text_string(const ps_text *text); /* never NULL */
void ps_text_free(ps_text *text);
/* The text as one of the pool; *text is empty then, also after an error. */
pspec_status ps_text_keep(const char **out, ps_pool *pool, ps_text *text,
                          ps_error *error) PS_MUST_CHECK;
/* PSPEC_ERROR_MEMORY when an append ran out of memory. */
pspec_status ps_text_check(const ps_text *text, ps_error *error) PS_MUST_CHECK;

/* Bytes of the character of UTF-8 that text begins with, and its code; 0: it begins with none (RFC
 * 3629). The end of a text is a byte of code 0. */
size_t ps_text_decode(uint32_t *code, const char *text);
/* The same for those alone that texts for people, XML among them, may have. The end of a text is no
 * such character. */
size_t ps_text_character(const char *text);
#define PS_TEXT_UNKNOWN "\xef\xbf\xbd" /* U+FFFD, which stands for what is none */

/* What stands in a string of JSON, which is one of YAML too, for the character that *text begins
 * with; *text is behind it then. A byte that begins none is U+FFFD. */
typedef struct ps_json_character {
    char text[8];
} ps_json_character;
ps_json_character ps_text_next_json(const char **text);

/* "1024", "1e6", "4096.0" -> a whole number in [minimum, maximum]; anything else is
 * PSPEC_ERROR_INVALID_ARGUMENT with a sentence that names the thing, the text and the limits. */
pspec_status ps_parse_count(const char *text, const char *what, uint64_t minimum, uint64_t maximum,
                            uint64_t *out, ps_error *error) PS_MUST_CHECK;

/* A finite number in [minimum, maximum]. */
pspec_status ps_parse_number(const char *text, const char *what, double minimum, double maximum,
                             double *out, ps_error *error) PS_MUST_CHECK;

/* "400M", "1.5G", "2e9": a whole number of bytes, or a number of K, M, G or T, which are powers of
 * 1024. */
pspec_status ps_parse_size(const char *text, const char *what, uint64_t *out,
                           ps_error *error) PS_MUST_CHECK;

bool ps_text_ends_in(const char *text, const char *ending);

/* Which of the words, "one|two|three", these bytes are; -1: none. */
int ps_text_find_word(const char *text, size_t length, const char *words);

/* The nearer one to name of *nearest, which may be NULL at first, and known. */
void ps_text_keep_nearest(const char *name, const char *known, const char **nearest);

/* "BEFORE known AFTER" for the end of a sentence when the name as typed is near the known one, at
 * the distance given; else nothing, as a name that only happens to be the nearest misleads. */
typedef struct ps_suggestion {
    char text[96];
} ps_suggestion;
ps_suggestion ps_text_suggest(const char *typed, const char *known, size_t distance,
                              const char *before, const char *after);

/* Edit distance, for "did you mean": insertions, deletions, substitutions cost 1. */
size_t ps_text_distance(const char *a, const char *b);

#endif
