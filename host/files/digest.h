/* 128 bits that tell contents apart (XXH3), for caches and records: not against somebody hostile.
 */
#ifndef PS_FILES_DIGEST_H
#define PS_FILES_DIGEST_H

#include "base/status.h"

#include <stddef.h>

enum { PS_DIGEST_BYTES = 33 }; /* hexadecimal, with the NUL */

void ps_digest_bytes(const void *bytes, size_t num_bytes, char out[PS_DIGEST_BYTES]);
/* The digest of all bytes of a file as they are on the disk. */
pspec_status ps_digest_file(const char *path, char out[PS_DIGEST_BYTES],
                            ps_error *error) PS_MUST_CHECK;

#endif
