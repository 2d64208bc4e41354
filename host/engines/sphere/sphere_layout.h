/* Sizes of a job of sphere_direct: a pure function of problem, device and precision. */
#ifndef PS_ENGINES_SPHERE_SPHERE_LAYOUT_H
#define PS_ENGINES_SPHERE_SPHERE_LAYOUT_H

#include "engines/engine.h"

/* The sizes are those of kernels/sphere/layout.h. Points of a chunk: their state (8 numbers and two
 * exponents each, 20 KiB in single precision) stays in the first-level cache as far as a block of
 * degrees needs it. ORDERS: more orders of a work-item spread the cost of an exact beginning, but
 * each multiplies its rounding errors on. */
enum { PS_SPHERE_CHUNK = 512, PS_SPHERE_ORDERS = 16 };

/* On GPUs a work-group has so many items, and fewer orders, so that one set has work for all units:
 * 65 groups for L = 256. */
enum { PS_SPHERE_GPU_ITEMS = 64, PS_SPHERE_GPU_ORDERS = 4 };

/* Blocks of constants of the recurrence over degrees (sphere_table.c), for
 * kernels/sphere/legendre.h. */
enum { PS_SPHERE_DEGREES = 8, PS_SPHERE_BLOCK_REALS = 32 };

/* Blocks of degrees m .. max_degree. */
size_t ps_sphere_blocks(int32_t max_degree, int32_t m);
/* Blocks of all orders first .. first + num - 1; offsets[i] (NULL allowed) is where those of order
 * first + i begin. */
size_t ps_sphere_all_blocks(int32_t max_degree, int32_t first, size_t num, uint32_t *offsets);

/* (-1)^m sqrt((2m + 1)!! / (2m)!! / (4 pi)): Y_mm = that sin^m(theta) e^{i m phi}. One after the
 * other from constant = 1 / sqrt(4 pi) at m = 0. */
long double ps_sphere_next_constant(long double constant, int32_t m);

/* The blocks of an order, PS_SPHERE_BLOCK_REALS numbers each. */
void ps_sphere_fill_order(double *blocks, int32_t max_degree, int32_t m, long double constant);

/* Numbers of a point that kernels/sphere/prepare.cl makes, of a coefficient and of a power: (re,
 * im) and high, low. */
enum { PS_SPHERE_ARRAYS = 6, PS_SPHERE_SUMS = 4, PS_SPHERE_POWERS = 2 };

typedef struct ps_sphere_layout {
    int32_t max_degree;
    bool only_even;
    unsigned group_items, group_orders; /* of a work-group: JOBS and ORDERS */
    unsigned lanes, prepare_lanes;
    ps_precision precision;
    size_t real_bytes;
    size_t stride;      /* entries of a row of coefficients */
    size_t pass_orders; /* orders whose table and sums are in memory at a time */
    size_t num_passes;
    size_t pass_blocks; /* of the table, at most */
    size_t slab;        /* points of a realization on the device at a time */
    double fixed_bytes, bytes_per_realization, point_bytes, coordinate_bytes, largest_buffer,
        largest_buffer_per_realization;
} ps_sphere_layout;

ps_sphere_layout ps_sphere_layout_make(const ps_problem *problem, const ps_device_limits *limits,
                                       ps_precision precision);

/* Orders of a pass. */
size_t ps_sphere_pass_orders(const ps_sphere_layout *layout, size_t pass);

/* Degrees of points in the walks of kernels/sphere/sums.cl, which go by whole blocks of degrees and
 * vectors of points, and all that begins and ends them in units of the same time. */
double ps_sphere_harmonics(const ps_sphere_layout *layout, const ps_problem *problem,
                           const ps_device_limits *limits);

/* Expected error for sets of a mean power (ps_survey.error). */
double ps_sphere_error(const ps_problem *problem, ps_precision precision, double mean_power);

#endif
