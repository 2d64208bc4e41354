#include "engines/torus/nufft/variant.h"

#include "base/memory.h"
#include "base/round.h"
#include "nufft/numbers.h"

#include <stdlib.h>

static pspec_status create_buffers(ps_nufft_places *self, ps_error *error) {
    const ps_nufft_layout *layout = self->layout;
    const size_t num = layout->parts * layout->part_places;
    const size_t starts = layout->parts * ((size_t)layout->num_keys + 2);
    const ps_wanted_buffer wanted[] = {
        {&self->places, (layout->parts + 1) * sizeof(uint64_t), "places"},
        {&self->sorted, num * self->dimension * sizeof(uint64_t), "sorted points"},
        {&self->heights, num * layout->real_bytes, "sorted weights"},
        {&self->starts, starts * sizeof(uint32_t), "starts of cells"}};
    return PS_BUFFERS_CREATE(self->device, wanted, error);
}

ps_defines ps_nufft_defines(const ps_nufft_layout *layout, unsigned dimension) {
    ps_defines defines = ps_defines_of(layout->real_bytes, layout->lanes);
    ps_defines_add(&defines, "-DDIMENSION=%u -DBOXES=%u -DLINE=%u", dimension, layout->has_boxes,
                   layout->choice.has_line);
    return defines;
}

static pspec_status create_sort(ps_nufft_places *self, ps_precision precision, ps_error *error) {
    const ps_nufft_layout *const layout = self->layout;
    const bool has_order = layout->order.tile > 0;
    const char *const program = layout->choice.variant->program[layout->choice.num_axes > 1];
    const ps_defines defines = ps_nufft_defines(layout, self->dimension);
    PS_TRY(ps_kernel_get(self->device, &self->sort, program != NULL ? program : "nufft/sort.cl",
                         has_order ? "nufft_keys" : "nufft_sort", defines.text, error));
    return has_order ? ps_nufft_order_create(&self->order, &layout->order, layout->parts,
                                             self->dimension, precision, self->device, error)
                     : PSPEC_OK;
}

pspec_status ps_nufft_places_create_order(ps_nufft_places *out, const ps_nufft_layout *layout,
                                          unsigned dimension, ps_precision precision,
                                          ps_device *device, ps_error *error) {
    *out = (ps_nufft_places){.layout = layout, .device = device, .dimension = dimension};
    PS_TRY(PS_NEW(&out->host_places, layout->parts + 1, "places", error));
    PS_TRY(create_sort(out, precision, error));
    return create_buffers(out, error);
}

pspec_status ps_nufft_places_create(ps_nufft_places *out, const ps_nufft_layout *layout,
                                    unsigned dimension, ps_precision precision, ps_device *device,
                                    ps_error *error) {
    PS_TRY(ps_nufft_places_create_order(out, layout, dimension, precision, device, error));
    return ps_torus_points_create(&out->points, dimension, layout->parts, layout->part_points,
                                  precision, false, device, error);
}

void ps_nufft_places_free(ps_nufft_places *places) {
    ps_nufft_order_free(&places->order);
    PS_BUFFERS_RELEASE(&places->places, &places->sorted, &places->heights, &places->starts);
    ps_torus_points_free(&places->points);
    free(places->host_places);
    *places = (ps_nufft_places){0};
}

static pspec_status upload_places(ps_nufft_places *self, const ps_batch *parts, ps_error *error) {
    self->host_places[0] = 0;
    for (size_t r = 0; r < parts->num_patterns; r++) {
        const size_t num = parts->patterns[r].num_points;
        self->host_places[r + 1] = self->host_places[r] + ps_round_up(num, PS_NUFFT_PLACE_UNIT);
    }
    return ps_buffer_write(self->device, &self->places, 0, self->host_places,
                           (parts->num_patterns + 1) * sizeof(uint64_t), error);
}

pspec_status ps_nufft_places_upload(ps_nufft_places *places, const ps_batch *parts,
                                    ps_error *error) {
    PS_TRY(ps_torus_points_upload(&places->points, places->device, parts, 0, &places->num_points,
                                  error));
    return upload_places(places, parts, error);
}

