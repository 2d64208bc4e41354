/* Fuzzing: every target is a function that takes any bytes and checks, beyond "no sanitizer
 * objects", what the code promises of them. The same functions run under libFuzzer (libfuzzer.c,
 * preset fuzz) and over the files of corpus/ in every build (replay.c, the test fuzz_corpus). */
#ifndef PS_TESTS_FUZZ_H
#define PS_TESTS_FUZZ_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct fuzz_bytes {
    const uint8_t *data;
    size_t size;
} fuzz_bytes;

typedef struct fuzz_target {
    const char *name; /* also of its folder in corpus/ */
    void (*run)(const char *argument, fuzz_bytes input);
    const char *argument;
    const char *dictionary; /* file beside this one, or NULL */
} fuzz_target;

/* Ended by a row without a name. */
extern const fuzz_target fuzz_targets[];
/* NULL: there is none of that name. */
const fuzz_target *fuzz_target_find(const char *name);

/* ---- what targets are made of -------------------------------------------------------------- */

/* The first byte, taken off; 0 when there is none. */
uint8_t fuzz_take(fuzz_bytes *bytes);
/* A copy that ends in NUL, to be freed. */
char *fuzz_copy_text(fuzz_bytes bytes);
/* malloc and realloc that end the process when there is nothing left. */
void *fuzz_allocate(void *old, size_t count, size_t element_bytes);

/* A promise was broken: says so and aborts. */
void fuzz_fail(const char *format, ...) PS_PRINTF(1, 2) __attribute__((noreturn));

/* Whether the words of a message may hold any byte of the input: only those of the command line,
 * whose control characters main() replaces. Others quote text in UTF-8 at most. */
typedef enum fuzz_quotes { FUZZ_PRINTABLE, FUZZ_QUOTES_INPUT } fuzz_quotes;

/* A status other than PSPEC_OK must be one of those that input can cause, with a sentence. */
void fuzz_check_error(pspec_status status, const ps_error *error, fuzz_quotes quotes);

/* Bytes under a name of the file system that no disk sees. */
typedef struct fuzz_file {
    int descriptor;
    char path[32];
} fuzz_file;

fuzz_file fuzz_file_make(fuzz_bytes content);
/* A pipe that brings content; a regular file when that is more than a pipe takes at once. */
fuzz_file fuzz_pipe_make(fuzz_bytes content);
void fuzz_file_close(fuzz_file *file);

/* ---- the targets --------------------------------------------------------------------------- */

/* argument: the format, or NULL for detection. */
void fuzz_points(const char *argument, fuzz_bytes input);
void fuzz_frequencies(const char *argument, fuzz_bytes input);
void fuzz_weights(const char *argument, fuzz_bytes input);
void fuzz_image(const char *argument, fuzz_bytes input);
void fuzz_mesh(const char *argument, fuzz_bytes input);
void fuzz_saved(const char *argument, fuzz_bytes input);
void fuzz_table(const char *argument, fuzz_bytes input);
void fuzz_scene(const char *argument, fuzz_bytes input);
void fuzz_figures(const char *argument, fuzz_bytes input);
void fuzz_decimal(const char *argument, fuzz_bytes input);
void fuzz_sampler(const char *argument, fuzz_bytes input);
void fuzz_brdf(const char *argument, fuzz_bytes input);
void fuzz_arguments(const char *argument, fuzz_bytes input);

#endif
