#include "engines/torus_side.h"

#include "base/memory.h"

#include <stdlib.h>

void ps_torus_options(ps_text *text, const ps_torus_layout *layout, unsigned dimension) {
    ps_text_append(text, "-DPRECISION=%zu -DLANES=%u -DDIMENSION=%u -DRUN=%d",
                   layout->real_bytes * 8, layout->lanes, dimension, PS_TORUS_RUN);
}

/* Frequencies as the kernels want them: [dimension][tiles * lanes] words, padded with zeros. */
static pspec_status upload_frequencies(ps_torus_side *side, const int32_t *vectors,
                                       ps_device *device, ps_error *error) {
    const size_t row = side->num_tiles * side->lanes;
    void *words = NULL;
    PS_TRY(ps_allocate(&words, row * side->dimension, side->real_bytes, "frequencies", error));
    for (size_t i = 0; i < side->num; i++) {
        for (unsigned axis = 0; axis < side->dimension; axis++) {
            const int32_t k = vectors[i * side->dimension + axis];
            if (side->real_bytes == sizeof(float)) {
                ((int32_t *)words)[axis * row + i] = k;
            } else {
                ((int64_t *)words)[axis * row + i] = k;
            }
        }
    }
    const pspec_status status =
        ps_buffer_write(device, &side->frequencies, 0, words,
                        row * side->dimension * side->real_bytes, error);
    free(words);
    return status;
}

static pspec_status create_kernels(ps_torus_side *side, const ps_torus_layout *layout,
                                   bool weighted, ps_device *device, ps_error *error) {
    ps_text common = {0};
    ps_text list = {0};
    pspec_status status = PSPEC_OK;
    ps_torus_options(&common, layout, side->dimension);
    ps_text_append(&list, "%s -DSTORE_TABLE=%d -DWEIGHT_TABLE=%d", ps_text_string(&common),
                   side->has_table, weighted);
    const char *options = ps_text_string(&common);
    PS_TRY_OUT(status, ps_kernel_create(device, &side->list, "torus/list.cl", "torus_list",
                                        ps_text_string(&list), error));
    PS_TRY_OUT(status, ps_kernel_create(device, &side->fold, "torus/fold.cl", "torus_fold",
                                        options, error));
    PS_TRY_OUT(status, ps_kernel_create(device, &side->power, "torus/power.cl", "torus_power_list",
                                        options, error));
out:
    ps_text_free(&common);
    ps_text_free(&list);
    return status;
}

static pspec_status create_buffers(ps_torus_side *side, size_t batch, ps_device *device,
                                   ps_error *error) {
    const size_t tile_bytes = side->lanes * side->real_bytes;
    const size_t tiles = side->num_tiles;
    PS_TRY(ps_buffer_create(device, &side->frequencies, tiles * side->dimension * tile_bytes,
                            "frequencies", error));
    PS_TRY(ps_buffer_create(device, &side->sums, batch * side->num_chunks * tiles * 4 * tile_bytes,
                            "partial sums", error));
    PS_TRY(ps_buffer_create(device, &side->totals, batch * tiles * 4 * tile_bytes, "sums", error));
    if (!side->has_table) {
        return PSPEC_OK;
    }
    return ps_buffer_create(device, &side->table,
                            batch * tiles * side->table_points * 2 * tile_bytes,
                            "tables of cosines and sines", error);
}

pspec_status ps_torus_side_create(ps_torus_side *out, const ps_torus_layout *layout,
                                  unsigned dimension, size_t num, const int32_t *vectors,
                                  size_t batch, bool with_table, bool weighted, ps_device *device,
                                  ps_error *error) {
    *out = (ps_torus_side){.num = num,
                           .num_tiles = (num + layout->lanes - 1) / layout->lanes,
                           .num_chunks = layout->num_chunks,
                           .table_points = layout->slab,
                           .dimension = dimension,
                           .lanes = layout->lanes,
                           .real_bytes = layout->real_bytes,
                           .has_table = with_table};
    PS_TRY(create_kernels(out, layout, weighted, device, error));
    PS_TRY(create_buffers(out, batch, device, error));
    return upload_frequencies(out, vectors, device, error);
}

void ps_torus_side_free(ps_torus_side *side) {
    cl_kernel *const kernels[] = {&side->list, &side->fold, &side->power};
    for (size_t i = 0; i < sizeof kernels / sizeof kernels[0]; i++) {
        if (*kernels[i] != NULL) {
            clReleaseKernel(*kernels[i]);
        }
    }
    ps_buffer_release(&side->frequencies);
    ps_buffer_release(&side->sums);
    ps_buffer_release(&side->totals);
    ps_buffer_release(&side->table);
    *side = (ps_torus_side){0};
}

/* Arithmetic of one (point, frequency) pair in torus_list, counted from its source: phase 3 d,
 * reduction 5, polynomials 22 (float) or 34 (double), sums 4. */
static double phase_flops(const ps_torus_side *side) {
    return 3.0 * side->dimension + 9 + (side->real_bytes == sizeof(float) ? 22 : 34);
}

pspec_status ps_torus_side_add(ps_torus_side *side, const ps_torus_points *points,
                               size_t num_patterns, size_t num_points, bool is_first,
                               ps_device *device, ps_error *error) {
    const double pairs = (double)num_points * (double)side->num;
    const double real_bytes = (double)side->real_bytes;
    const ps_range range = ps_range_heavy(
        device, side->num_tiles, side->num_chunks, num_patterns, pairs * phase_flops(side),
        (double)num_points * (8.0 * side->dimension + real_bytes) +
            (side->has_table ? 2 * pairs * real_bytes : 0));
    if (side->has_table) {
        PS_TRY(PS_LAUNCH(device, side->list, &range, error, PS_BUFFER(points->points),
                         PS_BUFFER(points->weights), PS_BUFFER(points->offsets),
                         PS_BUFFER(side->frequencies), PS_BUFFER(side->sums),
                         PS_U64(side->num_tiles), PS_U64(PS_TORUS_CHUNK), PS_BUFFER(side->table),
                         PS_U64(side->table_points)));
    } else {
        PS_TRY(PS_LAUNCH(device, side->list, &range, error, PS_BUFFER(points->points),
                         PS_BUFFER(points->weights), PS_BUFFER(points->offsets),
                         PS_BUFFER(side->frequencies), PS_BUFFER(side->sums),
                         PS_U64(side->num_tiles), PS_U64(PS_TORUS_CHUNK)));
    }
    const double sums = (double)(num_patterns * side->num_chunks * side->num_tiles * side->lanes);
    const ps_range fold = ps_range_light(device, side->num_tiles, num_patterns, 1, 14 * sums,
                                         4 * sums * real_bytes);
    return PS_LAUNCH(device, side->fold, &fold, error, PS_BUFFER(side->sums),
                     PS_BUFFER(side->totals), PS_U64(side->num_tiles), PS_U32(side->num_chunks),
                     PS_U32(is_first));
}

pspec_status ps_torus_side_power(ps_torus_side *side, const ps_buffer *scales,
                                 const ps_buffer *power, size_t first_slot, size_t stride,
                                 size_t num_patterns, ps_device *device, ps_error *error) {
    const double num = (double)(side->num * num_patterns);
    const ps_range range = ps_range_light(device, side->num_tiles, num_patterns, 1, 6 * num,
                                          5 * num * (double)side->real_bytes);
    return PS_LAUNCH(device, side->power, &range, error, PS_BUFFER(side->totals),
                     PS_BUFFER(*scales), PS_BUFFER(*power), PS_U64(side->num_tiles),
                     PS_U64(first_slot), PS_U64(stride));
}
