/* Rows of powers on the host, made of sums that are read from the device while it does what comes
 * next: engines whose rows are short give them a run late.
 */
#ifndef PS_ENGINES_LATE_ROWS_H
#define PS_ENGINES_LATE_ROWS_H

#include "engines/engine.h"

/* The row of a realization of its sums, as the device has them; square is what came with its scale.
 */
typedef void ps_make_row(const void *engine, const void *sums, double scale, double square,
                         double *row);

typedef struct ps_late_part {
    uint64_t run;
    size_t first, num;        /* realizations of that run */
    double *scales, *squares; /* of them, copied */
} ps_late_part;

struct ps_late_rows {
    const void *engine;
    ps_make_row *make;
    size_t num, batch, most; /* powers of a row; realizations of a run and of a part, at most */
    size_t sum_bytes;        /* of a realization */
    ps_readings readings;
    ps_late_part parts[PS_READINGS]; /* that are read, in turns */
    uint64_t num_read, num_made;     /* parts */
    uint64_t num_runs;
    double *rows; /* [2][batch][num], of two runs in turns */
    double *numbers;
};

/* engine is borrowed. Zeroed memory must be given, with engine, make, num, batch, most and
 * sum_bytes set; free it also after a failure. */
pspec_status ps_late_rows_create(ps_late_rows *out, ps_device *device,
                                 ps_error *error) PS_MUST_CHECK;
void ps_late_rows_free(ps_late_rows *late);

/* Of a new run with `first` 0: begins to read the sums of num realizations, from `first` on, and
 * makes rows of what was read before, in this run or the last. scales and squares (NULL: none) are
 * copied. */
pspec_status ps_late_rows_read(ps_late_rows *late, const ps_buffer *sums, size_t first, size_t num,
                               const double *scales, const double *squares,
                               ps_error *error) PS_MUST_CHECK;
/* The rows of this run, which are there after ps_rows_wait. */
ps_rows ps_late_rows_give(ps_late_rows *late, size_t num_rows);

#endif
