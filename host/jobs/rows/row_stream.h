/* What the realizations of a job come to, a row of bytes each, in their order: made here, or by all
 * members of a team (base/process/team.h), of which every one has all rows.
 *
 * A row depends on its realization alone, whoever made it, and the job adds up rows one after the
 * other: so its results have the same bits whatever the team. Members make as many in a row as take
 * each about a second, a slow one fewer, then they meet.
 */
#ifndef PS_JOBS_ROWS_ROW_STREAM_H
#define PS_JOBS_ROWS_ROW_STREAM_H

#include "device/device.h"
#include "spectra/row_tape.h"
#include "plan/choose.h"
#include "store/checkpoint.h"

#include <stdint.h>

typedef struct ps_row_stream {
    /* set by the job */
    void *job;
    /* Makes the rows of the next realizations, of which `first` is the number of the first, at most
     * `most`: *num, 0 behind the last. */
    pspec_status (*make)(void *job, uint64_t first, size_t most, void *rows, size_t *num,
                         ps_error *error);
    /* Leaves the next num realizations out, *passed of them; there are no more where that is less.
     * NULL: they need not be left out */
    pspec_status (*pass)(void *job, uint64_t num, uint64_t *passed, ps_error *error);
    /* After rows of this member: numbers[num_largest], of which all have the largest of any member
     * to be taken; nan is larger than any. NULL: there are none */
    pspec_status (*measure)(void *job, double *numbers, ps_error *error);
    void (*take_largest)(void *job, const double *numbers);
    size_t num_largest;
    size_t row_bytes;
    size_t batch;     /* most rows of a call of make */
    uint64_t total;   /* realizations; 0: nobody knows */
    bool is_whole;    /* its rows are of no realizations, whatever range is asked for */
    bool is_clipped;  /* a range that ends beyond them is another job's, which refuses it */
    bool are_sampled; /* realizations, by a sampler */
    bool keeps_first; /* making the first leaves more than a row */
    /* set by ps_row_stream_join, or none */
    const ps_team *team; /* NULL: nobody else */
    ps_row_tape *tape;   /* NULL: rows are not kept */
    unsigned part;       /* that the job is of the command */
    ps_device *device;   /* that bits depend on, so that all members have such a one; NULL: none */
    /* whose engine and precision they depend on, too; NULL: on none */
    const ps_candidate *chosen;
    /* rows of the last call */
    char *rows; /* [num][row_bytes] */
    /* while it runs */
    uint64_t first, end; /* of the realizations, those of a range */
    uint64_t num_done;   /* rows that the job has, from the first on */
    uint64_t position;   /* of this member among the realizations */
    bool keeps;          /* rows on the tape, as the member that leads does */
    bool has_met;
    bool has_ended; /* there are no more realizations */
    /* of each member, [2][team->num]: realizations that it may have until all meet next, and those
     * that it has in this round */
    uint64_t *shares;
    size_t room; /* rows */
    char *slots;
    size_t slots_room; /* bytes */
} ps_row_stream;

/* Takes who does a job together, and what keeps its rows, of the spec; NULL: nobody, nothing. */
void ps_row_stream_join(ps_row_stream *stream, const ps_checkpoint_spec *spec);
/* Rows that are kept, to a checkpoint or from one, before the stream begins behind them. */
pspec_status ps_row_stream_walk(ps_row_stream *stream, ps_snapshot *snapshot,
                                ps_error *error) PS_MUST_CHECK;
/* From the first realization on, or from behind num_done that the job has. */
pspec_status ps_row_stream_begin(ps_row_stream *stream, uint64_t num_done,
                                 ps_error *error) PS_MUST_CHECK;
/* The next rows, `most` at most: *num in stream->rows, 0 behind the last. Members with devices of
 * other kinds, with other plans, or at other realizations, are PSPEC_ERROR_INPUT. */
pspec_status ps_row_stream_next(ps_row_stream *stream, uint64_t most, size_t *num,
                                ps_error *error) PS_MUST_CHECK;
static inline void *ps_row_stream_row(const ps_row_stream *stream, size_t i) {
    return stream->rows + i * stream->row_bytes;
}
void ps_row_stream_free(ps_row_stream *stream); /* {0} is allowed */

#endif
