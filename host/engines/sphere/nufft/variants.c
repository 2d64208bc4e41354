#include "engines/sphere/nufft/variants.h"

#include "device/reals.h"

/* ---- by rings, all points at once -------------------------------------------------------- */

static double no_table_flops(const ps_sphere_shape *shape) {
    (void)shape;
    return 0;
}

static pspec_status create_rings(ps_sphere_state *self, bool only_even, ps_error *error) {
    return ps_sphere_stages_create(&self->stages, &self->shape, &self->points, &self->tables,
                                   only_even, self->precision, self->device, error);
}

static pspec_status make_rings(ps_sphere_state *self, size_t first_value, const ps_batch *some,
                               ps_error *error) {
    PS_TRY(ps_sphere_places_make(&self->points, some, error));
    return ps_sphere_stages_make_values(&self->stages, first_value, some->num_patterns, error);
}

static pspec_status sum_rings(ps_sphere_state *self, size_t num, const ps_buffer **powers,
                              ps_error *error) {
    *powers = &self->stages.powers.sums;
    return ps_sphere_stages_sum(&self->stages, num, error);
}

static pspec_status keep_rings(ps_sphere_state *self, double *coefficients, ps_error *error) {
    return ps_sphere_stages_keep(&self->stages, coefficients, error);
}

static void describe_rings(const ps_sphere_state *self, ps_text *text) {
    const ps_sphere_shape *shape = &self->shape;
    ps_text_append(text, "rings=%lu at_once=%zu bands=%lu strip=%lu",
                   (unsigned long)shape->num_rings, shape->at_once, (unsigned long)shape->bands,
                   (unsigned long)shape->strip);
}

static void free_rings(ps_sphere_state *self) {
    ps_sphere_stages_free(&self->stages);
}

/* ---- by rings, sorted points ------------------------------------------------------------- */

/* Points of the only pattern, a chunk at a time. */
static pspec_status make_sorted(ps_sphere_state *self, size_t first_value, const ps_batch *one,
                                ps_error *error) {
    const size_t most = self->shape.most_points;
    const pspec_pattern *pattern = one->patterns;
    for (size_t at = 0; at < pattern->num_points; at += most) {
        pspec_pattern chunk = *pattern;
        chunk.points += at * PS_SPHERE_DIMENSION;
        chunk.weights = pattern->weights != NULL ? pattern->weights + at : NULL;
        chunk.num_points = pattern->num_points - at < most ? pattern->num_points - at : most;
        ps_batch some = *one;
        some.patterns = &chunk;
        PS_TRY(ps_batch_go_on(one, error));
        PS_TRY(ps_sphere_places_make(&self->points, &some, error));
        PS_TRY(ps_sphere_stages_add_sorted(&self->stages, at == 0, error));
    }
    return ps_sphere_stages_finish_sorted(&self->stages, first_value, error);
}

/* ---- by cells ---------------------------------------------------------------------------- */

static pspec_status create_cells(ps_sphere_state *self, bool only_even, ps_error *error) {
    return ps_sphere_grid_stages_create(&self->grid_stages, &self->shape, &self->points,
                                        &self->tables, only_even, self->precision, self->device,
                                        error);
}

static pspec_status make_cells(ps_sphere_state *self, size_t first_value, const ps_batch *some,
                               ps_error *error) {
    PS_TRY(ps_sphere_places_make(&self->points, some, error));
    return ps_sphere_grid_make_values(&self->grid_stages, first_value, some->num_patterns, error);
}

static pspec_status sum_cells(ps_sphere_state *self, size_t num, const ps_buffer **powers,
                              ps_error *error) {
    *powers = &self->grid_stages.powers.sums;
    return ps_sphere_grid_sum(&self->grid_stages, num, error);
}

static pspec_status keep_cells(ps_sphere_state *self, double *coefficients, ps_error *error) {
    return ps_sphere_grid_keep(&self->grid_stages, coefficients, error);
}

static void describe_cells(const ps_sphere_state *self, ps_text *text) {
    const ps_sphere_shape *shape = &self->shape;
    ps_text_append(text, "angles=%lu at_once=%zu table=%.3gMB", (unsigned long)shape->num_angles,
                   shape->at_once,
                   (double)(shape->table_reals * ps_real_bytes(self->precision)) * 1e-6);
}

static void free_cells(ps_sphere_state *self) {
    ps_sphere_grid_stages_free(&self->grid_stages);
}

/* ---- the table --------------------------------------------------------------------------- */

/* Kernels: points, values, sums of orders and degrees; the bands of sorted points; the table of
 * cells and where it begins. */
const ps_sphere_variant *ps_sphere_variant_of(const ps_sphere_shape *shape) {
    enum { RINGS, SORTED, CELLS };
    static const ps_sphere_variant variants[] = {
        [RINGS] = {4, no_table_flops, create_rings, make_rings, sum_rings, keep_rings,
                   describe_rings, free_rings},
        [SORTED] = {5, no_table_flops, create_rings, make_sorted, sum_rings, keep_rings,
                    describe_rings, free_rings},
        [CELLS] = {6, ps_sphere_grid_table_flops, create_cells, make_cells, sum_cells, keep_cells,
                   describe_cells, free_cells},
    };
    return &variants[shape->route == PS_SPHERE_BY_CELLS ? CELLS
                     : shape->is_sorted                 ? SORTED
                                                        : RINGS];
}
