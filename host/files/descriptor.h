/* Descriptors of files, with the sentences of what can go wrong: what plain and compressed input
 * share. Private to host/files but for ps_read_fail. */
#ifndef PS_FILES_DESCRIPTOR_H
#define PS_FILES_DESCRIPTOR_H

#include "base/status.h"

#include <stddef.h>

/* Opens path for reading, or standard input for "-" through a copy of its descriptor, so that
 * closing it is ours to do; below 0: errno says why not. */
int ps_descriptor_open(const char *path);

/* Reads what is there, at most max_bytes; *count is 0 at the end only. name is for the message. */
pspec_status ps_descriptor_read(int descriptor, const char *name, void *out, size_t max_bytes,
                                size_t *count, ps_error *error) PS_MUST_CHECK;

/* Records that reading name failed, as errno says; an interruption is PSPEC_ERROR_CANCELLED, so
 * that whoever installed the signal handler decides (SA_RESTART or not) whether reads go on. */
pspec_status ps_read_fail(const char *name, ps_error *error);

#endif
