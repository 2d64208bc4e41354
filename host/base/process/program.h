/* Other programs that this process starts: one that is found by its path, and a command of the
 * shell whose standard output is read as it comes. */
#ifndef PS_BASE_PROCESS_PROGRAM_H
#define PS_BASE_PROCESS_PROGRAM_H

#include "base/status.h"
#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

/* ---- one that is started -------------------------------------------------------------------- */

/* Both ends of a pipe, which other programs do not inherit. Returns 0 or the errno of what failed.
 */
int ps_pipe_open(int ends[2]);

/* arguments ends in NULL; descriptors are those of the child's standard streams. leads: the child
 * and all that it starts are a group of processes, which a signal of the terminal does not reach.
 * Returns 0 or the errno of what failed. */
int ps_child_start(pid_t *child, const char *path, char *const arguments[],
                   const int descriptors[3], bool leads);

/* ---- a command whose output is read --------------------------------------------------------- */

typedef struct ps_program ps_program;

/* Starts the command by /bin/sh, without standard input, in the current folder. */
pspec_status ps_program_start(ps_program **out, const char *command, ps_error *error) PS_MUST_CHECK;

/* Reads what has come, at least one byte and at most max_bytes of them; *count is 0 at the end. The
 * end is an error where the command has failed, with the last line of its standard error. A signal
 * that comes while it waits is PSPEC_ERROR_CANCELLED. */
pspec_status ps_program_read(ps_program *program, void *out, size_t max_bytes, size_t *count,
                             ps_error *error) PS_MUST_CHECK;

/* Kills what still runs of it. NULL is allowed. */
void ps_program_end(ps_program *program);

/* As much as tells one draw of points from another, whatever the size of sets. */
enum { PS_PROGRAM_TRIED_BYTES = 1 << 24 };

/* Runs the command, and appends what it prints, PS_PROGRAM_TRIED_BYTES at most. */
pspec_status ps_program_try(ps_text *out, const char *command, ps_error *error) PS_MUST_CHECK;

#endif
