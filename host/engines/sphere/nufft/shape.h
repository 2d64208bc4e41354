/* How sphere_nufft and sphere_grid treat a problem: the fine grid of longitude and angle from the
 * pole, rings, sizes of what is in memory, error and cost. A function of the problem, the precision
 * and the device. docs/engines/sphere_nufft.md and docs/engines/sphere_grid.md.
 */
#ifndef PS_ENGINES_SPHERE_NUFFT_SHAPE_H
#define PS_ENGINES_SPHERE_NUFFT_SHAPE_H

#include "engines/engine.h"
#include "engines/nufft/axis.h"
#include "engines/torus/nufft/layout.h"

/* Groups of orders in kernels/sphere/grid/ and in orders_sum.cl, orders_sum_one.cl and
 * degree_powers.cl of kernels/sphere/nufft/: each adds up those of its own. There are so many
 * whatever the device, since sums depend on it; enough that all cores have work to the end. */
enum { PS_SPHERE_GROUPS = 32 };

/* How c_lm is made of the grid. */
typedef enum ps_sphere_route {
    PS_SPHERE_BY_RINGS, /* sphere_nufft: transforms to rings, where Lambda_lm is known */
    PS_SPHERE_BY_CELLS, /* sphere_grid: a table of what each cell counts */
    PS_SPHERE_ON_GPU    /* sphere_nufft there: to rings by the grid of torus_nufft */
} ps_sphere_route;

/* Work-groups of kernels/sphere/nufft/degrees.cl, which names these, and its local memory in bytes.
 * rings == 0: it has no room for any. */
typedef struct ps_sphere_degree_sizes {
    uint32_t rings, sets;
    size_t table, columns, coefficients;
} ps_sphere_degree_sizes;

typedef struct ps_sphere_shape {
    ps_sphere_route route;
    int32_t max_degree;       /* L */
    ps_nufft_axis axis;       /* longitude and angle from the pole: n is even */
    uint32_t rings;           /* on a whole great circle through the poles, even and above 2 L */
    uint32_t num_rings;       /* in the northern quarter of it */
    uint32_t transform_rings; /* `rings`, or 0 by cells: they are there only while the table is
                                 made, before most of the rest */
    uint32_t num_angles;      /* of the grid, in the northern quarter of a great circle; by cells */
    uint32_t most_runs;       /* of vectors of degrees of an order and parity; by cells */
    uint64_t table_reals;     /* of the table, by cells */

    unsigned lanes;      /* 0: L is too large */
    uint32_t pole;       /* cells in front of the north pole */
    uint32_t half_poles; /* halves of cells in front of it: by cells it lies between two, so that
                            no angle is its own mirror image but for one at the equator */
    uint32_t pitch, grid_rows; /* of a grid */
    uint32_t columns;          /* with cells in them, whole groups */
    uint32_t pairs;            /* of tiles of orders */
    uint32_t ring_pitch;       /* rings up to whole vectors */
    uint32_t ring_lead;        /* rings of a set alone lie so much further, and fill units of rings
                                  up to the equator: there they cost most, at the pole nothing */
    uint32_t run_vectors;      /* RUN_VECTORS of orders_chains.h */
    ps_nufft_layout plane;     /* the grid on GPUs, of `together` realizations, */
    uint64_t plane_bytes;      /* and what it takes of each */
    ps_nufft_pass ring_pass;   /* transforms to rings there, */
    ps_sphere_degree_sizes degrees; /* and sums */
    bool is_one_set;                /* one realization is expected: sums by orders_sum_one.cl, */
    unsigned sum_lanes;             /* whose LANES these are */
    bool is_single_chain;           /* its Lambda_lm in single precision */
    uint32_t polar, crossing, equatorial; /* ring_angles of orders_states.h */
    uint32_t block;                       /* rings of a block of orders_sum.cl */
    uint32_t half_pitch;                  /* degrees of one parity, and room behind them */
    uint32_t bands, band_rows;            /* of a grid (kernels/sphere/bands.h) */
    uint32_t tiles;                       /* of angles from the pole, of sorted points */
    uint32_t strip;       /* columns of a strip (kernels/sphere/nufft/orders_strips.h) */
    bool is_sorted;       /* one realization at a time, in chunks of points */
    size_t at_once;       /* realizations between values on rings and powers */
    size_t together;      /* between points and values on rings */
    size_t slots;         /* grids */
    size_t shares;        /* work-groups for each grid */
    uint64_t most_points; /* on the device at a time */
    uint64_t set_points;  /* of a realization that comes in strips, else 0 */

    uint64_t grid_bytes;  /* of a grid, or of a strip */
    uint64_t row_bytes;   /* of the rows of a realization */
    uint64_t value_bytes; /* of values on rings, or on angles of the grid, of a realization */
    /* What a realization of a batch takes; what depends on at_once is there or in fixed_bytes */
    uint64_t each_bytes;
    uint64_t fixed_bytes, host_bytes, largest_buffer;
} ps_sphere_shape;

