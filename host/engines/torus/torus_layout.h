/* Sizes of one torus_direct job: how much memory of which kind, for planning and for allocation. */
#ifndef PS_ENGINES_TORUS_TORUS_LAYOUT_H
#define PS_ENGINES_TORUS_TORUS_LAYOUT_H

#include "engines/engine.h"

/* Points of one chunk: the unit of partial sums, fixed so that sums do not depend on slabs. */
enum { PS_TORUS_CHUNK = 1024 };

/* Points summed in working precision before a pair takes the sum (kernels/torus/layout.h), in
 * products and in lists; errors and times against the length of a run are in
 * docs/engines/torus_direct.md. They divide PS_TORUS_CHUNK. */
enum { PS_TORUS_RUN = 32, PS_TORUS_LIST_RUN = 8 };

typedef struct ps_torus_layout {
    unsigned lanes;
    size_t real_bytes;
    bool is_grid;
    bool is_shared;                 /* products of blocks of tiles, and no table */
    ps_units units;                 /* of these: product_units.cl, or none: product_shared.cl */
    unsigned block_tiles;           /* of either side of a block */
    bool has_table;                 /* of cosines and sines, for other products */
    unsigned left_axes;             /* of a grid, see torus_split.h */
    size_t num_left, num_right;     /* frequencies; a list is all left */
    size_t left_tiles, right_tiles; /* of `lanes` frequencies */
    size_t max_pairs;               /* tile pairs, before those nobody needs are dropped */
    size_t max_blocks;              /* of them, likewise; with shared tables alone */
    size_t max_stride;              /* powers in a row, likewise */
    size_t group;        /* realizations whose tables are made and multiplied at a time */
    size_t slab;         /* points of each realization at a time, a multiple of chunks */
    size_t num_chunks;   /* in a slab */
    size_t table_points; /* from table row to table row: no more than a slab or a pattern has */
    uint64_t fixed_bytes, bytes_per_realization; /* of the job; of each row of a batch */
    uint64_t point_bytes;    /* of each realization besides, on the device and on the host */
    uint64_t largest_buffer; /* of those that do not depend on the batch */
    uint64_t largest_buffer_per_realization; /* of the others */
} ps_torus_layout;

/* Items of a work-group that shares factors, and its local memory: a run of both sides. */
size_t ps_torus_shared_items(const ps_torus_layout *layout);
size_t ps_torus_shared_bytes(const ps_torus_layout *layout);

/* Enumerates no frequencies, and so is cheap for planning. */
ps_torus_layout ps_torus_layout_make(const ps_problem *problem, const ps_device_limits *limits,
                                     ps_precision precision);

/* ps_survey.error for sets of num_points at most, whose mean effective power is as given. by_units:
 * products are those of kernels/torus/product_units.cl. */
double ps_torus_error(const ps_frequencies *frequencies, ps_precision precision, bool by_units,
                      double num_points, double mean_power);

#endif
