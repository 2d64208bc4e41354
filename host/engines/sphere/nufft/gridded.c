/* Rings on GPUs: points are spread on the grid of torus_nufft, all longitudes times whole great
 * circles through the poles, whose transform gives sums S(m, k); transforms along k make values on
 * rings (kernels/sphere/nufft/ring_lines.cl), and these coefficients (degrees.c). */
#include "engines/sphere/nufft/variants.h"

#include "base/memory.h"
#include "base/round.h"
#include "device/reals.h"
#include "engines/torus/nufft/variant.h"
#include "sphere/nufft/numbers.h"

#include <stdlib.h>

typedef struct gridded {
    ps_nufft_state plane; /* of the grid; its plans are those of the engine */
    ps_kernel *lines;
    ps_range range; /* of lines of no set yet; items of its work-groups are compiled in */
    ps_buffer roots, turns;
    ps_sphere_starts starts;
    ps_sphere_degrees degrees;
} gridded;

static gridded *of(const ps_sphere_state *self) {
    return self->own;
}

/* ---- create ------------------------------------------------------------------------------ */

/* The plans of both axes are the engine's. */
static pspec_status create_plane(ps_sphere_state *self, ps_error *error) {
    ps_nufft_state *plane = &of(self)->plane;
    plane->device = self->device;
    plane->precision = self->precision;
    plane->layout = self->shape.plane;
    plane->launcher = plane->layout.choice.variant->launcher;
    plane->plans[0] = plane->plans[1] = self->tables.plan;
    PS_TRY(ps_buffer_create(self->device, &plane->means,
                            plane->layout.parts * plane->layout.real_bytes, "means", error));
    PS_TRY(ps_buffer_clear(self->device, &plane->means, error));
    PS_TRY(ps_nufft_places_create_order(&plane->places, &plane->layout, 2, self->precision,
                                        self->device, error));
    PS_TRY(ps_allocate(&plane->own, 1, plane->launcher->own_bytes, "an engine", error));
    return plane->launcher->create(plane, error);
}

static pspec_status create_lines(ps_sphere_state *self, ps_error *error) {
    const ps_sphere_shape *shape = &self->shape;
    const ps_nufft_pass *pass = &shape->ring_pass;
    gridded *own = of(self);
    ps_defines defines = ps_defines_of(ps_real_bytes(self->precision), 0);
    own->range = ps_range_shared(self->device, pass->items, 0, 0, 0, 0);
    ps_nufft_line_defines(&defines, pass, own->range.local[0]);
    PS_TRY(ps_kernel_get(self->device, &own->lines, "sphere/nufft/ring_lines.cl",
                         "sphere_ring_lines", defines.text, error));
    PS_TRY(ps_fft_roots_create(&own->roots, pass->length, self->precision, self->device, error));
    return ps_sphere_turns_create(&own->turns, shape->rings, shape->num_rings, self->precision,
                                  self->device, error);
}

static pspec_status create(ps_sphere_state *self, ps_error *error) {
    PS_TRY(create_plane(self, error));
    PS_TRY(create_lines(self, error));
    PS_TRY(ps_sphere_starts_create(&of(self)->starts, &self->shape, self->device, error));
    return ps_sphere_degrees_create(&of(self)->degrees, self, error);
}

static void free_own(void *own) {
    gridded *const self = own;
    if (self->plane.own != NULL) {
        self->plane.launcher->free(self->plane.own);
    }
    free(self->plane.own);
    ps_nufft_places_free(&self->plane.places);
    PS_BUFFERS_RELEASE(&self->plane.means, &self->roots, &self->turns);
    ps_sphere_starts_free(&self->starts);
    ps_sphere_degrees_free(&self->degrees);
}

/* ---- run --------------------------------------------------------------------------------- */

/* Brings points of some patterns, or a part of one, into the order of boxes. */
static pspec_status order_points(ps_sphere_state *self, const ps_batch *some, ps_error *error) {
    const ps_sphere_places *points = &self->points;
    PS_TRY(ps_batch_go_on(some, error));
    PS_TRY(ps_sphere_places_make(&self->points, some, error));
    const ps_nufft_source source = {.points = &points->turns,
                                    .weights = &points->weights,
                                    .offsets = &points->offsets,
                                    .num_points = points->num_points,
                                    .has_weights = !points->has_unit_weights};
    return ps_nufft_places_order(&of(self)->plane.places, &source, some, error);
}

