/* A file that appears under its final name only when it is complete.
 *
 * Data go to a temporary file in the same folder, which commit flushes to disk and renames; discard
 * removes it. "-" is standard output, where nothing can be taken back; devices, pipes and
 * /dev/stdout are written directly for the same reason. What a process that was killed left behind
 * goes with the next output in its folder (files/temporary_file.h).
 *
 * As with fopen, the permissions of a new file follow the umask, those of an existing file stay, a
 * file that may not be written is refused, and a symbolic link keeps pointing to the file.
 */
#ifndef PS_FILES_OUTPUT_FILE_H
#define PS_FILES_OUTPUT_FILE_H

#include "base/status.h"

#include <stdio.h>

typedef struct ps_output_file ps_output_file;

/* What follows the last dot in the name of a file, with the dot, in path; "" where there is none.
 * The dot that hides a file begins no ending. */
const char *ps_output_ending(const char *path);

/* An empty name and one that ends in .gz are PSPEC_ERROR_INVALID_ARGUMENT. */
pspec_status ps_output_open(ps_output_file **out, const char *path, ps_error *error) PS_MUST_CHECK;
/* The same to a stream of the caller, a temporary file, which stays open. */
pspec_status ps_output_open_stream(ps_output_file **out, FILE *stream,
                                   ps_error *error) PS_MUST_CHECK;
FILE *ps_output_stream(ps_output_file *file);
/* fwrite to the stream that remembers why it failed, for check and commit; for large blocks, which
 * stdio does not keep to try again. */
void ps_output_write(ps_output_file *file, const void *data, size_t element_bytes, size_t count);
/* For writers that come back to the beginning of their file: where the output cannot do that (a
 * pipe), the data wait in an unnamed temporary file until commit. To be called before the first
 * write. */
pspec_status ps_output_make_seekable(ps_output_file *file, ps_error *error) PS_MUST_CHECK;
/* Goes back there; what is written then replaces what is there. */
pspec_status ps_output_rewind(ps_output_file *file, ps_error *error) PS_MUST_CHECK;
/* Flushes the stream and reports a write that failed before or now (a full disk), without waiting
 * for commit: for long outputs, and before the first commit of several files. */
pspec_status ps_output_check(ps_output_file *file, ps_error *error) PS_MUST_CHECK;
/* Checks every write that went before, makes the data durable, gives the file its name.
 * The handle is freed in every case and *file set to NULL. */
pspec_status ps_output_commit(ps_output_file **file, ps_error *error) PS_MUST_CHECK;
/* NULL handles are allowed. */
void ps_output_discard(ps_output_file **file);

#endif
