/* How sphere_nufft treats a problem: the fine grid of longitude and angle from the pole, rings, sizes of what is
 * in memory, error and cost. A function of the problem, the precision and the device. docs/sphere_nufft.md.
 */
#ifndef PS_ENGINES_SPHERE_NUFFT_SHAPE_H
#define PS_ENGINES_SPHERE_NUFFT_SHAPE_H

#include "engines/engine.h"
#include "engines/nufft_choice.h"

/* Of orders, in kernels/sphere/orders_sum.cl: each adds up those of its own. A number of its own, whatever the
 * device, since sums depend on it; enough that all cores have work to the end. */
enum { PS_SPHERE_GROUPS = 32 };

typedef struct ps_sphere_shape {
    int32_t max_degree; /* L */
    ps_nufft_axis axis; /* longitude and angle from the pole: n is even */
    uint32_t rings;     /* on a whole great circle through the poles, even and above 2 L */
    uint32_t num_rings; /* in the northern quarter of it */

    unsigned lanes,
        sum_lanes; /* of orders.cl, and of orders_sum.cl; lanes 0: rows do not fit into local memory */
    uint32_t pole;             /* cells in front of the north pole */
    uint32_t pitch, grid_rows; /* of a grid */
    uint32_t columns;          /* with cells in them, whole groups */
    uint32_t pairs;            /* of tiles of orders */
    uint32_t ring_pitch;       /* rings up to whole vectors */
    uint32_t block;            /* rings of a block of orders_sum.cl */
    uint32_t half_pitch;       /* degrees of one parity, and room behind them */
    size_t at_once;            /* realizations between points and powers */
    size_t slots;              /* grids */
    size_t shares;             /* work-groups for each grid */

    uint64_t slot_bytes,
        value_bytes; /* of a grid and its rows; of values on rings of a realization */
    uint64_t fixed_bytes, host_bytes, largest_buffer;
} ps_sphere_shape;

/* What the kernels need of a problem; axis.n == 0: L is too large. */
ps_sphere_shape ps_sphere_shape_make(const ps_problem *problem, const ps_device_limits *limits,
                                     ps_precision precision);

/* axis.loss for the sphere: mean square of what aliases do, and the most when all power is in step. */
void ps_sphere_nufft_loss(const ps_nufft_axis *axis, double *aliasing, double *worst);

/* ps_engine.error */
double ps_sphere_nufft_error(const ps_nufft_axis *axis, const ps_problem *problem,
                             ps_precision precision, double mean_power);

/* What a device at its peak would do while it works on one realization. */
double ps_sphere_nufft_flops(const ps_sphere_shape *shape, ps_precision precision,
                             double num_points, double num_realizations);

/* Local memory in bytes: of orders.cl (data, spectrum, windows) and of orders_sum.cl (table, coefficients). */
typedef struct ps_sphere_local {
    size_t data, spectrum, windows, cells;
    size_t table, coefficients, begins;
} ps_sphere_local;
ps_sphere_local ps_sphere_local_bytes(const ps_sphere_shape *shape, size_t real_bytes);

/* Numbers that kernels/sphere/ agrees on, as it names them. */
enum {
    PS_SPHERE_RUN_VECTORS = 4, /* orders_table.h */
    PS_SPHERE_SCALE = 100      /* orders_table.h: the exponent of SCALE_UP */
};

#endif
