/* Formats that are not read: which one it is, and what would do. Private to host/points. */
#ifndef PS_POINTS_POINTS_FOREIGN_H
#define PS_POINTS_POINTS_FOREIGN_H

#include "files/text_lines.h"

#include <stdbool.h>
#include <stddef.h>

/* One that its first bytes tell. */
typedef struct ps_foreign_format {
    const char *magic;
    size_t magic_bytes;
    const char *name;   /* "an HDF5 file" */
    const char *advice; /* what can be read instead */
} ps_foreign_format;

/* Advice for meshes, and for rows with names. */
extern const char ps_foreign_meshes[], ps_foreign_tables[];

/* Ends with a magic of NULL. */
extern const ps_foreign_format ps_foreign_formats[];

/* Those that more than a few fixed bytes tell. May these, two at least, begin one? Then the first
 * PS_FOREIGN_BYTES tell which it is, or NULL. */
enum { PS_FOREIGN_BYTES = 1024 };
bool ps_foreign_may_be(const unsigned char *bytes, size_t num_bytes);
const ps_foreign_format *ps_foreign_find(const unsigned char *bytes, size_t num_bytes);

pspec_status ps_foreign_refuse(const char *file, const ps_foreign_format *format,
                               ps_error *error) PS_MUST_CHECK;

/* Refuses a text whose lines at the cursor, behind '#' lines, are those of another format. */
pspec_status ps_foreign_check_lines(ps_lines *lines, ps_error *error) PS_MUST_CHECK;

#endif
