/* What of a folder of the cache is taken for our own. Results, pictures and figures of devices are
 * believed as they are, since their checksums find damage, not intent: so they must come from files
 * that only this user could write.
 */
#ifndef PS_STORE_CACHE_TRUST_H
#define PS_STORE_CACHE_TRUST_H

#include "base/status.h"

#include <stdint.h>

/* PSPEC_ERROR_IO, with a sentence for the user, where the folder belongs to somebody else or where
 * others can write. What does not exist, cannot be seen or is no folder is no concern of this:
 * whoever opens it finds out. */
pspec_status ps_cache_check_folder(const char *path, ps_error *error) PS_MUST_CHECK;

typedef enum ps_cache_file_kind {
    PS_CACHE_FILE_ABSENT = 0,
    PS_CACHE_FILE_OWN,
    PS_CACHE_FILE_NONE /* a pipe, a device, a link, a folder: something that is no file */
} ps_cache_file_kind;

/* Opens a file for reading, and waits for nobody; a link is not followed. The descriptor is the
 * caller's with PS_CACHE_FILE_OWN, else -1. A file of another user is PSPEC_ERROR_IO. */
pspec_status ps_cache_file_open(const char *path, int *descriptor, uint64_t *num_bytes,
                                ps_cache_file_kind *kind, ps_error *error) PS_MUST_CHECK;

/* Removes what is no file, into which one could wait for ever to write, from where one is to be
 * written. */
pspec_status ps_cache_clear_way(const char *path, ps_error *error) PS_MUST_CHECK;

#endif
