/* Points of the sphere on their way to the kernels of pairs: kernels/pairs/layout.h.
 */
#ifndef PS_ENGINES_PAIRS_PAIRS_POINTS_H
#define PS_ENGINES_PAIRS_PAIRS_POINTS_H

#include "engines/engine.h"
#include "engines/feed.h"

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

#endif