/* The cells that tiles want points by, those of axis 1 for strips, or boxes. */
static void set_keys(const ps_nufft_layout *layout, sort_numbers *numbers) {
    const ps_nufft_choice *choice = &layout->choice;
    const bool are_boxes = layout->has_boxes;
    const ps_nufft_axis *axes = choice->axes + layout->first_key;
    const bool have_second = are_boxes || layout->num_keys > axes[0].n;
    const unsigned num = are_boxes ? choice->num_axes : have_second ? 2 : 1;
    const unsigned first = PS_NUFFT_MAX_AXES - choice->num_axes; /* of boxes */
    numbers->factor = axes[0].factor;
    numbers->num_keys = layout->num_keys;
    for (unsigned i = 0; i < PS_NUFFT_MAX_AXES; i++) {
        numbers->axes[i] =
            i >= num ? (sort_axis){.n = 1, .keys = 1}
                     : (sort_axis){.n = axes[i].n,
                                   .width = axes[i].window.width,
                                   .axis = axes[i].axis,
                                   .keys = are_boxes ? layout->boxes.num[i + first] : axes[i].n,
                                   .per_cell = are_boxes ? layout->boxes.per_cell[i + first] : 0};
    }
}

/* On GPUs. */
static pspec_status order_points(ps_nufft_places *self, const sort_numbers *numbers,
                                 const ps_nufft_source *source, ps_error *error) {
    const size_t num = source->num_points;
    const ps_nufft_order_points points = {.points = source->points,
                                          .weights = source->weights,
                                          .offsets = source->offsets,
                                          .places = &self->places,
                                          .sorted = &self->sorted,
                                          .heights = &self->heights,
                                          .starts = &self->starts,
                                          .has_weights = source->has_weights};
    const size_t bytes = num * (self->dimension * sizeof(uint64_t) + sizeof(uint32_t));
    const ps_range range = ps_range_light(self->device, ps_divide_up(num, self->layout->lanes), 1,
                                          1, 0, (double)bytes);
    PS_TRY(PS_LAUNCH(self->device, self->sort, &range, error, PS_STRUCT(*numbers), PS_U64(num),
                     PS_BUFFER(*source->points), PS_BUFFER(self->order.keys)));
    return ps_nufft_order_run(&self->order, &points, numbers->num_realizations, error);
}

static pspec_status sort_source(ps_nufft_places *self, const ps_nufft_source *source,
                                size_t num_parts, ps_error *error) {
    const double flops_per_point = 1000; /* work-groups of one work-item on CPUs */
    const ps_range range = ps_range_heavy(self->device, num_parts, 1, 1,
                                          (double)source->num_points * flops_per_point, 0);
    sort_numbers numbers = {.num_realizations = num_parts, .has_weights = source->has_weights};
    set_keys(self->layout, &numbers);
    if (self->layout->order.tile > 0) {
        return order_points(self, &numbers, source, error);
    }
    return PS_LAUNCH(self->device, self->sort, &range, error, PS_STRUCT(numbers),
                     PS_BUFFER(*source->points), PS_BUFFER(*source->weights),
                     PS_BUFFER(*source->offsets), PS_BUFFER(self->places), PS_BUFFER(self->sorted),
                     PS_BUFFER(self->heights), PS_BUFFER(self->starts));
}

pspec_status ps_nufft_places_sort(ps_nufft_places *places, size_t num_parts, ps_error *error) {
    const ps_nufft_source source = {.points = &places->points.points,
                                    .weights = &places->points.weights,
                                    .offsets = &places->points.offsets,
                                    .num_points = places->num_points,
                                    .has_weights = !places->points.has_unit_weights};
    return sort_source(places, &source, num_parts, error);
}

pspec_status ps_nufft_places_order(ps_nufft_places *places, const ps_nufft_source *source,
                                   const ps_batch *parts, ps_error *error) {
    places->num_points = source->num_points;
    PS_TRY(upload_places(places, parts, error));
    return sort_source(places, source, parts->num_patterns, error);
}
