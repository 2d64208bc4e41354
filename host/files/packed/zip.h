/* One member of a zip archive, as numpy.savez writes them, read as it comes. Private to host/files.
 *
 * The directory at the end of the archive says where members are, so it must be a regular file.
 * Inflating is zlib's; a library for the rest would bring several of ciphers and other compressions
 * into every start of the program, and be used for a table of a few fields. */
#ifndef PS_FILES_PACKED_ZIP_H
#define PS_FILES_PACKED_ZIP_H

#include "base/status.h"

#include <stddef.h>

typedef struct ps_zip ps_zip;

/* The only member, or of several the one called "NAME.npy", name being `wanted`. The descriptor,
 * and the name for messages, stay the caller's. Several without that one, encrypted members, other
 * compressions and damaged archives are PSPEC_ERROR_INPUT. */
pspec_status ps_zip_open(ps_zip **out, int descriptor, const char *name, const char *wanted,
                         ps_error *error) PS_MUST_CHECK;
void ps_zip_destroy(ps_zip *zip);

/* Up to max_bytes of the member, *count 0 at its end, where size and CRC must be those of the
 * directory. */
pspec_status ps_zip_read(ps_zip *zip, void *out, size_t max_bytes, size_t *count,
                         ps_error *error) PS_MUST_CHECK;

#endif
