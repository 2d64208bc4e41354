/* Parts of the target of point files. */
#ifndef PS_TESTS_FUZZ_POINTS_H
#define PS_TESTS_FUZZ_POINTS_H

#include "fuzz.h"

#include "points/points.h"

/* What the first bytes of the input select, beside the options of the reader. */
typedef struct fuzz_choices {
    ps_point_options options;
    bool whole_from_pipe, blocks_from_pipe;
    bool keeps_blocks;   /* blocks are appended to those of the set before them */
    bool tells_counts;   /* to the writer */
    size_t block_points; /* of one read */
} fuzz_choices;

/* All that one reading gave. */
typedef struct fuzz_reading {
    pspec_status status;
    ps_error error;
    const char *format; /* NULL: it was not opened */
    bool was_cut;       /* there was more than a test has time for */
    /* All sets, one after the other; ends[i] is the number of points up to the end of set i. What
     * comes after the last end belongs to a set that was not finished. */
    ps_point_set all;
    size_t *ends;
    size_t num_sets;
} fuzz_reading;

/* Set by set, or in blocks when block_points is not 0. */
void fuzz_read(fuzz_reading *out, const char *path, const fuzz_choices *choices,
               size_t block_points);
void fuzz_reading_free(fuzz_reading *reading);

/* Do the points obey what points/points.h promises? */
void fuzz_check_points(const fuzz_reading *reading, const ps_point_options *options);

/* Are the first num_sets sets the same to the bit? */
void fuzz_compare(const fuzz_reading *a, const fuzz_reading *b, size_t num_sets, const char *what);

/* Writes what was read in a format, and reads that. */
void fuzz_write_and_read(const fuzz_reading *reading, const char *format,
                         const fuzz_choices *choices);

#endif