/* What the kernels need of a problem; axis.n == 0: L is too large. */
ps_sphere_shape ps_sphere_shape_make(const ps_problem *problem, const ps_device_limits *limits,
                                     ps_precision precision, ps_sphere_route route);

/* Only what the kernels need to make Lambda_lm on rings: of the rest nothing is there. */
ps_sphere_shape ps_sphere_rings_shape(int32_t max_degree, const ps_device_limits *limits,
                                      ps_precision precision);
/* Whether local memory has room for a block of them. */
bool ps_sphere_rings_fit(const ps_sphere_shape *shape, const ps_device_limits *limits,
                         size_t real_bytes);

/* Bytes of the largest table of sphere_grid. */
enum { PS_SPHERE_MOST_TABLE_BYTES = 64 << 20 };

/* Points of a realization that sphere_nufft sorts, to do it by all cores. */
enum { PS_SPHERE_LEAST_SORTED = 1 << 16 };

/* Whether a grid is done in strips, one for each work-group, or lies in memory as a whole. */
static inline bool ps_sphere_has_strips(const ps_sphere_shape *shape) {
    return shape->strip < shape->columns;
}

/* Makes the shape fit for batches of no more than `batch` realizations. */
void ps_sphere_shape_shrink(ps_sphere_shape *shape, size_t batch);

/* RING_VECTORS of orders_sum_one.cl: for each, registers hold three vectors and four of values. At
 * most 32 rings in all. */
static inline uint32_t ps_sphere_one_vectors(const ps_sphere_shape *shape) {
    const size_t bytes_of_32 = 64; /* of a vector: AVX-512 */
    return shape->sum_lanes * sizeof(double) == bytes_of_32 ? 3 : 2;
}

/* Its parts, of memory.c, axis.c and cost.c. How many realizations at once, and what all of it
 * takes, for a shape with a grid. */
void ps_sphere_count_memory(ps_sphere_shape *shape, const ps_problem *problem,
                            const ps_device_limits *limits, size_t real_bytes);

/* The grid, the same on both axes; the most exact one when none keeps the tolerance, n == 0: L is
 * too large. */
ps_nufft_axis ps_sphere_choose_axis(const ps_problem *problem, ps_precision precision,
                                    ps_sphere_route route);

/* Rings on a whole great circle: even, above 2 L, and half of them transforms well. */
uint32_t ps_sphere_ring_length(int32_t max_degree);

/* Cycles on a core, of what depends on the grid. */
double ps_sphere_grid_cycles(const ps_nufft_axis *axis, const ps_problem *problem,
                             ps_precision precision, ps_sphere_route route);

/* Bytes of the buffers, which have the names of kernels/sphere/; values, powers and sums for each
 * of at_once realizations, sums for one more. */
