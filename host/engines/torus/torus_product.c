#include "engines/torus/torus_product.h"

#include "base/memory.h"
#include "base/round.h"

#include <stdlib.h>

/* ---- blocks ------------------------------------------------------------------------------ */

/* [block]: first tiles; [block][tiles][tiles]: pairs. */
typedef struct block_list {
    uint32_t (*first_tiles)[2];
    uint32_t *pairs;
    size_t num, tiles;
} block_list;

/* Returns how many of the pairs of a block somebody needs. */
static size_t fill_block(const block_list *list, const ps_split *split, size_t first_left,
                         size_t first_right) {
    uint32_t *const pairs = list->pairs + list->num * list->tiles * list->tiles;
    size_t needed = 0;
    for (size_t i = 0; i < list->tiles * list->tiles; i++) {
        const size_t left = first_left + i / list->tiles;
        const size_t right = first_right + i % list->tiles;
        const bool is_there = left < split->left.num_tiles && right < split->right.num_tiles;
        pairs[i] = is_there ? split->pair_of_tiles[left * split->right.num_tiles + right] : NO_PAIR;
        needed += pairs[i] != NO_PAIR;
    }
    return needed;
}

static void fill_blocks(block_list *list, const ps_split *split) {
    for (size_t left = 0; left < split->left.num_tiles; left += list->tiles) {
        for (size_t right = 0; right < split->right.num_tiles; right += list->tiles) {
            if (fill_block(list, split, left, right) > 0) {
                list->first_tiles[list->num][0] = (uint32_t)left;
                list->first_tiles[list->num][1] = (uint32_t)right;
                list->num++;
            }
        }
    }
}

static pspec_status upload_blocks(ps_torus_product *self, const ps_torus_layout *layout,
                                  const ps_split *split, ps_device *device, ps_error *error) {
    const size_t tiles = layout->block_tiles;
    block_list list = {.tiles = tiles};
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, PS_NEW(&list.first_tiles, layout->max_blocks, "tile pairs", error));
    PS_TRY_OUT(status,
               PS_NEW(&list.pairs, layout->max_blocks * tiles * tiles, "tile pairs", error));
    fill_blocks(&list, split);
    self->num_blocks = list.num;
    PS_TRY_OUT(status, ps_buffer_upload(device, &self->blocks, list.first_tiles,
                                        list.num * sizeof *list.first_tiles, "tile pairs", error));
    PS_TRY_OUT(status, ps_buffer_upload(device, &self->pairs, list.pairs,
                                        list.num * tiles * tiles * sizeof *list.pairs, "tile pairs",
                                        error));
out:
    free(list.first_tiles);
    free(list.pairs);
    return status;
}

/* ---- create and free --------------------------------------------------------------------- */

static pspec_status create_kernel(ps_torus_product *self, const ps_torus_layout *layout,
                                  unsigned dimension, ps_device *device, ps_error *error) {
    static const char *const kernels[3][2] = {{"torus/product.cl", "torus_product"},
                                              {"torus/product_shared.cl", "torus_product_shared"},
                                              {"torus/product_units.cl", "torus_product_units"}};
    const bool has_units = layout->units != PS_UNITS_NONE;
    const char *const *const kernel = kernels[has_units ? 2 : layout->is_shared];
    ps_defines defines = ps_torus_defines(layout, dimension);
    if (has_units) {
        ps_defines_add(&defines, "-DTILES=%u %s", layout->block_tiles,
                       ps_units_option(layout->units));
    }
    return ps_kernel_get(device, &self->kernel, kernel[0], kernel[1], defines.text, error);
}

pspec_status ps_torus_product_create(ps_torus_product *out, const ps_torus_layout *layout,
                                     const ps_split *split, ps_device *device, ps_error *error) {
    const size_t lanes = layout->lanes;
    const double tiles = (double)(layout->left_tiles + layout->right_tiles);
    *out = (ps_torus_product){.local_bytes = ps_torus_shared_bytes(layout),
                              .sharing_items = ps_torus_shared_items(layout),
                              .has_units = layout->units != PS_UNITS_NONE,
                              .pair_numbers = (double)(lanes * lanes),
                              .point_bytes = tiles * (double)(2 * lanes * layout->real_bytes)};
    PS_TRY(create_kernel(out, layout, split->dimension, device, error));
    if (layout->is_shared) {
        PS_TRY(upload_blocks(out, layout, split, device, error));
        out->point_bytes = (double)out->num_blocks *
                           (double)(split->dimension * sizeof(uint64_t) + layout->real_bytes);
        out->point_flops = (double)out->num_blocks * 2 * layout->block_tiles * (double)lanes *
                           ps_torus_phase_flops(split->dimension, layout->real_bytes);
    } else {
        PS_TRY(ps_buffer_upload(device, &out->pairs, split->pairs,
                                split->num_pairs * sizeof *split->pairs, "tile pairs", error));
    }
    return ps_buffer_create(device, &out->sums,
                            layout->group * split->num_pairs * lanes * 8 * lanes *
                                layout->real_bytes,
                            "sums of products", error);
}

void ps_torus_product_free(ps_torus_product *product) {
    PS_BUFFERS_RELEASE(&product->pairs, &product->blocks, &product->sums);
    *product = (ps_torus_product){0};
}

/* ---- add --------------------------------------------------------------------------------- */

static pspec_status add_blocks(ps_torus_product *self, const product_numbers *numbers,
                               const ps_torus_factors *factors, double flops, double bytes,
                               const ps_buffer *power, ps_device *device, ps_error *error) {
    const ps_torus_points *const points = factors->points;
    /* As many items as a block has jobs, so that factors are made once. */
    ps_range range = ps_range_shared(device, self->sharing_items, self->num_blocks,
                                     factors->num_patterns, flops, bytes);
    if (self->has_units) { /* whose kernels serve this number alone */
        range.global[0] = range.local[0] = self->sharing_items;
    }
    return PS_LAUNCH(device, self->kernel, &range, error, PS_STRUCT(*numbers),
                     PS_BUFFER(points->points), PS_BUFFER(points->weights),
                     PS_BUFFER(points->offsets), PS_BUFFER(factors->sums->frequencies),
                     PS_BUFFER(self->blocks), PS_BUFFER(self->pairs), PS_BUFFER(self->sums),
                     PS_BUFFER(*factors->scales), PS_BUFFER(*power), PS_LOCAL(self->local_bytes));
}

pspec_status ps_torus_product_add(ps_torus_product *self, const product_numbers *numbers,
                                  const ps_torus_factors *factors, const ps_buffer *power,
                                  ps_device *device, ps_error *error) {
    const double num_points = (double)factors->num_points;
    const double flops =
        num_points * (8 * (double)numbers->num_pairs * self->pair_numbers + self->point_flops);
    const double bytes = num_points * self->point_bytes;
    if (self->num_blocks > 0) {
        return add_blocks(self, numbers, factors, flops, bytes, power, device, error);
    }
    const ps_range range =
        ps_range_heavy(device, numbers->num_pairs, factors->num_patterns, 1, flops, bytes);
    return PS_LAUNCH(device, self->kernel, &range, error, PS_STRUCT(*numbers),
                     PS_BUFFER(factors->sums->table), PS_BUFFER(factors->points->offsets),
                     PS_BUFFER(self->pairs), PS_BUFFER(self->sums), PS_BUFFER(*factors->scales),
                     PS_BUFFER(*power));
}
