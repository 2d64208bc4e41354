/* The engine: sums over a list of frequencies; for a grid, over the two factors of its split, whose
 * tables are then multiplied. */
#include "engines/engine.h"

#include "base/memory.h"
#include "base/round.h"
#include "device/reals.h"
#include "engines/torus/torus_coefficients.h"
#include "engines/torus/torus_layout.h"
#include "engines/torus/torus_points.h"
#include "engines/torus/torus_product.h"
#include "engines/torus/torus_split.h"
#include "engines/torus/torus_sums.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct torus_direct {
    ps_device *device;
    const ps_frequencies *frequencies;
    ps_precision precision;
    uint64_t num_points; /* of the largest realization */
    ps_torus_layout layout;
    size_t batch, stride;
    ps_split split; /* grids only */
    ps_torus_points points;
    ps_torus_sums sums;       /* of the list, or of the left and right factors of the grid */
    ps_torus_product product; /* grids only */
    bool keeps_sums;          /* of products to the end: coefficients are made of them */
    ps_buffer scales, power;
} torus_direct;

/* ---- what the planner asks --------------------------------------------------------------- */

static const char *refuse(const ps_torus_layout *layout, const ps_device_limits *limits) {
    if (layout->largest_buffer > limits->max_allocation_bytes ||
        layout->largest_buffer_per_realization > limits->max_allocation_bytes) {
        return "needs a larger buffer than the device allows";
    }
    return layout->max_stride > UINT32_MAX ? "too many frequencies for 32-bit slots" : NULL;
}

/* What the product of the tables of num_points points takes, in points of an endless pattern: each
 * begun run is added to the sums in memory, at the end powers are made of them. CPU time of 1 to
 * 128 points, K = 64 in the plane, AVX2, PoCL 3.1, 2026-11. */
static double product_points(double num_points) {
    const double points_per_run = 22;
    const double points_per_pattern = 10;
    const double runs = ceil(num_points / PS_TORUS_RUN);
    return (num_points + runs * points_per_run + points_per_pattern) /
           (1 + points_per_run / PS_TORUS_RUN);
}

/* Of products by matrix units, in that of fused operations: 1.95 to 2.95 us for (2, 1024, 128),
 * prototypes on an H200, 2026-11-28. In double precision nobody measured both. */
static const double time_by_units[2] = {0.66, 1};

/* Additions and multiplications of kernels/torus/product_shared.cl for many realizations with
 * num_points points each, when `share` of the pairs of tiles is needed. Blocks do all of their
 * pairs, and those on the edge of a ball are done, too; a phase in a block takes as
 * long as 24 fused operations of a product. Two work-groups on each of 132 units keep an H200 busy;
 * fewer take as long as these. */
static double shared_flops(const ps_torus_layout *layout, double num_points, double realizations,
                           double share) {
    const double phase_flops = 48;
    const double busy_groups = 2 * 132;
    const double side = layout->block_tiles * (double)layout->lanes;
    const double all = (double)layout->max_blocks;
    const double blocks = fmin(all, share * all + sqrt(all));
    const double groups = fmax(1, blocks * (double)layout->group);
    return realizations * num_points * blocks * (8 * side * side + phase_flops * 2 * side) *
           fmax(1, busy_groups / groups);
}

