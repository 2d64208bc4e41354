/* Opening and reading what is read: a file, standard input, or either of them compressed by gzip,
 * an array of a zip archive (NPZ), or what a command prints, with the refusals that are the same
 * for all. */
#ifndef PS_FILES_INPUT_FILE_H
#define PS_FILES_INPUT_FILE_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

typedef struct ps_gzip ps_gzip;       /* files/packed/gzip.h */
typedef struct ps_zip ps_zip;         /* files/packed/zip.h */
typedef struct ps_program ps_program; /* base/process/program.h */

/* Closed by ps_input_close, also after an open that failed. */
typedef struct ps_input {
    char *name; /* for messages */
    int descriptor;
    ps_gzip *gzip;         /* NULL: the bytes are as they are, */
    ps_zip *zip;           /* or come from an archive, */
    ps_program *program;   /* or are printed by a command */
    unsigned char *buffer; /* read, but not yet taken: [begin, end) */
    size_t begin, end;
    bool is_seekable; /* a regular file, not compressed */
    bool can_reopen;  /* a regular file that has a path */
} ps_input;

/* Can the file be read? Without opening it, so that a stream loses nothing. "-" can; NULL is none.
 */
pspec_status ps_input_check(const char *path, ps_error *error) PS_MUST_CHECK;

/* Opens path, or standard input for "-". Folders and empty files are refused; gzip and zip are
 * recognised by their first bytes. Of an archive with several arrays the one called `array` is
 * taken. */
pspec_status ps_input_open_array(ps_input *input, const char *path, const char *array,
                                 ps_error *error) PS_MUST_CHECK;
/* The same, with the array "points". */
pspec_status ps_input_open(ps_input *input, const char *path, ps_error *error) PS_MUST_CHECK;
/* What the command prints; name: of the input, for messages. It is never packed. */
pspec_status ps_input_open_program(ps_input *input, const char *name, const char *command,
                                   ps_error *error) PS_MUST_CHECK;
void ps_input_close(ps_input *input);

/* Makes the first bytes visible in *bytes without taking them: at least wanted (at most 1024), and
 * fewer only when the input ends before. Valid until the next call. */
pspec_status ps_input_peek(ps_input *input, size_t wanted, const unsigned char **bytes,
                           size_t *num_bytes, ps_error *error) PS_MUST_CHECK;

/* Reads what is there, at least one byte and at most max_bytes; *count is 0 at the end only. */
pspec_status ps_input_read_some(ps_input *input, void *out, size_t max_bytes, size_t *count,
                                ps_error *error) PS_MUST_CHECK;

/* Reads num_bytes; *count is smaller only at the end. */
pspec_status ps_input_read(ps_input *input, void *out, size_t num_bytes, size_t *count,
                           ps_error *error) PS_MUST_CHECK;

/* Bytes that are still to come, where the system tells: for files that are not compressed. */
bool ps_input_bytes_left(const ps_input *input, uint64_t *num_bytes);

/* Where the next byte stands in the file, and going back there. Seekable inputs only. */
off_t ps_input_position(const ps_input *input);
pspec_status ps_input_seek(ps_input *input, off_t position, ps_error *error) PS_MUST_CHECK;

#endif
