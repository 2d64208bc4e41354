/* How much a file of points holds, guessed from its size and its beginning, for `plan`: nothing is
 * read to its end. */
#ifndef PS_POINTS_FILE_ESTIMATE_H
#define PS_POINTS_FILE_ESTIMATE_H

#include <stdbool.h>

typedef struct ps_file_estimate {
    double bytes; /* once inflated; 0: not known, of a pipe */
    bool is_text, is_compressed;
    double line_bytes;      /* of text */
    double bytes_of_number; /* of what is not text */
} ps_file_estimate;

/* format: as options name it; NULL: by ending and first bytes. */
ps_file_estimate ps_file_estimate_of(const char *path, const char *format);

/* Points of `columns` numbers each. */
double ps_file_estimate_points(const ps_file_estimate *estimate, unsigned columns);

#endif
