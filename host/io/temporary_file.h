/* Files that only this process sees: they lie where TMPDIR says, else in /tmp, and have no name once they are open. */
#ifndef PS_IO_TEMPORARY_FILE_H
#define PS_IO_TEMPORARY_FILE_H

#include "base/status.h"

#include <stdio.h>

/* Opens one to write and read back. Its end is fclose; children do not inherit it. */
pspec_status ps_temporary_open(FILE **out, ps_error *error) PS_MUST_CHECK;

#endif