/* Points of the only pattern, a chunk at a time. */
static pspec_status spread_chunks(ps_sphere_state *self, const ps_batch *one, ps_error *error) {
    ps_nufft_state *plane = &of(self)->plane;
    const size_t most = plane->layout.part_points;
    PS_TRY(plane->launcher->begin(plane, error));
    for (size_t at = 0; at < one->patterns[0].num_points; at += most) {
        pspec_pattern part;
        const ps_batch some = ps_batch_chunk(one, at, most, &part);
        PS_TRY(order_points(self, &some, error));
        PS_TRY(plane->launcher->spread(plane, 1, error));
    }
    return PSPEC_OK;
}

static pspec_status make_rings(ps_sphere_state *self, size_t first_value, size_t num,
                               ps_error *error) {
    const ps_sphere_shape *shape = &self->shape;
    const ps_nufft_pass *pass = &shape->ring_pass;
    const gridded *own = of(self);
    const size_t lines = ((size_t)shape->max_degree + 1) * (self->only_even ? 1 : 2);
    const ring_lines_numbers numbers = {.order_apart = ps_sphere_order_apart(shape),
                                        .L = (uint32_t)shape->max_degree,
                                        .only_even = self->only_even,
                                        .num_lines = (uint32_t)lines,
                                        .num_rings = shape->num_rings,
                                        .ring_pitch = shape->ring_pitch,
                                        .first_value = (uint32_t)first_value};
    ps_range range = own->range;
    range.global[1] = ps_divide_up(lines, pass->lines_at_once);
    range.global[2] = num;
    range.flops = (double)num * (double)lines * ps_fft_flops(pass->length);
    return PS_LAUNCH(self->device, own->lines, &range, error, PS_STRUCT(numbers),
                     PS_BUFFER(*ps_nufft_grid_sums(&own->plane)), PS_BUFFER(own->roots),
                     PS_BUFFER(own->turns), PS_BUFFER(self->values),
                     PS_LOCAL(pass->lines_at_once * ps_nufft_line_reals(pass->length) *
                              ps_real_bytes(self->precision)));
}

static pspec_status make_values(ps_sphere_state *self, size_t first_value, const ps_batch *some,
                                ps_error *error) {
    ps_nufft_state *plane = &of(self)->plane;
    const ps_nufft_target nowhere = {&plane->means, &plane->means, 0}; /* no powers are made */
    PS_TRY(plane->launcher->spread != NULL ? spread_chunks(self, some, error)
                                           : order_points(self, some, error));
    PS_TRY(plane->launcher->run(plane, some->num_patterns, &nowhere, error));
    return make_rings(self, first_value, some->num_patterns, error);
}

static pspec_status launch_sums(ps_sphere_state *self, ps_kernel *kernel, const ps_buffer *to,
                                size_t num, ps_error *error) {
    return ps_sphere_degrees_sum(self, &of(self)->degrees, &of(self)->starts, kernel, to, num,
                                 error);
}

/* ---- the row ----------------------------------------------------------------------------- */

static void describe(const ps_sphere_state *self, ps_text *text) {
    const ps_sphere_shape *shape = &self->shape;
    ps_text_append(text, "rings=%lu at_once=%zu", (unsigned long)shape->num_rings, shape->at_once);
    shape->plane.choice.variant->describe(&shape->plane, text);
}

/* Programs: its own of turns and powers; keys and their order, boxes, two axes, rings,
 * coefficients. */
const ps_sphere_variant ps_sphere_gridded = {.programs = 8,
                                             .program = "sphere/nufft/degree_powers.cl",
                                             .own_bytes = sizeof(gridded),
                                             .create = create,
                                             .free = free_own,
                                             .make_values = make_values,
                                             .sums = "sphere_degree_powers",
                                             .launch_sums = launch_sums,
                                             .describe = describe};