static ps_work work_of(const ps_torus_layout *layout, const ps_problem *problem,
                       ps_precision precision) {
    const double realizations =
        problem->num_realizations > 0 ? (double)problem->num_realizations : 1;
    const double num_points = (double)problem->num_points * realizations;
    const double lanes = layout->lanes;
    const double box = lanes * lanes * (double)layout->left_tiles *
                       (double)layout->right_tiles; /* padding counts */
    /* Tile pairs in the corners of a ball are left out; in one dimension there are none. */
    const double left = (double)layout->num_left;
    const double right = (double)layout->num_right;
    const bool has_corners =
        problem->frequencies->kind == PS_FREQUENCIES_BALL && problem->frequencies->dimension > 1;
    const double share =
        has_corners ? fmin(1, (double)problem->frequencies->num / (2 * left * right + left + right))
                    : 1;
    const double product = product_points((double)problem->num_points);
    const double read_back =
        problem->harmonics == PS_NO_HARMONICS
            ? 0
            : ps_torus_coefficient_bytes(layout->is_grid ? (double)layout->max_pairs : 0,
                                         (double)(layout->left_tiles + layout->right_tiles), lanes);
    return (ps_work){
        .programs = layout->is_shared ? 2 : 1,
        .phases = num_points * lanes * (double)(layout->left_tiles + layout->right_tiles),
        .product_flops = (layout->is_shared ? shared_flops(layout, product, realizations, share)
                                            : 8 * realizations * product * box * share) *
                         (layout->units != PS_UNITS_NONE ? time_by_units[precision] : 1),
        .launches = ceil(realizations / (double)layout->group) *
                    (double)ps_divide_up((size_t)problem->num_points, layout->slab) *
                    (layout->is_grid ? 2 : 1),
        .fixed_bytes = (double)layout->fixed_bytes + read_back,
        .host_bytes = read_back,
        .point_bytes = (double)layout->point_bytes,
        .coordinate_bytes =
            (double)(layout->table_points * problem->frequencies->dimension * sizeof(uint64_t)),
        .bytes_per_realization = (double)layout->bytes_per_realization,
        .row_bytes = (double)(layout->max_stride * layout->real_bytes),
        .largest_buffer_per_realization = (double)layout->largest_buffer_per_realization};
}

static ps_survey survey(const ps_problem *problem, const ps_device_limits *limits,
                        ps_precision precision) {
    ps_survey result = {0};
    if (!ps_engine_on_device(limits, precision, &result.why_not)) {
        return result;
    }
    const ps_torus_layout layout = ps_torus_layout_make(problem, limits, precision);
    result.why_not = refuse(&layout, limits);
    result.work = work_of(&layout, problem, precision);
    result.error = ps_torus_error(problem->frequencies, precision, layout.units != PS_UNITS_NONE,
                                  (double)problem->num_points, ps_expected_power(problem));
    return result;
}

static double error_of_state(const void *state, double mean_power, double weight_share) {
    const torus_direct *self = state;
    (void)weight_share;
    return ps_torus_error(self->frequencies, self->precision, self->layout.units != PS_UNITS_NONE,
                          (double)self->num_points, mean_power);
}

/* ---- create and destroy ------------------------------------------------------------------ */

static void destroy(void *state) {
    torus_direct *self = state;
    ps_split_free(&self->split);
    ps_torus_points_free(&self->points);
    ps_torus_sums_free(&self->sums);
    ps_torus_product_free(&self->product);
    ps_buffer_release(&self->scales);
    ps_buffer_release(&self->power);
}

/* Left and right factors in one list; the left ones fill whole tiles, padded with zeros. */
static pspec_status create_factor_sums(torus_direct *self, ps_error *error) {
    const ps_split *split = &self->split;
    const unsigned dimension = self->frequencies->dimension;
    const size_t num_left = split->left.num_tiles * split->lanes;
    const size_t num = num_left + split->right.num;
    void *vectors = NULL;
    PS_TRY(ps_allocate(&vectors, num * dimension, sizeof(int32_t), "frequencies", error));
    memcpy(vectors, split->left.vectors, split->left.num * dimension * sizeof(int32_t));
    memcpy((int32_t *)vectors + num_left * dimension, split->right.vectors,
           split->right.num * dimension * sizeof(int32_t));
    const pspec_status status =
        ps_torus_sums_create(&self->sums, &self->layout, dimension, num, vectors, self->batch,
                             self->layout.group, split->left.num_tiles, self->device, error);
    free(vectors);
    return status;
}

static pspec_status create_grid(torus_direct *self, ps_error *error) {
    PS_TRY(ps_split_create(&self->split, self->frequencies, self->layout.lanes, error));
    PS_TRY(create_factor_sums(self, error));
    self->stride = ps_split_stride(&self->split);
    return ps_torus_product_create(&self->product, &self->layout, &self->split, self->device,
                                   error);
}

static pspec_status create_list(torus_direct *self, ps_error *error) {
    PS_TRY(ps_torus_sums_create(&self->sums, &self->layout, self->frequencies->dimension,
                                self->frequencies->num, self->frequencies->vectors, self->batch,
                                self->layout.group, 0, self->device, error));
    self->stride = self->sums.num_tiles * self->layout.lanes;
    return PSPEC_OK;
}

