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

/* Is the magic there? *needs_more: these bytes agree with it and end before it does. */
bool ps_magic_begins(const char *magic, size_t magic_bytes, const unsigned char *bytes,
                     size_t num_bytes, bool *needs_more);
/* The format that an input of these first bytes, one at least, has; NULL: none. are_all: no others
 * follow; else *needs_more: a few of them, up to 1 KiB of all, may tell. */
const ps_foreign_format *ps_foreign_find(const unsigned char *bytes, size_t num_bytes, bool are_all,
                                         bool *needs_more);

pspec_status ps_foreign_refuse(const char *file, const ps_foreign_format *format,
                               ps_error *error) PS_MUST_CHECK;

/* Refuses a text whose lines at the cursor, behind '#' lines, are those of another format. */
pspec_status ps_foreign_check_lines(ps_lines *lines, ps_error *error) PS_MUST_CHECK;

#endif
