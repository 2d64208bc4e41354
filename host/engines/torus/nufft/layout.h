/* Sizes of one torus_nufft job: how much memory of which kind, for planning and for allocation. */
#ifndef PS_ENGINES_TORUS_NUFFT_LAYOUT_H
#define PS_ENGINES_TORUS_NUFFT_LAYOUT_H

#include "engines/nufft/order.h"
#include "engines/torus/nufft/sizes/boxes.h"
#include "engines/torus/nufft/sizes/grid.h"
#include "engines/torus/nufft/sizes/lines.h"
#include "engines/torus/nufft/sizes/strips.h"
#include "engines/torus/nufft/sizes/whole.h"

/* Buffers of the grid of a large set. */
enum { PS_NUFFT_MOST_SLABS = 16 };

/* Parts of a chunk of a large set, which are sorted side by side. */
enum { PS_NUFFT_MOST_PARTS = 8 };

/* Work-groups for each core that each do whole realizations: so few that grids stay in the cache,
 * so many that no core waits long for another. */
enum { PS_NUFFT_GROUPS_PER_CORE = 4 };

typedef struct ps_nufft_layout {
    ps_nufft_choice choice;
    unsigned lanes; /* 0: no row fits into local memory */
    uint32_t num_tiles;
    size_t real_bytes;
    size_t chunk_reals; /* kernels/nufft/spread.h: of points, without their turns */
    size_t row_bytes;   /* of each row of a work-group, the longest (local.h) */
    uint32_t group;     /* tiles of a work-group */
    size_t stride;      /* powers in a row */
    ps_nufft_line_sizes line;
    size_t first_line_power; /* behind those of tiles */
    size_t grid_cells;       /* of a realization between two transforms, [..][re, im][lanes] */
    size_t grid_reals;       /* cells of the grid of a large set */
    ps_nufft_boxes boxes;    /* in which points are spread there */
    bool has_pairs;          /* chunks are accumulated in double-word arithmetic (high, low) */
    /* Cells of axis 0 whose part of that grid is in one buffer; all, where that fits */
    uint32_t slab_rows;
    uint32_t num_slabs;
    size_t strip_columns;   /* cells of the other axes transformed along axis 0 at a time; 0: all */
    uint32_t tiles_at_once; /* made of the grid at a time */
    uint32_t num_keys; /* cells that points are sorted by: those of the axes from first_key on, */
    unsigned first_key;
    bool has_boxes;     /* or boxes */
    size_t part_points; /* points sorted together: all of a realization, or part of a chunk */
    size_t part_places; /* whole units of places for them */
    size_t parts;       /* whose places are made at a time */
    ps_nufft_order_sizes order; /* of the points of parts, on GPUs */
    ps_nufft_whole_sizes whole;
    ps_nufft_strip_sizes strips;
    ps_nufft_grid_sizes grid;
    size_t groups; /* of whole realizations, and of those in strips */
    uint64_t fixed_bytes, bytes_per_realization;
    uint64_t host_bytes; /* part of fixed_bytes: weights as they came */
    uint64_t largest_buffer, largest_buffer_per_realization;
} ps_nufft_layout;

ps_nufft_layout ps_nufft_layout_make(const ps_problem *problem, const ps_device_limits *limits,
                                     ps_precision precision);

/* The same of a choice that was made among some. */
ps_nufft_layout ps_nufft_layout_of(const ps_nufft_choice *choice, const ps_problem *problem,
                                   const ps_device_limits *limits, ps_precision precision);

/* Leaves room for places, grids and tiles of so many realizations, where a batch is smaller than
 * was planned. */
void ps_nufft_layout_shrink(ps_nufft_layout *layout, size_t batch);

#endif
