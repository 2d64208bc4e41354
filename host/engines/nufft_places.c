#include "engines/nufft_places.h"

#include "base/memory.h"

#include <stdio.h>
#include <stdlib.h>

/* kernels/nufft/place.h */
enum { PLACE_UNIT = 16 };

/* Rows longer than this are filled in the order of cells, or they would be fetched from memory point by
 * point: two of them fit into the smallest first-level cache that counts. */
enum { SORTED_ROW_BYTES = 16384 };

static bool sorts_along_rows(const ps_nufft_layout *layout) {
    return layout->choice.num_axes == PS_NUFFT_MAX_AXES &&
           layout->row_local_bytes > SORTED_ROW_BYTES;
}

static pspec_status create_kernels(ps_nufft_places *self, ps_precision precision, ps_error *error) {
    char options[64];
    snprintf(options, sizeof options, "-DPRECISION=%u -DLANES=%u",
             precision == PS_SINGLE ? 32u : 64u, self->layout->lanes);
    PS_TRY(ps_kernel_create(self->device, &self->sort, "nufft/sort.cl", "nufft_sort", "", error));
    PS_TRY(ps_kernel_create(self->device, &self->place, "nufft/place.cl", "nufft_place", options,
                            error));
    return self->layout->choice.num_axes == 1
               ? PSPEC_OK
               : ps_kernel_create(self->device, &self->window, "nufft/place.cl", "nufft_window",
                                  options, error);
}

static uint32_t most_cells(const ps_nufft_layout *layout) {
    const ps_nufft_axis *axes = layout->choice.axes;
    const bool needs_second = sorts_along_rows(layout) && axes[1].n > axes[0].n;
    return needs_second ? axes[1].n : axes[0].n;
}

static pspec_status create_buffers(ps_nufft_places *self, ps_error *error) {
    const ps_nufft_layout *layout = self->layout;
    const size_t num = layout->parts * layout->part_places + PLACE_UNIT;
    const size_t starts = layout->parts * ((size_t)most_cells(layout) + 2);
    const struct {
        ps_buffer *buffer;
        size_t bytes;
        const char *what;
    } all[] = {
        {&self->places, (layout->parts + 1) * sizeof(uint64_t), "places"},
        {&self->order, num * sizeof(uint32_t), "order of points"},
        {&self->previous, (sorts_along_rows(layout) ? num : 1) * sizeof(uint32_t),
         "order of points"},
        {&self->starts, starts * sizeof(uint32_t), "starts of cells"},
        {&self->along, num * sizeof(uint64_t), "coordinates"},
        {&self->phases, num * 2 * layout->lanes * layout->real_bytes, "phases"},
    };
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        PS_TRY(ps_buffer_create(self->device, all[i].buffer, all[i].bytes, all[i].what, error));
    }
    for (unsigned i = 0; i < layout->choice.num_axes; i++) {
        PS_TRY(ps_buffer_create(self->device, &self->cells[i], num * sizeof(uint32_t),
                                "cells of points", error));
        PS_TRY(ps_buffer_create(self->device, &self->windows[i],
                                num * self->plans[i].pitch * layout->real_bytes,
                                "windows of points", error));
    }
    return PSPEC_OK;
}

pspec_status ps_nufft_places_create(ps_nufft_places *out, const ps_nufft_layout *layout,
                                    const ps_nufft_plan *plans, unsigned dimension,
                                    ps_precision precision, ps_device *device, ps_error *error) {
    void *memory = NULL;
    *out = (ps_nufft_places){
        .layout = layout, .plans = plans, .device = device, .dimension = dimension};
    PS_TRY(ps_allocate(&memory, layout->parts + 1, sizeof(uint64_t), "places", error));
    out->host_places = memory;
    PS_TRY(create_kernels(out, precision, error));
    PS_TRY(ps_torus_points_create(&out->points, dimension, layout->parts, layout->part_points,
                                  precision, false, device, error));
    return create_buffers(out, error);
}

void ps_nufft_places_free(ps_nufft_places *places) {
    const cl_kernel kernels[] = {places->sort, places->place, places->window};
    ps_buffer *const buffers[] = {&places->places, &places->order, &places->previous,
                                  &places->starts, &places->along, &places->phases};
    for (size_t i = 0; i < sizeof kernels / sizeof kernels[0]; i++) {
        if (kernels[i] != NULL) {
            clReleaseKernel(kernels[i]);
        }
    }
    for (size_t i = 0; i < sizeof buffers / sizeof buffers[0]; i++) {
        ps_buffer_release(buffers[i]);
    }
    for (unsigned i = 0; i < PS_NUFFT_MAX_AXES; i++) {
        ps_buffer_release(&places->cells[i]);
        ps_buffer_release(&places->windows[i]);
    }
    ps_torus_points_free(&places->points);
    free(places->host_places);
    *places = (ps_nufft_places){0};
}

