/* Temporary files: those that only this process sees, without a name once they are open, and those
 * that become an output when they are complete.
 *
 * A name is .pointspec-HOST-PID-NUMBER.tmp, HOST a checksum of the machine's name, and whoever has
 * made the file holds a lock on it until it is closed. So a file that a process left behind which
 * was killed can be told from one that is being written, whatever became of the process's number:
 * its lock can be had. The next file that is made in the folder takes such files away, but for
 * those with the number of the process that makes it: they are its own. For that a file has to lose
 * its name, by unlink or rename, before its lock goes: names are used again.
 */
#ifndef PS_FILES_TEMPORARY_FILE_H
#define PS_FILES_TEMPORARY_FILE_H

#include "base/status.h"

#include <stddef.h>
#include <stdio.h>
#include <sys/types.h>

/* Opens one to write and read back, where TMPDIR says, else in /tmp. Its end is fclose; children do
 * not inherit it. */
pspec_status ps_temporary_open(FILE **out, ps_error *error) PS_MUST_CHECK;

/* Makes a new file in the folder, the first folder_length bytes of folder, "" or ending in "/".
 * *path, to be freed, is its name. A descriptor to write to, or -1 and errno. */
int ps_temporary_create(const char *folder, size_t folder_length, mode_t mode, char **path);

#endif
