/* Where realizations come from: a sampler, or point files and given sets one after the other.
 *
 * A source yields point sets in order, and can be rewound: sets that come but once, from standard
 * input or a pipe, are kept, unless they are too many. Sets of files that are too large to be in
 * memory come in blocks.
 */
#ifndef PS_JOBS_SOURCE_H
#define PS_JOBS_SOURCE_H

#include "jobs/pattern_check.h"
#include "points/points.h"
#include "sets/sets.h"

#include <stdint.h>

typedef struct ps_source ps_source;

/* num_realizations realizations of the sampler, from options->first on, with torus coordinates or
 * unit vectors; request is resolved, and copied, and so is watch, which may be NULL: it is told
 * while the points of a large set are made. */
pspec_status ps_source_sampler(ps_source **out, const ps_sampler_request *request,
                               uint64_t num_realizations, const ps_sets_options *options,
                               const ps_watch *watch, ps_error *error) PS_MUST_CHECK;
/* ps_sets_leave of a sampler's. */
void ps_source_leave(ps_source *source, uint64_t taken);
/* ps_sets_trouble of a sampler's; "" of others. */
const char *ps_source_trouble(ps_source *source);

/* Bytes of a set that is read as a whole: some million points. Larger ones come in blocks of about
 * so many bytes, which are enough to keep a device busy. */
#define PS_SOURCE_WHOLE_BYTES ((uint64_t)64 << 20)

typedef struct ps_source_options {
    ps_point_options points; /* of every file */
    uint64_t whole_bytes;    /* 0: PS_SOURCE_WHOLE_BYTES */
    /* Of sets that come but once stay in memory, to be read again; where they take more, none does.
     * 0: PS_SOURCE_WHOLE_BYTES, or a quarter of points.memory_limit; UINT64_MAX: all stay, or it is
     * an error */
    uint64_t kept_bytes;
    bool (*should_stop)(
        void *payload); /* asked after every block that is only counted; may be NULL */
    void *payload;
} ps_source_options;

/* All sets of all files; paths, and texts of the options, are kept and must outlive the source. */
pspec_status ps_source_files(ps_source **out, const char *const *paths, size_t num_paths,
                             const ps_source_options *options, ps_error *error) PS_MUST_CHECK;

/* How much of a set has come. */
typedef struct ps_source_part {
    bool is_whole;
    size_t block_points;    /* that a block should have, of a set that is not whole */
    ps_pattern_count count; /* of all of that set, ahead of the points */
} ps_source_part;

/* The next set, or *has_set false. A set that is too large comes without its end, if it can be
 * known beforehand: when its size stands in the file and it has no weights, or the file can be read
 * twice. */
pspec_status ps_source_next(ps_source *source, ps_point_set *set, ps_source_part *part,
                            bool *has_set, ps_error *error) PS_MUST_CHECK;
/* The same, whole, whatever its size is. */
pspec_status ps_source_next_whole(ps_source *source, ps_point_set *set, bool *has_set,
                                  ps_error *error) PS_MUST_CHECK;
/* Appends at most max_points more of the set that came last, or *ends. */
pspec_status ps_source_more(ps_source *source, ps_point_set *set, size_t max_points, bool *ends,
                            ps_error *error) PS_MUST_CHECK;
/* From now on points (x, y, z) come as (y, z, x), the x axis where the z axis was. */
void ps_source_turn(ps_source *source);
/* Sets of a program, or of a caller that says how many there are; 0: nobody knows before they have
 * come. */
uint64_t ps_source_num_sets(const ps_source *source);
/* Not once more was read of a stream than is kept. */
bool ps_source_can_rewind(const ps_source *source);
/* PSPEC_ERROR_TOLERANCE, "WHY, and ...: give a file", where a more exact plan cannot have the sets
 * again. */
pspec_status ps_source_check_rewind(const ps_source *source, const char *why,
                                    ps_error *error) PS_MUST_CHECK;
/* Leaves out so many of the next sets of a sampler, without making them, and returns how many; none
 * of others, which are to be read. */
uint64_t ps_source_skip(ps_source *source, uint64_t num);
pspec_status ps_source_rewind(ps_source *source, ps_error *error) PS_MUST_CHECK;
/* Formats and columns of the files read so far, "npy; csv", or "". */
const char *ps_source_format(const ps_source *source);
const char *ps_source_columns(const ps_source *source);
void ps_source_destroy(ps_source *source);

/* A second reader of a file, ahead of the one that reads it: it counts a set that is too large to
 * be in memory, and of which weights and number of points are to be known before the first block.
 */
typedef struct ps_scout {
    ps_point_reader *reader; /* NULL: none yet */
    uint64_t num_sets;       /* passed by it */
} ps_scout;

/* Counts the set with that number, from 1 on, of the file, whose earlier ones it may have passed.
 * count->realization is kept. */
pspec_status ps_scout_count(ps_scout *scout, const char *path, const ps_source_options *options,
                            uint64_t number, ps_pattern_count *count,
                            ps_error *error) PS_MUST_CHECK;

/* Leaves the file; the next set is one of another. */
void ps_scout_close(ps_scout *scout);

#endif
