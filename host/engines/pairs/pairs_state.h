/* What engines of pair sums have in common around their kernels: points of the sphere on their way
 * to the device, runs of pairs in slabs, partial sums of degrees, added up on the device, and
 * Q(l) = sum w^2 + 2 sum over pairs.
 */
#ifndef PS_ENGINES_PAIRS_PAIRS_STATE_H
#define PS_ENGINES_PAIRS_PAIRS_STATE_H

#include "engines/engine.h"
#include "engines/feed.h"
#include "engines/late_rows.h"

/* The arrays are those of kernels/pairs/layout.h. */
enum { PS_PAIRS_ARRAYS = 8 };

/* The sizes are those of kernels/pairs/walk.h. Vectors of a chunk: their state, four numbers each,
 * stays in the first-level cache (16 KiB with vectors of 64 bytes). Chunks of a run: enough work
 * for a work-item, and enough work-items. */
enum { PS_PAIRS_CHUNK = 64, PS_PAIRS_RUN_CHUNKS = 16, PS_PAIRS_RUN = 1024 };

/* Sums of runs come in two parts, high and low. */
enum { PS_PAIRS_PARTS = 2 };

typedef struct ps_pairs_layout {
    unsigned lanes;
    size_t stride;                  /* numbers of an array of a realization */
    size_t num_degrees;             /* of a row, rounded up */
    uint64_t run_vectors, num_runs; /* of pairs; of the largest realization */
    size_t slab;                    /* runs at a time */
    double points_bytes, row_bytes; /* of a realization; of both parts */
} ps_pairs_layout;

/* Numbers of an array of a realization of so many points. */
size_t ps_pairs_stride(uint64_t num_points, unsigned lanes);
/* Vectors of lanes of pairs that the kernels go through. */
uint64_t ps_pairs_vectors(uint64_t num_points, unsigned lanes);
/* All but the runs, and these: slabs of them have at most slab_bytes, or one run. */
ps_pairs_layout ps_pairs_layout_of(const ps_problem *problem, const ps_device_limits *limits,
                                   ps_precision precision);
void ps_pairs_layout_cut(ps_pairs_layout *layout, const ps_problem *problem, uint64_t run_vectors,
                         double run_bytes, double slab_bytes);

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

typedef struct ps_pairs_state {
    ps_device *device;
    ps_problem problem;
    ps_precision precision;
    ps_pairs_layout layout;
    uint64_t *host_counts; /* [batch] */
    double *squares;       /* [batch] sum w^2 of what was uploaded last */
    ps_feed points;        /* [batch][PS_PAIRS_ARRAYS][stride] */
    ps_buffer counts;
    ps_kernel *fold;
    ps_late_rows rows;
    ps_buffer partials;       /* of runs of a slab: made and filled by the engine */
    ps_buffer inverses, sums; /* [batch][PS_PAIRS_PARTS][num_degrees] */
} ps_pairs_state;

/* Zeroed memory must be given, which stays where it is; free it also after a failure. program: a
 * source that has kernels/pairs/fold.cl. */
pspec_status ps_pairs_create(ps_pairs_state *self, const char *program, const ps_problem *problem,
                             ps_precision precision, const ps_pairs_layout *layout, size_t batch,
                             ps_device *device, ps_error *error) PS_MUST_CHECK;
void ps_pairs_free(void *state); /* a ps_pairs_state, or what begins with one */

/* What all kernels of pairs are compiled with. */
ps_defines ps_pairs_defines(const ps_pairs_state *self);

/* All points of a batch, as directions in two parts, with weights w 2^-exponent. */
pspec_status ps_pairs_upload(ps_pairs_state *self, const ps_batch *batch,
                             ps_error *error) PS_MUST_CHECK;

/* Uploads a batch, and adds its slabs of runs by a function of an engine, whose state begins with
 * this one. */
typedef pspec_status ps_pairs_add(void *state, size_t num_patterns, uint64_t first, size_t num_runs,
                                  ps_error *error);
pspec_status ps_pairs_run(ps_pairs_state *self, const ps_batch *batch, ps_pairs_add *add_slab,
                          ps_error *error) PS_MUST_CHECK;
/* Adds partials[num_patterns][num_runs][high, low][num_degrees] to the sums, which begin anew with
 * is_first. */
pspec_status ps_pairs_fold(ps_pairs_state *self, const ps_buffer *partials, size_t num_patterns,
                           size_t num_runs, bool is_first, ps_error *error) PS_MUST_CHECK;
/* The rows of the batch that was run. */
pspec_status ps_pairs_read(ps_pairs_state *self, const ps_batch *batch, ps_rows *rows,
                           ps_error *error) PS_MUST_CHECK;

#endif
