/* The order of the points of sets by keys on GPUs (kernels/nufft/order.cl): stable, so that it is
 * the order of the sort of CPUs (nufft/sort.cl), whatever the sizes.
 * Owns the keys, which the caller's kernel makes, and all that is between them and sorted points.
 */
#ifndef PS_ENGINES_NUFFT_ORDER_H
#define PS_ENGINES_NUFFT_ORDER_H

#include "engines/engine.h"

/* A function of the limits of the device and of the largest set. */
typedef struct ps_nufft_order_sizes {
    uint32_t tile;    /* keys that a work-group sorts; 0: a CPU, which has none of this */
    uint32_t workers; /* of a tile */
    uint32_t tiles;   /* of the largest set */
    uint32_t digit_bits, num_digits; /* of keys, by which sets are ordered one after the other */
    bool is_direct;                  /* tiles are sets, and order_tiles makes the order itself */
    uint32_t row;                    /* numbers for each tile */
    uint32_t starts_row;             /* numbers for each set: at least num_keys + 1 */
    size_t points;                   /* of the largest set */
} ps_nufft_order_sizes;

ps_nufft_order_sizes ps_nufft_order_measure(const ps_device_limits *limits, size_t most_points,
                                            uint32_t num_keys, uint32_t starts_row);
/* Memory for each set, and what the largest buffer takes of it. */
uint64_t ps_nufft_order_bytes(const ps_nufft_order_sizes *sizes);
uint64_t ps_nufft_order_largest(const ps_nufft_order_sizes *sizes);
/* Of sorting a batch, with that of keys; the sort of CPUs is one. */
double ps_nufft_order_launches(const ps_nufft_order_sizes *sizes);

/* What is sorted, by the names of kernels/nufft/order.cl; all is the caller's. */
typedef struct ps_nufft_order_points {
    const ps_buffer *points, *weights, *offsets, *places;
    const ps_buffer *sorted, *heights, *starts;
    bool has_weights; /* else all are 1 */
} ps_nufft_order_points;

typedef struct ps_nufft_order {
    ps_nufft_order_sizes sizes;
    ps_device *device;
    ps_kernel *tiles, *segments, *sum, *scatter, *start, *move;
    ps_buffer keys;      /* [point] */
    ps_buffer orders[3]; /* of tiles, and two that take turns */
    ps_buffer firsts, sums;
} ps_nufft_order;

/* For up to num_sets sets of points of `dimension` coordinates. */
pspec_status ps_nufft_order_create(ps_nufft_order *out, const ps_nufft_order_sizes *sizes,
                                   size_t num_sets, unsigned dimension, ps_precision precision,
                                   ps_device *device, ps_error *error) PS_MUST_CHECK;
void ps_nufft_order_free(ps_nufft_order *order); /* {0} is allowed */
/* Sorts by order->keys, which were made before. */
pspec_status ps_nufft_order_run(ps_nufft_order *order, const ps_nufft_order_points *points,
                                size_t num_sets, ps_error *error) PS_MUST_CHECK;

#endif