/* ---- make -------------------------------------------------------------------------------- */

static pspec_status upload_places(ps_nufft_places *self, const ps_batch *parts, ps_error *error) {
    self->host_places[0] = 0;
    for (size_t r = 0; r < parts->num_patterns; r++) {
        const size_t num = parts->patterns[r].num_points;
        self->host_places[r + 1] =
            self->host_places[r] + (num + PLACE_UNIT - 1) / PLACE_UNIT * PLACE_UNIT;
    }
    return ps_buffer_write(self->device, &self->places, 0, self->host_places,
                           (parts->num_patterns + 1) * sizeof(uint64_t), error);
}

static pspec_status sort_by(ps_nufft_places *self, unsigned which, bool has_previous,
                            const ps_buffer *order, size_t num_parts, double num_points,
                            ps_error *error) {
    const ps_nufft_axis *axis = &self->plans[which].axis;
    const double flops_per_point = 1000; /* work-groups of one work-item on CPUs */
    const ps_range range =
        ps_range_heavy(self->device, num_parts, 1, 1, num_points * flops_per_point, 0);
    return PS_LAUNCH(self->device, self->sort, &range, error, PS_BUFFER(self->points.points),
                     PS_BUFFER(self->points.offsets), PS_BUFFER(self->places),
                     PS_BUFFER(self->previous), PS_U32(has_previous), PS_BUFFER(*order),
                     PS_BUFFER(self->starts), PS_U64(num_parts), PS_U32(self->dimension),
                     PS_U32(axis->n), PS_U32(axis->window.width), PS_U32(axis->axis),
                     PS_U64(axis->factor));
}

static pspec_status sort_points(ps_nufft_places *self, size_t num_parts, double num_points,
                                ps_error *error) {
    const bool twice = sorts_along_rows(self->layout);
    if (twice) {
        PS_TRY(sort_by(self, 1, false, &self->previous, num_parts, num_points, error));
    }
    return sort_by(self, 0, twice, &self->order, num_parts, num_points, error);
}

static pspec_status make_windows(ps_nufft_places *self, const ps_range *range, ps_error *error) {
    const ps_nufft_plan *first = &self->plans[0];
    const ps_nufft_plan *second = &self->plans[1];
    PS_TRY(PS_LAUNCH(self->device, self->place, range, error, PS_BUFFER(self->points.points),
                     PS_BUFFER(self->points.weights), PS_BUFFER(self->points.offsets),
                     PS_BUFFER(self->places), PS_BUFFER(self->order),
                     PS_BUFFER(first->coefficients), PS_U32(self->dimension), PS_U32(first->axis.n),
                     PS_U32(first->axis.window.width), PS_U32(first->axis.axis),
                     PS_U64(first->axis.factor), PS_U32(first->degree), PS_U32(first->bins),
                     PS_U32(first->pitch), PS_BUFFER(self->cells[0]), PS_BUFFER(self->windows[0]),
                     PS_BUFFER(self->along), PS_BUFFER(self->phases)));
    if (self->layout->choice.num_axes == 1) {
        return PSPEC_OK;
    }
    return PS_LAUNCH(self->device, self->window, range, error, PS_BUFFER(self->points.points),
                     PS_BUFFER(self->points.offsets), PS_BUFFER(self->places),
                     PS_BUFFER(self->order), PS_BUFFER(second->coefficients),
                     PS_U32(self->dimension), PS_U32(second->axis.n),
                     PS_U32(second->axis.window.width), PS_U32(second->axis.axis),
                     PS_U64(second->axis.factor), PS_U32(second->degree), PS_U32(second->bins),
                     PS_U32(second->pitch), PS_BUFFER(self->cells[1]), PS_BUFFER(self->windows[1]));
}

pspec_status ps_nufft_places_make(ps_nufft_places *places, const ps_batch *parts, ps_error *error) {
    const size_t num_parts = parts->num_patterns;
    size_t num_points = 0;
    uint64_t longest = 0;
    PS_TRY(ps_torus_points_upload(&places->points, places->device, parts, 0, &num_points, error));
    PS_TRY(upload_places(places, parts, error));
    for (size_t r = 0; r < num_parts; r++) {
        const uint64_t num = places->host_places[r + 1] - places->host_places[r];
        longest = num > longest ? num : longest;
    }
    const double flops_per_point = 300;
    const ps_range range = ps_range_heavy(places->device, (size_t)longest, num_parts, 1,
                                          (double)num_points * flops_per_point, 0);
    PS_TRY(sort_points(places, num_parts, (double)num_points, error));
    return make_windows(places, &range, error);
}
