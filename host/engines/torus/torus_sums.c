#include "engines/torus/torus_sums.h"

#include "base/memory.h"
#include "base/round.h"

#include <stdlib.h>

ps_defines ps_torus_defines(const ps_torus_layout *layout, unsigned dimension) {
    ps_defines defines = ps_defines_of(layout->real_bytes, layout->lanes);
    ps_defines_add(&defines, "-DDIMENSION=%u -DRUN=%d -DLIST_RUN=%d", dimension, PS_TORUS_RUN,
                   PS_TORUS_LIST_RUN);
    ps_defines_add(&defines, "-DSTORE_TABLE=%d -DLEFT_AXES=%u", layout->has_table,
                   layout->is_grid ? layout->left_axes : dimension);
    return defines;
}

/* Frequencies as the kernels want them: [dimension][tiles * lanes] words, padded with zeros. */
static pspec_status upload_frequencies(ps_torus_sums *self, const int32_t *vectors,
                                       ps_device *device, ps_error *error) {
    const size_t row = self->num_tiles * self->lanes;
    void *words = NULL;
    PS_TRY(ps_allocate(&words, row * self->dimension, self->real_bytes, "frequencies", error));
    for (size_t i = 0; i < self->num; i++) {
        for (unsigned axis = 0; axis < self->dimension; axis++) {
            const int32_t k = vectors[i * self->dimension + axis];
            if (self->real_bytes == sizeof(float)) {
                ((int32_t *)words)[axis * row + i] = k;
            } else {
                ((int64_t *)words)[axis * row + i] = k;
            }
        }
    }
    const pspec_status status = ps_buffer_write(device, &self->frequencies, 0, words,
                                                row * self->dimension * self->real_bytes, error);
    free(words);
    return status;
}

static pspec_status create_kernels(ps_torus_sums *self, const ps_torus_layout *layout,
                                   ps_device *device, ps_error *error) {
    const ps_defines defines = ps_torus_defines(layout, self->dimension);
    const char *const program = layout->has_table ? "torus/product.cl" : "torus/list.cl";
    PS_TRY(ps_kernel_get(device, &self->list, program, "torus_list", defines.text, error));
    PS_TRY(ps_kernel_get(device, &self->fold, program, "torus_fold", defines.text, error));
    return ps_kernel_get(device, &self->power, program, "torus_power_list", defines.text, error);
}

static pspec_status create_buffers(ps_torus_sums *self, size_t batch, size_t group,
                                   ps_device *device, ps_error *error) {
    const size_t tile_bytes = self->lanes * self->real_bytes;
    const size_t tiles = self->num_tiles;
    const ps_wanted_buffer wanted[] = {
        {&self->frequencies, tiles * self->dimension * tile_bytes, "frequencies"},
        {&self->sums, batch * self->num_chunks * tiles * 4 * tile_bytes, "partial sums"},
        {&self->totals, batch * tiles * 4 * tile_bytes, "sums"}};
    PS_TRY(PS_BUFFERS_CREATE(device, wanted, error));
    if (!self->has_table) {
        return PSPEC_OK;
    }
    return ps_buffer_create(device, &self->table,
                            group * tiles * self->table_points * 2 * tile_bytes,
                            "tables of cosines and sines", error);
}

pspec_status ps_torus_sums_create(ps_torus_sums *out, const ps_torus_layout *layout,
                                  unsigned dimension, size_t num, const int32_t *vectors,
                                  size_t batch, size_t group, size_t weighted_tiles,
                                  ps_device *device, ps_error *error) {
    *out = (ps_torus_sums){.num = num,
                           .num_tiles = ps_divide_up(num, layout->lanes),
                           .num_chunks = layout->num_chunks,
                           .table_points = layout->table_points,
                           .weighted_tiles = weighted_tiles,
                           .dimension = dimension,
                           .lanes = layout->lanes,
                           .real_bytes = layout->real_bytes,
                           .has_table = layout->has_table};
    PS_TRY(create_kernels(out, layout, device, error));
    PS_TRY(create_buffers(out, batch, group, device, error));
    return upload_frequencies(out, vectors, device, error);
}

void ps_torus_sums_free(ps_torus_sums *self) {
    PS_BUFFERS_RELEASE(&self->frequencies, &self->sums, &self->totals, &self->table);
    *self = (ps_torus_sums){0};
}

/* Of one (point, frequency) pair in torus_list, counted from its source: phase 3 d, reduction 5,
 * polynomials 22 (float) or 34 (double), sums 4. */
double ps_torus_phase_flops(unsigned dimension, size_t real_bytes) {
    return 3.0 * dimension + 9 + (real_bytes == sizeof(float) ? 22 : 34);
}

pspec_status ps_torus_sums_add(ps_torus_sums *self, const ps_torus_points *points, size_t first_row,
                               size_t num_patterns, size_t num_points, ps_device *device,
                               ps_error *error) {
    const double pairs = (double)num_points * (double)self->num;
    const double real_bytes = (double)self->real_bytes;
    /* Without a table a work-item takes two tiles (torus/list.cl). */
    const size_t num_items = self->has_table ? self->num_tiles : (self->num_tiles + 1) / 2;
    const ps_range range =
        ps_range_heavy(device, num_items, self->num_chunks, num_patterns,
                       pairs * ps_torus_phase_flops(self->dimension, self->real_bytes),
                       (double)num_points * (8.0 * self->dimension + real_bytes) +
                           (self->has_table ? 2 * pairs * real_bytes : 0));
    const ps_buffer *table = self->has_table ? &self->table : &self->sums;
    return PS_LAUNCH(device, self->list, &range, error, PS_BUFFER(points->points),
                     PS_BUFFER(points->weights), PS_BUFFER(points->offsets),
                     PS_BUFFER(self->frequencies), PS_BUFFER(self->sums), PS_U64(first_row),
                     PS_U64(self->num_tiles), PS_U64(PS_TORUS_CHUNK), PS_BUFFER(*table),
                     PS_U64(self->table_points), PS_U64(self->weighted_tiles));
}

pspec_status ps_torus_sums_fold(ps_torus_sums *self, size_t first_row, size_t num_rows,
                                bool is_first, ps_device *device, ps_error *error) {
    const double sums = (double)(num_rows * self->num_chunks * self->num_tiles * self->lanes);
    const ps_range range = ps_range_light(device, self->num_tiles, num_rows, 1, 14 * sums,
                                          4 * sums * (double)self->real_bytes);
    return PS_LAUNCH(device, self->fold, &range, error, PS_BUFFER(self->sums),
                     PS_BUFFER(self->totals), PS_U64(first_row), PS_U64(self->num_tiles),
                     PS_U32(self->num_chunks), PS_U32(is_first));
}

pspec_status ps_torus_sums_power(ps_torus_sums *self, const ps_buffer *scales,
                                 const ps_buffer *power, size_t first_slot, size_t stride,
                                 size_t num_rows, ps_device *device, ps_error *error) {
    const double num = (double)(self->num * num_rows);
    const ps_range range = ps_range_light(device, self->num_tiles, num_rows, 1, 6 * num,
                                          5 * num * (double)self->real_bytes);
    return PS_LAUNCH(device, self->power, &range, error, PS_BUFFER(self->totals),
                     PS_BUFFER(*scales), PS_BUFFER(*power), PS_U64(self->num_tiles),
                     PS_U64(first_slot), PS_U64(stride));
}
