/* The folder of the cache of results: which of its files are ours, how much they take, which go
 * first. For files of host/store; ps_cache_folder_make is for whoever keeps a file there
 * (store/figures_file.h), and ps_cache_folder_usage for who says what there is.
 *
 * Ours are regular files named by 32 hexadecimal digits and ".result", and temporary files of
 * outputs (output_file.h). Nothing else is counted or removed, whatever folder a user names.
 */
#ifndef PS_STORE_CACHE_FOLDER_H
#define PS_STORE_CACHE_FOLDER_H

#include "base/status.h"

#include <stddef.h>
#include <stdint.h>

/* A file takes whole blocks of the disk; so do we count. */
uint64_t ps_cache_disk_bytes(uint64_t file_bytes);

/* Makes the folder, and those above it, unless it is there. */
pspec_status ps_cache_folder_make(const char *path, ps_error *error) PS_MUST_CHECK;

/* A folder that does not exist is empty. */
pspec_status ps_cache_folder_usage(const char *path, size_t *num_entries, uint64_t *bytes,
                                   ps_error *error) PS_MUST_CHECK;

/* Removes the entries longest unused, until all files of ours take at most max_bytes, and temporary
 * files that nobody has written to for an hour. */
pspec_status ps_cache_folder_shrink(const char *path, uint64_t max_bytes,
                                    ps_error *error) PS_MUST_CHECK;

/* Shrinks a folder that has become too large, one process at a time: when another has been at it
 * for a tenth of a second, the rest is left to the next. */
pspec_status ps_cache_folder_evict(const char *path, uint64_t max_bytes,
                                   ps_error *error) PS_MUST_CHECK;

#endif