typedef struct ps_sphere_bytes {
    uint64_t vectors, turns, weights; /* sorted points have turns and weights twice */
    uint64_t keys, starts;
    uint64_t grids, rows, scratch;
    uint64_t strip_turns, strip_weights, strips, strip_starts;
    uint64_t values, powers, sums;
    uint64_t gaps;                   /* between the values of orders: kernels/sphere/values.h */
    uint64_t staged, staged_heights; /* of points on their way to bands */
    uint64_t states, scales, diagonals;
    uint64_t table;
} ps_sphere_bytes;
ps_sphere_bytes ps_sphere_bytes_of(const ps_sphere_shape *shape, size_t real_bytes);

/* axis.loss for the sphere: mean square of what aliases do, and the most when all power is in step.
 */
void ps_sphere_nufft_loss(const ps_nufft_axis *axis, double *aliasing, double *worst);

/* Expected error for sets of a mean power (ps_survey.error). */
double ps_sphere_nufft_error(const ps_nufft_axis *axis, const ps_problem *problem,
                             ps_precision precision, double mean_power, ps_sphere_route route);

/* What Lambda_lm in single precision adds to it, by squares. */
double ps_sphere_chain_error(const ps_nufft_axis *axis, const ps_problem *problem,
                             double mean_power);

/* What a device at its peak would do while it works on one realization. */
double ps_sphere_nufft_flops(const ps_sphere_shape *shape, const ps_problem *problem,
                             ps_precision precision, double num_realizations);

/* Local memory in bytes: of orders.cl, orders_bands.cl and grid/values.cl, and of orders_sum.cl and
 * grid/table.cl. */
typedef struct ps_sphere_local {
    size_t windows, cells;
    size_t table, coefficients, begins;
} ps_sphere_local;
ps_sphere_local ps_sphere_local_bytes(const ps_sphere_shape *shape, size_t real_bytes);

ps_sphere_degree_sizes ps_sphere_degrees_measure(bool is_one_set, const ps_device_limits *limits,
                                                 size_t real_bytes);
/* The grid on GPUs: how torus_nufft treats it, with an axis of longitudes and one of great circles,
 * and its sizes for up to num_sets sets at a time. */
ps_nufft_choice ps_sphere_plane_choice(const ps_nufft_axis *axis, const ps_problem *problem,
                                       ps_precision precision);
ps_nufft_layout ps_sphere_plane_layout(const ps_sphere_shape *shape, const ps_problem *problem,
                                       const ps_device_limits *limits, ps_precision precision,
                                       size_t num_sets);
/* Numbers from order to order in values on rings there. */
static inline size_t ps_sphere_order_apart(const ps_sphere_shape *shape) {
    return shape->at_once * 4 * shape->ring_pitch;
}

/* Bytes of the coefficients of a realization there. */
uint64_t ps_sphere_degrees_bytes(const ps_sphere_shape *shape, size_t real_bytes);

/* Points that are sorted together, and parts of a chunk of a large set. Sums depend on them: the
 * same on all devices. */
enum { PS_SPHERE_PART_POINTS = 1 << 16, PS_SPHERE_PARTS = 16 };

/* Numbers that kernels/sphere/ agrees on, as it names them. */
enum {
    PS_SPHERE_TILE_CELLS = 64,  /* bands.h */
    PS_SPHERE_RING_VECTORS = 2, /* orders_chains.h: in double precision, with a table */
    PS_SPHERE_ONE_RUN = 8,      /* orders_one.h: RUN_VECTORS, whose sums the nearest cache holds */
    PS_SPHERE_SCALE = 100,      /* scales.h: the exponent of SCALE_UP */
    PS_SPHERE_COEFFICIENTS = 9, /* orders_chains.h: COEFFICIENTS for each degree of a run */
    PS_SPHERE_CHAIN_AHEAD = 4,  /* orders_chains.h: and these */
    PS_SPHERE_TABLE_ANGLES = 8  /* grid/table.cl: ANGLES */
};

#endif
