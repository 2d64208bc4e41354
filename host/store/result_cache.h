/* A cache of results, or of whatever else takes long to make, in a folder that processes share.
 *
 * An entry is an NPZ file (files/packed/npz.h) with its key, any bytes, as the array "cache_key".
 * It is found by its whole key, in a file whose name is the hash of it (XXH3, 128 bits). What comes
 * back is what was put, or nothing: a file that is cut, damaged or of another version is a miss,
 * and is removed; another key of the same hash is a miss. A process that is killed leaves whole
 * entries and perhaps a temporary file, which goes later. Entries are as old as their last use; the
 * oldest go when all together take more than max_bytes on the disk, counted in blocks of 4096
 * bytes. A process may put a 64th of that before it looks how much there is.
 *
 * A cache is a convenience: whoever gets an error from it can compute the result instead, and say
 * so once. Several threads may use one handle. Folders that others can write, and entries of other
 * users, are errors (store/cache_trust.h).
 */
#ifndef PS_STORE_RESULT_CACHE_H
#define PS_STORE_RESULT_CACHE_H

#include "base/status.h"
#include "base/text.h"
#include "files/packed/npz.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct ps_cache ps_cache;

/* Appends POINTSPEC_CACHE_DIR, else XDG_CACHE_HOME/pointspec, else HOME/.cache/pointspec. Variables
 * that are empty count as not set, and so does an XDG_CACHE_HOME that is no absolute path. */
pspec_status ps_cache_default_directory(ps_text *out, ps_error *error) PS_MUST_CHECK;

/* Makes the folder, and those above it, unless it is there; one that others can write is refused.
 * With max_bytes 0 nothing will be stored. */
pspec_status ps_cache_open(ps_cache **out, const char *directory, uint64_t max_bytes,
                           ps_error *error) PS_MUST_CHECK;
/* True for the first call: what is wrong with a cache, a full disk say, is worth one sentence and
 * not one per entry. */
bool ps_cache_first_failure(ps_cache *cache);
/* NULL is allowed. */
void ps_cache_close(ps_cache *cache);

/* *out, NULL where there is nothing, also after an error (a file that is there and cannot be read
 * or is not ours, memory, an interruption), is to be freed by the caller. */
pspec_status ps_cache_find(ps_cache *cache, const void *key, size_t key_bytes, ps_npz_file **out,
                           ps_error *error) PS_MUST_CHECK;
/* The same of entries that are bytes alone. *is_found: *data, never NULL, is to be freed by the
 * caller. Otherwise *data is NULL. */
pspec_status ps_cache_get(ps_cache *cache, const void *key, size_t key_bytes, void **data,
                          size_t *data_bytes, bool *is_found, ps_error *error) PS_MUST_CHECK;

/* Appends the name of the file of the key, and a slash before it, to its folder. */
pspec_status ps_cache_append_name(ps_text *path, const void *key, size_t key_bytes,
                                  ps_error *error) PS_MUST_CHECK;
/* Is there a file for the key? It may be damaged. */
bool ps_cache_has(const ps_cache *cache, const void *key, size_t key_bytes);
/* Entries that were found damaged, and removed, through this handle. */
unsigned ps_cache_num_broken(const ps_cache *cache);

/* An entry that has its key and gets its arrays; *out is for end, or for ps_npz_discard. */
pspec_status ps_cache_begin(ps_cache *cache, const void *key, size_t key_bytes, ps_npz **out,
                            ps_error *error) PS_MUST_CHECK;
/* *npz, which is freed in every case, replaces what is there under its key. An entry that alone is
 * larger than the limit is not stored, which is no error. After an error the entry is not there, or
 * it is and older ones could not be removed. */
pspec_status ps_cache_end(ps_cache *cache, ps_npz **npz, ps_error *error) PS_MUST_CHECK;
/* The same of bytes alone. */
pspec_status ps_cache_put(ps_cache *cache, const void *key, size_t key_bytes, const void *data,
                          size_t data_bytes, ps_error *error) PS_MUST_CHECK;

#endif