/* Rows begin as zeros: accumulation reads what stands between the frequencies, too. */
static pspec_status create_rows(torus_direct *self, ps_error *error) {
    const size_t num_rows = self->batch;
    PS_TRY(ps_buffer_create(self->device, &self->power,
                            num_rows * self->stride * self->layout.real_bytes, "powers of a batch",
                            error));
    PS_TRY(ps_buffer_clear(self->device, &self->power, error));
    return ps_buffer_create(self->device, &self->scales, self->batch * self->layout.real_bytes,
                            "scales", error);
}

static pspec_status create(void *state, const ps_problem *problem, ps_precision precision,
                           size_t batch, ps_device *device, ps_error *error) {
    torus_direct *const self = state;
    self->device = device;
    self->frequencies = problem->frequencies;
    self->precision = precision;
    self->num_points = problem->num_points;
    self->batch = batch;
    self->layout = ps_torus_layout_make(problem, ps_device_get_limits(device), precision);
    self->layout.group = self->layout.group < batch ? self->layout.group : batch;
    PS_TRY(ps_torus_points_create(&self->points, problem->frequencies->dimension, batch,
                                  self->layout.table_points, precision, self->layout.is_grid,
                                  device, error));
    PS_TRY(self->layout.is_grid ? create_grid(self, error) : create_list(self, error));
    return create_rows(self, error);
}

static void get_slots(const void *state, uint32_t *slots) {
    const torus_direct *self = state;
    const ps_frequencies *set = self->frequencies;
    for (size_t i = 0; i < set->num; i++) {
        slots[i] = self->layout.is_grid
                       ? (uint32_t)ps_split_slot(&self->split, set->vectors + i * set->dimension)
                       : (uint32_t)i;
    }
}

static size_t get_stride(const void *state) {
    return ((const torus_direct *)state)->stride;
}

/* ---- run --------------------------------------------------------------------------------- */

/* Where a slab of a group of realizations stands in its job. */
typedef struct slab_place {
    size_t first_row, num_patterns;
    size_t first_point;
    bool is_only, is_last; /* slab of its group */
} slab_place;

static pspec_status multiply(torus_direct *self, const slab_place *at, size_t num_points,
                             ps_error *error) {
    const product_numbers numbers = {.num_pairs = self->split.num_pairs,
                                     .num_tiles = self->sums.num_tiles,
                                     .num_left_tiles = self->split.left.num_tiles,
                                     .table_points = self->layout.table_points,
                                     .first_row = at->first_row,
                                     .stride = self->stride,
                                     .is_first = at->first_point == 0,
                                     .is_last = at->is_last,
                                     .keeps_sums = self->keeps_sums};
    const ps_torus_factors factors = {.sums = &self->sums,
                                      .points = &self->points,
                                      .scales = &self->scales,
                                      .num_patterns = at->num_patterns,
                                      .num_points = num_points};
    return ps_torus_product_add(&self->product, &numbers, &factors, &self->power, self->device,
                                error);
}

static pspec_status add_slab(torus_direct *self, const ps_batch *group, const slab_place *at,
                             ps_error *error) {
    size_t num_points = 0;
    PS_TRY(ps_torus_points_upload(&self->points, self->device, group, at->first_point, &num_points,
                                  error));
    PS_TRY(ps_torus_sums_add(&self->sums, &self->points, at->first_row, at->num_patterns,
                             num_points, self->device, error));
    if (!at->is_only) { /* the next slab overwrites the sums of the chunks */
        PS_TRY(ps_torus_sums_fold(&self->sums, at->first_row, at->num_patterns,
                                  at->first_point == 0, self->device, error));
    }
    return self->layout.is_grid ? multiply(self, at, num_points, error) : PSPEC_OK;
}

/* One group of realizations, slab after slab. All groups of a batch have as many slabs as its
 * longest pattern needs, so that one fold serves all of them when that is one. */
