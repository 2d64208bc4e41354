/* Formats that are not read: which one it is, and what would do. Private to host/points. */
#ifndef PS_POINTS_POINTS_FOREIGN_H
#define PS_POINTS_POINTS_FOREIGN_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

/* One that its first bytes tell. */
typedef struct ps_foreign_format {
    const char *magic;
    size_t magic_bytes;
    const char *name;   /* "an HDF5 file" */
    const char *advice; /* what can be read instead */
} ps_foreign_format;

/* Ends with a magic of NULL. */
extern const ps_foreign_format ps_foreign_formats[];

/* Images that more than a few fixed bytes tell. May these, two at least, begin one? Then the first
 * PS_IMAGE_BYTES tell which it is, or NULL. */
enum { PS_IMAGE_BYTES = 1024 };
bool ps_foreign_may_be_image(const unsigned char *bytes, size_t num_bytes);
const ps_foreign_format *ps_foreign_find_image(const unsigned char *bytes, size_t num_bytes);

pspec_status ps_foreign_refuse(const char *file, const ps_foreign_format *format,
                               ps_error *error) PS_MUST_CHECK;

/* Refuses a text whose first line that is no '#' line is that of another format. */
pspec_status ps_foreign_check_line(const char *file, const char *line,
                                   ps_error *error) PS_MUST_CHECK;

#endif
