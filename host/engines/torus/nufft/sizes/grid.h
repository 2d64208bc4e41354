/* The grid of GPUs: boxes in which points are spread (kernels/nufft/grid/spread.cl), and passes
 * of its transform. */
#ifndef PS_ENGINES_TORUS_NUFFT_SIZES_GRID_H
#define PS_ENGINES_TORUS_NUFFT_SIZES_GRID_H

#include "device/device.h"
#include "engines/torus/nufft/choice.h"

/* The passes that transform the grid of GPUs (kernels/nufft/grid/lines.cl): the last axis first,
 * an axis at a time, in two halves where its lines are too long for a work-group. */

enum { PS_NUFFT_PASS_RADICES = 4, PS_NUFFT_MOST_PASSES = 2 * PS_NUFFT_MAX_AXES };

typedef struct ps_nufft_pass {
    unsigned axis;
    uint32_t length;                         /* of lines */
    uint32_t radices[PS_NUFFT_PASS_RADICES]; /* 1: none */
    uint32_t lines_at_once, items;           /* of a work-group */
    bool is_first, is_last;                  /* reads cells, makes powers */
    bool is_turned;                          /* the first half of an axis */
    uint64_t lines, inner;                   /* of a set: kernels/nufft/grid/grid.h */
    uint64_t from, to;                       /* numbers of a set */
    uint32_t apart, neighbours;
} ps_nufft_pass;

/* The passes of a choice, and how many; 0: an axis has no such lengths. */
unsigned ps_nufft_passes_measure(ps_nufft_pass passes[PS_NUFFT_MOST_PASSES],
                                 const ps_nufft_choice *choice, const ps_device_limits *limits,
                                 size_t real_bytes);

/* The same of `lines` lines of a set that are nothing else's axis; false: they are too long. */
bool ps_nufft_pass_measure(ps_nufft_pass *pass, uint32_t length, uint64_t lines,
                           const ps_device_limits *limits, size_t real_bytes);

/* Numbers of local memory that a line takes (kernels/nufft/grid/stockham.h). */
size_t ps_nufft_line_reals(uint32_t length);

/* By the axes of the kernels: those that a problem does not have come first, one cell long. */
typedef struct ps_nufft_grid_sizes {
    uint32_t cells[PS_NUFFT_MAX_AXES];
    uint32_t edges[PS_NUFFT_MAX_AXES]; /* of a box: powers of 2 that divide the cells */
    uint32_t sides[PS_NUFFT_MAX_AXES]; /* with the cells behind it */
    uint32_t boxes[PS_NUFFT_MAX_AXES];
    uint32_t pitch, copies; /* of a box, in local memory */
    uint32_t flush;         /* points after which a box puts sums into pairs */
    size_t tile_reals;      /* of all boxes of a set */
    size_t local_bytes;     /* the most that a launch takes */
    size_t numbers[2];      /* complex numbers of a set behind every other pass */
    unsigned num_passes;    /* 0: this cannot be done */
    ps_nufft_pass passes[PS_NUFFT_MOST_PASSES];
} ps_nufft_grid_sizes;

ps_nufft_grid_sizes ps_nufft_grid_measure(const ps_nufft_choice *choice, double num_points,
                                          const ps_device_limits *limits, size_t real_bytes);

/* tile_reals where local memory has 48 KiB, as drivers of GPUs offer; what costs are counted by. */
double ps_nufft_grid_nominal_tile(const ps_nufft_choice *choice, double num_points,
                                  size_t real_bytes);

size_t ps_nufft_grid_boxes(const ps_nufft_grid_sizes *sizes);
/* Local memory of the launch that spreads: numbers of copies, of windows, and cells. */
typedef struct ps_nufft_grid_local {
    size_t copies, windows, cells;
} ps_nufft_grid_local;
ps_nufft_grid_local ps_nufft_grid_spread_local(const ps_nufft_grid_sizes *sizes,
                                               const ps_nufft_choice *choice, size_t real_bytes);

/* Points for each cell of the grid after which boxes put sums into pairs. */
#define PS_NUFFT_GRID_FLUSH 0.5

#endif
