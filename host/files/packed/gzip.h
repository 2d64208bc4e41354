/* Decompression of gzip data as they are read, through zlib. Private to host/files. */
#ifndef PS_FILES_PACKED_GZIP_H
#define PS_FILES_PACKED_GZIP_H

#include "base/status.h"

#include <stddef.h>

typedef struct ps_gzip ps_gzip;

typedef enum ps_gzip_kind {
    PS_GZIP_FILE, /* members of gzip, one after the other */
    PS_GZIP_RAW   /* deflated data alone, which say themselves where they end */
} ps_gzip_kind;

/* start: compressed bytes that were read already; copied. The descriptor, which gives the others,
 * and the name for messages stay the caller's. */
pspec_status ps_gzip_create(ps_gzip **out, ps_gzip_kind kind, int descriptor, const char *name,
                            const unsigned char *start, size_t num_bytes,
                            ps_error *error) PS_MUST_CHECK;
void ps_gzip_destroy(ps_gzip *gzip);

/* Up to max_bytes of the data, *count 0 at the end of the last member. Damaged and truncated data
 * are PSPEC_ERROR_INPUT; zlib checks the CRC of every member. */
pspec_status ps_gzip_read(ps_gzip *gzip, void *out, size_t max_bytes, size_t *count,
                          ps_error *error) PS_MUST_CHECK;

#endif
