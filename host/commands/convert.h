/* Point files to another point file, block by block: no set is ever in memory as a whole (but for
 * formats that lie in columns).
 */
#ifndef PS_COMMANDS_CONVERT_H
#define PS_COMMANDS_CONVERT_H

#include "base/text.h"
#include "base/watch.h"
#include "points/points.h"

typedef struct ps_conversion {
    const char *const *paths; /* their sets become the sets of one output, in this order */
    size_t num_paths;
    ps_point_options options; /* of every file */
    ps_point_range points;    /* of each set; {0}: all */
    bool merge;               /* all sets become one */
    const char *output;       /* "-": standard output; NULL: nothing is written */
    const char *format;       /* NULL: by the ending of output */
    const char *columns;      /* of points of the sphere; NULL: vectors, unless format has angles */
    /* Gets the first set that is written, or would be, whole: angles as vectors; NULL: nobody wants
     * it. To be freed also after an error. */
    ps_point_set *first;
    ps_watch watch; /* told of "points" after every block; {0}: nobody */
} ps_conversion;

/* Appends to *loss what did not survive. The output appears only when all of it is there. */
pspec_status ps_convert(const ps_conversion *conversion, ps_text *loss,
                        ps_error *error) PS_MUST_CHECK;

#endif
