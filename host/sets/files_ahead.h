/* Point files, which threads open and begin to read ahead of the one that takes their sets.
 *
 * Of every file that is the reader and its first set, or the beginning of one that is too large.
 * Nothing of this can be seen in points, nor in errors: whoever takes the sets opens himself what
 * could not be read, and so meets the error in its turn, and what comes but once or from a caller.
 */
#ifndef PS_SETS_FILES_AHEAD_H
#define PS_SETS_FILES_AHEAD_H

#include "base/watch.h"
#include "points/points.h"

/* ---- sets ------------------------------------------------------------------------------------ */

/* Points of a set like this one in so many bytes; never less than a few. */
size_t ps_points_fitting(const ps_point_set *set, uint64_t bytes);

/* Appends at most max_points of the set that the reader is in, or *ends. The watch may be NULL. */
pspec_status ps_points_read_on(ps_point_reader *reader, ps_point_set *set, size_t max_points,
                               bool *ends, const ps_watch *watch, ps_error *error) PS_MUST_CHECK;

/* Goes on with a set, which may be empty yet, until it has so many bytes, or *ends; a set without
 * points: there was no more. */
pspec_status ps_points_fill(ps_point_reader *reader, ps_point_set *set, uint64_t bytes, bool *ends,
                            const ps_watch *watch, ps_error *error) PS_MUST_CHECK;

/* ---- files ----------------------------------------------------------------------------------- */

typedef struct ps_files_ahead ps_files_ahead;

typedef struct ps_files_plan {
    const char *const *paths; /* [num], kept, and so are the texts of options */
    size_t num;
    const ps_point_options *options; /* of every file */
    uint64_t set_bytes;              /* of a set, about: how many are read ahead */
    uint64_t most_bytes;             /* of a set that is read; of others the beginning */
} ps_files_plan;

/* *out is NULL where nothing is to be gained: of the last file, of small sets, and of sets so large
 * that there is no room for two. */
pspec_status ps_files_ahead_create(ps_files_ahead **out, const ps_files_plan *plan,
                                   ps_error *error) PS_MUST_CHECK;

/* Waits for file number `index`, above all that were asked for before. *reader belongs to the
 * caller then, and *set, whose memory goes the other way, has the points that it has read, to the
 * end of the set where *ends; or *reader is NULL. */
pspec_status ps_files_ahead_take(ps_files_ahead *files, size_t index, const ps_watch *watch,
                                 ps_point_reader **reader, ps_point_set *set, bool *ends,
                                 ps_error *error) PS_MUST_CHECK;

/* NULL is allowed. */
void ps_files_ahead_destroy(ps_files_ahead *files);

#endif
