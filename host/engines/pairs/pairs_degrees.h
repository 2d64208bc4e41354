/* What engines of pair sums have in common behind their kernels: partial sums of degrees, added up
 * on the device, and Q(l) = sum w^2 + 2 sum over pairs.
 */
#ifndef PS_ENGINES_PAIRS_PAIRS_DEGREES_H
#define PS_ENGINES_PAIRS_PAIRS_DEGREES_H

#include "engines/engine.h"
#include "engines/feed.h"
#include "engines/late_rows.h"

/* Points of the sphere on their way to the kernels of pairs. */

/* The arrays are those of kernels/pairs/layout.h. */
enum { PS_PAIRS_ARRAYS = 8 };

typedef struct ps_pairs_points {
    ps_device *device;
    ps_precision precision;
    unsigned lanes;
    size_t stride; /* numbers of an array of a realization */
    size_t batch;
    uint64_t *host_counts; /* [batch] */
    double *squares;       /* [batch] sum w^2 of what was uploaded last */
    ps_feed points;        /* [batch][PS_PAIRS_ARRAYS][stride] */
    ps_buffer counts;
} ps_pairs_points;

/* Numbers of an array of a realization of so many points. */
size_t ps_pairs_stride(uint64_t num_points, unsigned lanes);
/* Vectors of lanes of pairs that the kernels go through. */
uint64_t ps_pairs_vectors(uint64_t num_points, unsigned lanes);
/* Runs of so many vectors, for the largest pattern of a batch; at least 1. */
uint64_t ps_pairs_count_runs(const ps_batch *batch, unsigned lanes, uint64_t run_vectors);

/* Zeroed memory must be given; free it also after a failure. */
pspec_status ps_pairs_points_create(ps_pairs_points *out, uint64_t num_points, size_t batch,
                                    ps_precision precision, unsigned lanes, ps_device *device,
                                    ps_error *error) PS_MUST_CHECK;
void ps_pairs_points_free(ps_pairs_points *points);

/* All points of a batch, as directions in two parts, with weights w 2^-exponent. */
pspec_status ps_pairs_points_upload(ps_pairs_points *points, const ps_batch *batch,
                                    ps_error *error) PS_MUST_CHECK;

/* The sizes are those of kernels/pairs/walk.h. Vectors of a chunk: their state, four numbers each,
 * stays in the first-level cache (16 KiB with vectors of 64 bytes). Chunks of a run: enough work
 * for a work-item, and enough work-items. */
enum { PS_PAIRS_CHUNK = 64, PS_PAIRS_RUN_CHUNKS = 16, PS_PAIRS_RUN = 1024 };

/* Sums of runs come in two parts, high and low. */
enum { PS_PAIRS_PARTS = 2 };

/* Rounding of pair sums in units of (sum |w|)^2: hypot(begin, step sqrt(L)) for one pair, which is
 * the worst there is, since errors of many average out: that of t grows like the slope of the
 * polynomials. And drift L for the share of (sum |w|)^2 that is in pairs so close that P_l stays
 * near 1: its steps are then all rounded alike. That share is the mean of Q(l) / (sum |w|)^2.
 * Measured, with slack, by tests/engines/pairs/test_pairs_error.c; docs/engines/pairs_direct.md. */
typedef struct ps_pairs_error_law {
    double begin, step, drift;
} ps_pairs_error_law;

double ps_pairs_rounding(const ps_pairs_error_law *law, const ps_problem *problem,
                         double mean_power);

typedef struct ps_pairs_degrees {
    ps_device *device;
    const ps_frequencies *frequencies;
    ps_precision precision;
    unsigned lanes;
    size_t num_degrees, row_bytes; /* rounded up; of both parts */
    ps_kernel *fold;
    ps_late_rows rows;
    ps_buffer inverses, sums; /* [batch][PS_PAIRS_PARTS][num_degrees] */
} ps_pairs_degrees;

/* Degrees of a row for degrees to max_degree. */
size_t ps_pairs_num_degrees(int32_t max_degree);
/* What all kernels of pairs are compiled with. */
ps_defines ps_pairs_defines(const ps_problem *problem, ps_precision precision, unsigned lanes);

/* Zeroed memory must be given, which stays where it is; free it also after a failure. */
pspec_status ps_pairs_degrees_create(ps_pairs_degrees *out, const ps_problem *problem,
                                     ps_precision precision, unsigned lanes, size_t batch,
                                     ps_device *device, ps_error *error) PS_MUST_CHECK;
void ps_pairs_degrees_free(ps_pairs_degrees *degrees);

/* Adds partials[num_patterns][num_runs][high, low][num_degrees] to the sums, which begin anew with
 * is_first. */
pspec_status ps_pairs_degrees_fold(ps_pairs_degrees *degrees, const ps_buffer *partials,
                                   size_t num_patterns, size_t num_runs, bool is_first,
                                   ps_error *error) PS_MUST_CHECK;
/* The rows of a batch whose points these are. */
pspec_status ps_pairs_degrees_read(ps_pairs_degrees *degrees, const ps_pairs_points *points,
                                   const ps_batch *batch, ps_rows *rows,
                                   ps_error *error) PS_MUST_CHECK;

#endif
