#include "engines/torus/torus_product.h"

#include "base/memory.h"
#include "base/round.h"
#include "engines/torus/torus_sums.h"

#include <stdlib.h>

/* Work-items that share tables: as many as a block of vectors of 4 has strips times right tiles, so
 * that its tables are read once. */
enum { SHARING_ITEMS = 128 };

static pspec_status upload(ps_device *device, ps_buffer *buffer, const void *data, size_t bytes,
                           ps_error *error) {
    PS_TRY(ps_buffer_create(device, buffer, bytes, "tile pairs", error));
    return ps_buffer_write(device, buffer, 0, data, bytes, error);
}

/* ---- blocks ------------------------------------------------------------------------------ */

/* [block]: first tiles; [block][BLOCK_TILES][BLOCK_TILES]: pairs. */
typedef struct block_list {
    uint32_t (*first_tiles)[2];
    uint32_t (*pairs)[BLOCK_TILES * BLOCK_TILES];
    size_t num;
} block_list;

/* Returns how many of the pairs of a block somebody needs. */
static size_t fill_block(const ps_split *split, size_t first_left, size_t first_right,
                         uint32_t *pairs) {
    size_t needed = 0;
    for (size_t i = 0; i < BLOCK_TILES * BLOCK_TILES; i++) {
        const size_t left = first_left + i / BLOCK_TILES;
        const size_t right = first_right + i % BLOCK_TILES;
        const bool is_there = left < split->left.num_tiles && right < split->right.num_tiles;
        pairs[i] = is_there ? split->pair_of_tiles[left * split->right.num_tiles + right] : NO_PAIR;
        needed += pairs[i] != NO_PAIR;
    }
    return needed;
}

static void fill_blocks(block_list *list, const ps_split *split) {
    for (size_t left = 0; left < split->left.num_tiles; left += BLOCK_TILES) {
        for (size_t right = 0; right < split->right.num_tiles; right += BLOCK_TILES) {
            if (fill_block(split, left, right, list->pairs[list->num]) > 0) {
                list->first_tiles[list->num][0] = (uint32_t)left;
                list->first_tiles[list->num][1] = (uint32_t)right;
                list->num++;
            }
        }
    }
}

static pspec_status upload_blocks(ps_torus_product *self, const ps_torus_layout *layout,
                                  const ps_split *split, ps_device *device, ps_error *error) {
    block_list list = {0};
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, PS_NEW(&list.first_tiles, layout->max_blocks, "tile pairs", error));
    PS_TRY_OUT(status, PS_NEW(&list.pairs, layout->max_blocks, "tile pairs", error));
    fill_blocks(&list, split);
    self->num_blocks = list.num;
    PS_TRY_OUT(status, upload(device, &self->blocks, list.first_tiles,
                              list.num * sizeof *list.first_tiles, error));
    PS_TRY_OUT(status,
               upload(device, &self->pairs, list.pairs, list.num * sizeof *list.pairs, error));
out:
    free(list.first_tiles);
    free(list.pairs);
    return status;
}

/* ---- create and free --------------------------------------------------------------------- */

static pspec_status create_kernel(ps_torus_product *self, const ps_torus_layout *layout,
                                  unsigned dimension, ps_device *device, ps_error *error) {
    ps_text options = {0};
    ps_torus_options(&options, layout, dimension);
    pspec_status status = ps_text_check(&options, error);
    if (status == PSPEC_OK) {
        status =
            ps_kernel_create(device, &self->kernel,
                             layout->is_shared ? "torus/product_shared.cl" : "torus/product.cl",
                             layout->is_shared ? "torus_product_shared" : "torus_product",
                             ps_text_string(&options), error);
    }
    ps_text_free(&options);
    return status;
}

pspec_status ps_torus_product_create(ps_torus_product *out, const ps_torus_layout *layout,
                                     const ps_split *split, ps_device *device, ps_error *error) {
    const size_t lanes = layout->lanes;
    *out = (ps_torus_product){.local_bytes = ps_torus_shared_bytes(layout),
                              .pair_numbers = (double)(lanes * lanes),
                              .row_bytes = (double)(2 * lanes * layout->real_bytes)};
    PS_TRY(create_kernel(out, layout, split->dimension, device, error));
    if (layout->is_shared) {
        PS_TRY(upload_blocks(out, layout, split, device, error));
    } else {
        PS_TRY(upload(device, &out->pairs, split->pairs, split->num_pairs * sizeof *split->pairs,
                      error));
    }
    return ps_buffer_create(device, &out->sums,
                            layout->group * split->num_pairs * lanes * 8 * lanes *
                                layout->real_bytes,
                            "sums of products", error);
}

void ps_torus_product_free(ps_torus_product *product) {
    if (product->kernel != NULL) {
        clReleaseKernel(product->kernel);
    }
    ps_buffer_release(&product->pairs);
    ps_buffer_release(&product->blocks);
    ps_buffer_release(&product->sums);
    *product = (ps_torus_product){0};
}

/* ---- add --------------------------------------------------------------------------------- */

pspec_status ps_torus_product_add(ps_torus_product *self, const product_numbers *numbers,
                                  const ps_torus_factors *factors, const ps_buffer *power,
                                  ps_device *device, ps_error *error) {
    const double num_points = (double)factors->num_points;
    const double flops = 8 * num_points * (double)numbers->num_pairs * self->pair_numbers;
    const double bytes = num_points * (double)numbers->num_tiles * self->row_bytes;
    if (self->num_blocks == 0) {
        const ps_range range =
            ps_range_heavy(device, numbers->num_pairs, factors->num_patterns, 1, flops, bytes);
        return PS_LAUNCH(device, self->kernel, &range, error, PS_STRUCT(*numbers),
                         PS_BUFFER(*factors->table), PS_BUFFER(*factors->offsets),
                         PS_BUFFER(self->pairs), PS_BUFFER(self->sums), PS_BUFFER(*factors->scales),
                         PS_BUFFER(*power));
    }
    const ps_range range = ps_range_shared(device, SHARING_ITEMS, self->num_blocks,
                                           factors->num_patterns, flops, bytes);
    return PS_LAUNCH(device, self->kernel, &range, error, PS_STRUCT(*numbers),
                     PS_BUFFER(*factors->table), PS_BUFFER(*factors->offsets),
                     PS_BUFFER(self->blocks), PS_BUFFER(self->pairs), PS_BUFFER(self->sums),
                     PS_BUFFER(*factors->scales), PS_BUFFER(*power), PS_LOCAL(self->local_bytes));
}