static pspec_status run_group(torus_direct *self, const ps_batch *group, size_t first_row,
                              size_t num_slabs, ps_error *error) {
    for (size_t slab = 0; slab < num_slabs; slab++) {
        const slab_place at = {.first_row = first_row,
                               .num_patterns = group->num_patterns,
                               .first_point = slab * self->layout.slab,
                               .is_only = num_slabs == 1,
                               .is_last = slab + 1 == num_slabs};
        PS_TRY(ps_batch_go_on(group, error));
        PS_TRY(add_slab(self, group, &at, error));
    }
    return PSPEC_OK;
}

static pspec_status run(void *state, const ps_batch *batch, ps_rows *rows, ps_error *error) {
    torus_direct *self = state;
    const size_t num_slabs = ps_divide_up(ps_batch_longest(batch), self->layout.slab);
    const size_t first_slot = self->layout.is_grid ? ps_split_left_slot(&self->split) : 0;
    PS_TRY(ps_reals_write(self->device, &self->scales, self->precision, batch->scales,
                          batch->num_patterns, error));
    for (size_t row = 0; row < batch->num_patterns; row += self->layout.group) {
        const ps_batch group = ps_batch_part(batch, row, self->layout.group);
        PS_TRY(run_group(self, &group, row, num_slabs, error));
    }
    if (num_slabs == 1) {
        PS_TRY(ps_torus_sums_fold(&self->sums, 0, batch->num_patterns, true, self->device, error));
    }
    PS_TRY(ps_torus_sums_power(&self->sums, &self->scales, &self->power, first_slot, self->stride,
                               batch->num_patterns, self->device, error));
    *rows = (ps_rows){.num_rows = batch->num_patterns,
                      .stride = self->stride,
                      .precision = self->precision,
                      .device = self->power};
    return PSPEC_OK;
}

static pspec_status coefficients(void *state, const ps_batch *one, ps_rows *rows, double *out,
                                 ps_error *error) {
    static const double no_scale = 1;
    torus_direct *self = state;
    ps_batch batch = *one;
    ps_rows unused = {0};
    batch.scales = rows != NULL ? one->scales : &no_scale;
    self->keeps_sums = true;
    const pspec_status status = run(state, &batch, rows != NULL ? rows : &unused, error);
    self->keeps_sums = false;
    if (status != PSPEC_OK) {
        return status;
    }
    const ps_torus_finished finished = {.frequencies = self->frequencies,
                                        .split = self->layout.is_grid ? &self->split : NULL,
                                        .products = &self->product.sums,
                                        .sums = &self->sums,
                                        .precision = self->precision,
                                        .exponent = one->exponents != NULL ? one->exponents[0] : 0};
    return ps_torus_coefficients(&finished, self->device, out, error);
}

static void describe(const void *state, ps_text *text) {
    const torus_direct *self = state;
    const ps_torus_layout *layout = &self->layout;
    ps_text_append(text, "(torus_direct precision=%s lanes=%u run=%d group=%zu slab=%zu",
                   ps_precision_name(self->precision), layout->lanes,
                   !layout->is_grid                 ? PS_TORUS_LIST_RUN
                   : layout->units != PS_UNITS_NONE ? UNIT_RUN
                                                    : PS_TORUS_RUN,
                   layout->group, layout->slab);
    if (layout->is_grid) {
        ps_text_append(text, " split=%zux%zu tiles=%zu/%zu%s%s)", layout->num_left,
                       layout->num_right, self->split.num_pairs, layout->max_pairs,
                       layout->units != PS_UNITS_NONE ? " units=" : "",
                       layout->units != PS_UNITS_NONE ? ps_units_name(layout->units) : "");
    } else {
        ps_text_append(text, " list=%zu)", layout->num_left);
    }
}

const ps_engine ps_torus_direct = {
    .name = "torus_direct",
    .domains = PS_ON_TORUS,
    .needs_device = true,
    .has_precision = {true, true, false},
    .takes_sets = true,
    .checks_points = true,
    .survey = survey,
    .error_of_state = error_of_state,
    .state_bytes = sizeof(torus_direct),
    .create = create,
    .get_slots = get_slots,
    .get_stride = get_stride,
    .run = run,
    .coefficients = coefficients,
    .describe = describe,
    .destroy = destroy,
};
