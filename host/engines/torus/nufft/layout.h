/* Sizes of one torus_nufft job: how much memory of which kind, for planning and for allocation. */
#ifndef PS_ENGINES_TORUS_NUFFT_LAYOUT_H
#define PS_ENGINES_TORUS_NUFFT_LAYOUT_H

#include "engines/nufft/order.h"
#include "engines/torus/nufft/choice.h"
#include "engines/torus/nufft/sizes/grid.h"

/* Sizes of realizations that one work-group does whole (kernels/nufft/whole.cl): what their two
 * transforms keep, memory.
 */

/* Sizes in memory, in cells and numbers. */
typedef struct ps_nufft_whole_sizes {
    uint32_t columns;    /* of a row of a tile: whole vectors, twice */
    uint32_t pitch;      /* of a row of the grid */
    uint32_t grid_rows;  /* with those behind the end */
    size_t grid_reals;   /* of a work-group, */
    size_t row_reals;    /* and of a row of a tile, with what stands behind it */
    uint32_t shared;     /* lanes of the last tile, where realizations share it, else 0 */
    size_t window_reals; /* of a chunk */
} ps_nufft_whole_sizes;

/* Gives the largest frequency that each of the two transforms of a whole realization keeps. In one
 * dimension, frequency k_1 + lengths[0] k_2, |k_1| <= kept[0], is k_1 of the first and k_2 of the
 * second. */
void ps_nufft_whole_kept(const ps_nufft_choice *choice, uint32_t kept[2]);

/* Lanes of the last tile that realizations share; 0: they do not. lanes: those of the device, or
 * fewer. */
uint32_t ps_nufft_whole_shared(const ps_nufft_choice *choice, unsigned lanes);

ps_nufft_whole_sizes ps_nufft_whole_measure(const ps_nufft_choice *choice, unsigned lanes);

/* Sizes of the strips of a grid in two dimensions (kernels/nufft/strips.cl). */

typedef struct ps_nufft_strip_sizes {
    uint32_t columns, pitch; /* of a strip, and with those behind it that windows reach into */
    size_t strip_reals;
    size_t tile_reals;   /* of all tiles */
    size_t window_reals; /* of a chunk */
} ps_nufft_strip_sizes;

/* Columns of a strip; axis 1 of the grid has a multiple of them. */
uint32_t ps_nufft_strip_columns(unsigned lanes);

/* lanes: those of the device, or fewer. */
ps_nufft_strip_sizes ps_nufft_strips_measure(const ps_nufft_choice *choice, unsigned lanes);

/* Tiles of a realization belong to one core: false where they are more than 32 MiB, for several
 * realizations have theirs at a time. */
bool ps_nufft_strips_fit(const ps_nufft_choice *choice, ps_precision precision);

/* Sizes of the line of frequency 0 of axis 0 (kernels/nufft/line.h), and when a choice has one. */

typedef struct ps_nufft_line_sizes {
    size_t cells;        /* of a realization */
    size_t grid_reals;   /* between two transforms, of as many realizations as lanes */
    size_t powers;       /* of a realization, up to a whole vector */
    size_t spread_reals; /* local memory, in which points are added */
} ps_nufft_line_sizes;

/* lanes: those of the device, or fewer. All 0 where the choice has no line. */
ps_nufft_line_sizes ps_nufft_lines_measure(const ps_nufft_choice *choice, unsigned lanes);

/* Frequency 0 of axis 0 is a line of real numbers where it would be alone in a tile: for several
 * realizations, which share the transform of lines. Measured (Zen 4): 0.70 to 0.94 of the time
 * in three dimensions, 0.83 to 1.0 in two (docs/engines/torus_nufft.md). */
bool ps_nufft_lines_pay(const ps_nufft_choice *choice, const ps_problem *problem);

/* Boxes of cells in which points of a large set are spread (kernels/nufft/boxes.cl). */

/* By the axes of the kernel: in two dimensions those of the grid are its axes 1 and 2, and axis 0
 * has one cell in one box. */
typedef struct ps_nufft_boxes {
    uint32_t num[PS_NUFFT_MAX_AXES], per_cell[PS_NUFFT_MAX_AXES]; /* kernels/nufft/boxes.h */
    /* Boxes of a colour share no cell; num is a multiple of them */
    uint32_t colours[PS_NUFFT_MAX_AXES];
    /* Numbers of the largest box with the cells behind it that windows touch */
    uint32_t sides[PS_NUFFT_MAX_AXES];
} ps_nufft_boxes;

/* The boxes of a grid of two or three axes; halvings: of their edges, for less local memory. */
ps_nufft_boxes ps_nufft_boxes_measure(const ps_nufft_choice *choice, unsigned halvings);

size_t ps_nufft_boxes_count(const ps_nufft_boxes *boxes);
/* Of one colour. */
size_t ps_nufft_boxes_of_colour(const ps_nufft_boxes *boxes);
size_t ps_nufft_boxes_reals(const ps_nufft_boxes *boxes);

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

/* Of frequency k in a row of tiles. */
uint32_t ps_nufft_tile_slot(const ps_nufft_layout *layout, const int32_t *k, unsigned dimension);

#endif
