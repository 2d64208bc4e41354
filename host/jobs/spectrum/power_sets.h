/* The point sets of a power job on their way from the source to the estimator: batches of sets that
 * are in memory, and sets that are not, in blocks. */
#ifndef PS_JOBS_SPECTRUM_POWER_SETS_H
#define PS_JOBS_SPECTRUM_POWER_SETS_H

#include "jobs/estimator.h"
#include "jobs/source.h"

/* ---- do points leave a piece of an axis empty, as points of a smaller box do? ---------------- */

enum { PS_AXIS_CELLS = 256 };

/* Which cells of every axis of the unit cube have a point; {0} before the first. */
typedef struct ps_axis_cells {
    unsigned dimension;
    uint64_t num_points;
    bool has_point[PS_MAX_DIMENSION][PS_AXIS_CELLS];
} ps_axis_cells;

/* A piece of an axis from `begin` to `end`, which is below `begin` where it goes on at 0. */
typedef struct ps_empty_axis {
    unsigned axis; /* from 0 on */
    double begin, end;
} ps_empty_axis;

/* Points of the torus. */
void ps_axis_cells_add(ps_axis_cells *cells, const pspec_pattern *block);
/* The longest empty piece, where it is more than a tenth of its axis and where as many uniform
 * points leave so long a one on any axis with a probability below 1e-9. */
bool ps_axis_cells_find_empty(const ps_axis_cells *cells, ps_empty_axis *out);

/* ---- sets ------------------------------------------------------------------------------------ */

/* Of more nobody sees single points in a panel of a picture. */
enum { PS_MOST_POINTS_KEPT = 16384 };

typedef struct ps_power_sets {
    ps_source *source;
    bool is_borrowed;         /* the source */
    const char *weights_path; /* NULL: none; the same weights for every set */
    double *weights;
    size_t num_weights;
    ps_point_set next; /* read, but not yet taken: a set or the first block of one */
    ps_source_part part;
    bool has_next;
    ps_point_set after; /* next, where it was read to learn whether there is one */
    ps_source_part after_part;
    bool has_after;
    ps_point_set *sets; /* [capacity] a batch */
    pspec_pattern *patterns;
    size_t capacity;
    size_t used; /* points of next that the estimator has had */
    uint64_t num_streamed;
    ps_boxes boxes; /* of all sets that were read */
    /* Where the points of the first set are; only with looks_at_axes */
    bool looks_at_axes, has_looked;
    ps_axis_cells first_cells;
    /* A copy of the first set, without weights, if it has no more than PS_MOST_POINTS_KEPT points
     * and came whole; only with keeps_first */
    bool keeps_first, has_kept;
    ps_point_set first;
} ps_power_sets;

void ps_power_sets_free(ps_power_sets *sets);
pspec_status ps_power_sets_read_weights(ps_power_sets *sets, const char *path, uint64_t num_points,
                                        ps_error *error) PS_MUST_CHECK;
/* Room for batches of so many. */
pspec_status ps_power_sets_allocate(ps_power_sets *sets, size_t capacity,
                                    ps_error *error) PS_MUST_CHECK;
/* Gives back what sets take; they are to be read again. */
void ps_power_sets_release(ps_power_sets *sets);
/* Back to the first set. */
pspec_status ps_power_sets_rewind(ps_power_sets *sets, ps_error *error) PS_MUST_CHECK;

/* Reads ahead: *has_set tells whether sets->next is a set, which sets->part describes. */
pspec_status ps_power_sets_peek(ps_power_sets *sets, bool *has_set, ps_error *error) PS_MUST_CHECK;
/* Whether no set comes after sets->next, which is one. Of a set that is not whole nobody knows. */
pspec_status ps_power_sets_is_last(ps_power_sets *sets, bool *is_last,
                                   ps_error *error) PS_MUST_CHECK;
uint64_t ps_power_sets_next_points(const ps_power_sets *sets);

/* Sets that were passed over. */
typedef struct ps_passed_sets {
    uint64_t num, longest; /* the largest number of points of one */
} ps_passed_sets;
/* Asked before each; a failure ends it. */
typedef pspec_status ps_look_at_sets(void *payload, ps_error *error);
/* Passes over the next sets, num at most: they are read, for what is found out of all of them. */
pspec_status ps_power_sets_pass(ps_power_sets *sets, uint64_t num, ps_look_at_sets *look,
                                void *payload, ps_passed_sets *passed,
                                ps_error *error) PS_MUST_CHECK;

/* Fills patterns[*num] with the next sets, `most` at most. The batch ends before a set that comes
 * in blocks, if the estimator can stream. Where *num is 0 and has_next is true, the next set is
 * such a one, for ps_power_sets_stream; where has_next is false, there are no more. */
pspec_status ps_power_sets_fill(ps_power_sets *sets, bool can_stream, uint64_t most, size_t *num,
                                ps_error *error) PS_MUST_CHECK;
/* Passes over the next sets, num at most, of which a sampler makes none but the first where it is
 * kept. */
pspec_status ps_power_sets_skip(ps_power_sets *sets, uint64_t num, ps_look_at_sets *look,
                                void *payload, ps_passed_sets *passed,
                                ps_error *error) PS_MUST_CHECK;
/* Gives the estimator the next set in blocks. */
pspec_status ps_power_sets_stream(ps_power_sets *sets, ps_estimator *estimator,
                                  pspec_normalization normalization, ps_error *error) PS_MUST_CHECK;

#endif
