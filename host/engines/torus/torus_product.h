/* Products of the two factors of a grid on the device: tile pairs from tables, each by one
 * work-item, or blocks of them by work-groups that make the factors in local memory, and multiply
 * by matrix units where the layout has them. */
#ifndef PS_ENGINES_TORUS_TORUS_PRODUCT_H
#define PS_ENGINES_TORUS_TORUS_PRODUCT_H

#include "device/device.h"
#include "engines/torus/torus_split.h"
#include "engines/torus/torus_sums.h"
#include "torus/product.h"

typedef struct ps_torus_product {
    ps_kernel *kernel;
    size_t num_blocks; /* 0: tile pairs one by one */
    size_t local_bytes, sharing_items;
    bool has_units;      /* blocks by matrix units */
    double pair_numbers; /* products of numbers in a pair of tiles */
    double point_bytes;  /* read for each point: a row of the table, or the point by every block */
    double point_flops;  /* of the factors that blocks make */
    ps_buffer pairs, blocks;
    ps_buffer sums; /* [group][pair][left in tile][cc, sc, cs, ss][high, low][lanes] */
} ps_torus_product;

/* What is multiplied: tables of kernels/torus/list.cl where the layout has them, else what they are
 * made of; of num_patterns realizations with num_points points together. */
typedef struct ps_torus_factors {
    const ps_torus_sums *sums;
    const ps_torus_points *points;
    const ps_buffer *scales;
    size_t num_patterns, num_points;
} ps_torus_factors;

/* The split must outlive nothing: it is read here alone. */
pspec_status ps_torus_product_create(ps_torus_product *out, const ps_torus_layout *layout,
                                     const ps_split *split, ps_device *device,
                                     ps_error *error) PS_MUST_CHECK;
void ps_torus_product_free(ps_torus_product *product);

/* Adds the factors to the sums, and writes powers when numbers->is_last is set. */
pspec_status ps_torus_product_add(ps_torus_product *self, const product_numbers *numbers,
                                  const ps_torus_factors *factors, const ps_buffer *power,
                                  ps_device *device, ps_error *error) PS_MUST_CHECK;

#endif
