/* One file of the cache of results: head, key, data.
 *
 * Numbers are in the byte order of the machine; the version has another value in the other order,
 * so that a folder shared by such machines only has misses. Checksums are XXH3 of 64 bits: they
 * find damage, not intent.
 */
#ifndef PS_STORE_CACHE_ENTRY_H
#define PS_STORE_CACHE_ENTRY_H

#include "base/status.h"

#include <stddef.h>
#include <stdint.h>

enum { PS_CACHE_MAGIC_BYTES = 8 };

/* The whole head is in the file as it is here. */
typedef struct ps_cache_head {
    char magic[PS_CACHE_MAGIC_BYTES];
    uint64_t version;
    uint64_t key_bytes, data_bytes;
    uint64_t key_checksum, data_checksum;
    uint64_t head_checksum; /* of all before it */
} ps_cache_head;

typedef enum ps_cache_finding {
    PS_CACHE_ABSENT = 0,
    PS_CACHE_FOUND,
    PS_CACHE_OTHER_KEY, /* a sound entry: two keys with one address */
    PS_CACHE_BROKEN     /* cut, damaged, of another version, or no file at all */
} ps_cache_finding;

/* The head for these sizes, with the checksums of this key and these data. */
ps_cache_head ps_cache_head_make(const void *key, size_t key_bytes, const void *data,
                                 size_t data_bytes);

/* The file has its name when all of it is on the disk; after an error there is nothing new. */
pspec_status ps_cache_entry_write(const char *path, const void *key, size_t key_bytes,
                                  const void *data, size_t data_bytes,
                                  ps_error *error) PS_MUST_CHECK;

/* An entry of another user is PSPEC_ERROR_IO. With PS_CACHE_FOUND, *data is to be freed by the
 * caller, and the file's time of modification is now, where the file system allows it. Nothing is
 * allocated before the sizes in the head were compared with that of the file. */
pspec_status ps_cache_entry_read(const char *path, const void *key, size_t key_bytes, void **data,
                                 size_t *data_bytes, ps_cache_finding *finding,
                                 ps_error *error) PS_MUST_CHECK;

#endif
