/* Rows of realizations that are kept beside an answer: what ranges of the realizations of a command
 * are put together from (answers/ranges).
 *
 * A tape records the rows of a range, or has those of ranges one behind the other and plays them to
 * the jobs of the same command, which find what they would have found themselves. A command has
 * several jobs, and a tape a track for each.
 */
#ifndef PS_SPECTRA_ROW_TAPE_H
#define PS_SPECTRA_ROW_TAPE_H

#include "plan/range.h"

#include <stddef.h>

enum { PS_MOST_LARGEST = 8 };

typedef struct ps_row_track {
    unsigned part;                   /* of the command that the job is: ps_checkpoint_spec.part */
    bool is_whole;                   /* it is of no realizations: every range has all of its rows */
    uint64_t num;                    /* rows */
    uint64_t all;                    /* that the job has without a range */
    uint64_t row_bytes;              /* of each */
    double largest[PS_MOST_LARGEST]; /* ps_row_stream.measure of the range */
    char *rows;                      /* [num][row_bytes] */
    size_t room;                     /* bytes */
} ps_row_track;

typedef struct ps_row_tape {
    ps_realization_range range;
    bool is_played;       /* else it records */
    bool is_part;         /* the range is not all of the job */
    ps_row_track *tracks; /* [num] */
    size_t num, room;
} ps_row_tape;

/* NULL: there is none. */
ps_row_track *ps_row_tape_find(const ps_row_tape *tape, unsigned part);
/* The same; one without rows is added where there is none. Borrowed until the next is added. */
pspec_status ps_row_tape_track(ps_row_track **out, ps_row_tape *tape, unsigned part,
                               ps_error *error) PS_MUST_CHECK;
/* Adds rows behind the others, or room for them where rows is NULL. */
pspec_status ps_row_track_add(ps_row_track *track, const void *rows, uint64_t num,
                              ps_error *error) PS_MUST_CHECK;
void ps_row_tape_free(ps_row_tape *tape); /* {0} is allowed */

/* The number of the first realization that a job makes. tape NULL: it makes all. */
static inline uint64_t ps_row_tape_first(const ps_row_tape *tape) {
    return tape != NULL ? tape->range.first : 0;
}

#endif
