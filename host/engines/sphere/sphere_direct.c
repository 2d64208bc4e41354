/* Orders in passes, points in slabs: for each directions and sums over points, after the last slab
 * sums over orders. */
#include "engines/engine.h"

#include "base/memory.h"
#include "base/round.h"
#include "device/reals.h"
#include "engines/late_rows.h"
#include "engines/sphere/sphere_layout.h"
#include "engines/sphere/sphere_points.h"
#include "math/pi.h"
#include "sphere/sums.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct sphere_direct {
    ps_device *device;
    ps_problem problem;
    ps_precision precision;
    ps_sphere_layout layout;
    size_t batch;
    ps_sphere_points points;
    ps_kernel *sums_kernel, *power_kernel;
    size_t table_pass;      /* whose table is on the device */
    long double *constants; /* [L + 1] of the orders */
    double *host_table;     /* [pass_blocks][PS_SPHERE_BLOCK_REALS] */
    uint32_t *host_blocks;  /* [pass_orders] */
    void *host_sums;        /* of an order, as the device has them */
    ps_late_rows rows;
    ps_buffer table, blocks, sums, powers;
} sphere_direct;

/* ---- what the planner asks --------------------------------------------------------------- */

static ps_work work_of(const ps_sphere_layout *layout, const ps_problem *problem,
                       const ps_device_limits *limits) {
    const double slabs = ceil((double)problem->num_points / (double)layout->slab);
    const double launches = 2 * slabs + 1;
    return (ps_work){.harmonics = ps_sphere_harmonics(layout, problem, limits),
                     .programs = 2, /* vectors; sums and powers */
                     .launches = launches * (double)layout->num_passes,
                     .fixed_bytes = layout->fixed_bytes,
                     .host_bytes = layout->fixed_bytes / 2,
                     .bytes_per_realization = layout->bytes_per_realization,
                     .row_bytes = (double)problem->frequencies->num * sizeof(double),
                     .point_bytes = layout->point_bytes,
                     .coordinate_bytes = layout->coordinate_bytes,
                     .largest_buffer_per_realization = layout->largest_buffer_per_realization};
}

static ps_survey survey(const ps_problem *problem, const ps_device_limits *limits,
                        ps_precision precision) {
    ps_survey result = {0};
    if (!ps_engine_on_device(limits, precision, &result.why_not)) {
        return result;
    }
    const ps_sphere_layout layout = ps_sphere_layout_make(problem, limits, precision);
    const double most = (double)limits->max_allocation_bytes;
    if (layout.largest_buffer > most || layout.largest_buffer_per_realization > most) {
        result.why_not = "needs a larger buffer than the device allows";
    }
    result.work = work_of(&layout, problem, limits);
    result.error = ps_sphere_error(problem, precision, ps_expected_power(problem));
    return result;
}

static double error_of_state(const void *state, double mean_power, double weight_share) {
    const sphere_direct *self = state;
    (void)weight_share;
    return ps_sphere_error(&self->problem, self->precision, mean_power);
}

/* ---- create and destroy ------------------------------------------------------------------ */

static void destroy(void *state) {
    sphere_direct *self = state;
    ps_sphere_points_free(&self->points);
    free(self->constants);
    free(self->host_table);
    free(self->host_blocks);
    free(self->host_sums);
    ps_late_rows_free(&self->rows);
    PS_BUFFERS_RELEASE(&self->table, &self->blocks, &self->sums, &self->powers);
}

static pspec_status create_kernels(sphere_direct *self, ps_error *error) {
    const ps_sphere_layout *layout = &self->layout;
    ps_defines defines = ps_defines_of(layout->real_bytes, layout->lanes);
    ps_defines_add(&defines, "-DCHUNK=%d -DJOBS=%u -DORDERS=%u -DONLY_EVEN=%d", PS_SPHERE_CHUNK,
                   layout->group_items, layout->group_orders, layout->only_even);
    PS_TRY(ps_kernel_get(self->device, &self->sums_kernel, "sphere/sums.cl", "sphere_sums",
                         defines.text, error));
    return ps_kernel_get(self->device, &self->power_kernel, "sphere/sums.cl", "sphere_power",
                         defines.text, error);
}

static pspec_status allocate_on_host(sphere_direct *self, ps_error *error) {
    const ps_sphere_layout *layout = &self->layout;
    PS_TRY(
        PS_NEW(&self->constants, (size_t)layout->max_degree + 1, "constants of the orders", error));
    PS_TRY(PS_NEW(&self->host_table, layout->pass_blocks * PS_SPHERE_BLOCK_REALS,
                  "a table of Legendre functions", error));
    PS_TRY(PS_NEW(&self->host_blocks, layout->pass_orders, "places of orders", error));
    PS_TRY(ps_allocate(&self->host_sums, PS_SPHERE_SUMS * layout->stride, layout->real_bytes,
                       "coefficients of an order", error));
    self->constants[0] = sqrtl(1 / PS_FOUR_PI_L);
    for (int32_t m = 1; m <= layout->max_degree; m++) {
        self->constants[m] = ps_sphere_next_constant(self->constants[m - 1], m);
    }
    return PSPEC_OK;
}

static pspec_status create_buffers(sphere_direct *self, ps_error *error) {
    const ps_sphere_layout *layout = &self->layout;
    const size_t row = layout->stride * layout->real_bytes;
    const ps_wanted_buffer wanted[] = {
        {&self->table, layout->pass_blocks * PS_SPHERE_BLOCK_REALS * layout->real_bytes,
         "a table of Legendre functions"},
        {&self->blocks, layout->pass_orders * sizeof(uint32_t), "places of orders"},
        {&self->sums, self->batch * layout->pass_orders * PS_SPHERE_SUMS * row,
         "coefficients of a batch"},
        {&self->powers, self->batch * PS_SPHERE_POWERS * row, "powers of a batch"}};
    return PS_BUFFERS_CREATE(self->device, wanted, error);
}

/* Q(l) = (4 pi / (2l + 1)) (|c_l0|^2 + 2 sum_{m > 0} |c_lm|^2). */
static void make_row(const void *engine, const void *powers, double scale, double square,
                     double *row) {
    const sphere_direct *self = engine;
    const ps_frequencies *set = self->problem.frequencies;
    const ps_sphere_layout *layout = &self->layout;
    (void)square;
    for (size_t i = 0; i < set->num; i++) {
        const size_t l = (size_t)set->vectors[i];
        const double half = ps_real_at(layout->precision, powers, l) +
                            ps_real_at(layout->precision, powers, layout->stride + l);
        row[i] = 2 * PS_FOUR_PI / (2 * (double)l + 1) * half * scale;
    }
}

static pspec_status create_rows(sphere_direct *self, ps_error *error) {
    self->rows = (ps_late_rows){.engine = self,
                                .make = make_row,
                                .num = self->problem.frequencies->num,
                                .batch = self->batch,
                                .most = self->batch,
                                .sum_bytes = PS_SPHERE_POWERS * self->layout.stride *
                                             self->layout.real_bytes};
    return ps_late_rows_create(&self->rows, self->device, error);
}

static pspec_status create(void *state, const ps_problem *problem, ps_precision precision,
                           size_t batch, ps_device *device, ps_error *error) {
    sphere_direct *const self = state;
    self->device = device;
    self->problem = *problem;
    self->precision = precision;
    self->batch = batch;
    self->layout = ps_sphere_layout_make(problem, ps_device_get_limits(device), precision);
    self->table_pass = SIZE_MAX;
    PS_TRY(ps_sphere_points_create(&self->points, &self->layout, batch, device, error));
    PS_TRY(create_kernels(self, error));
    PS_TRY(allocate_on_host(self, error));
    PS_TRY(create_buffers(self, error));
    return create_rows(self, error);
}

/* ---- a pass of orders -------------------------------------------------------------------- */

/* The table of a pass, unless it is there. */
static pspec_status upload_table(sphere_direct *self, size_t pass, ps_error *error) {
    const ps_sphere_layout *layout = &self->layout;
    const size_t orders = ps_sphere_pass_orders(layout, pass);
    const int32_t first = (int32_t)(pass * layout->pass_orders);
    if (self->table_pass == pass) {
        return PSPEC_OK;
    }
    const size_t blocks =
        ps_sphere_all_blocks(layout->max_degree, first, orders, self->host_blocks);
    for (size_t i = 0; i < orders; i++) {
        const int32_t m = first + (int32_t)i;
        ps_sphere_fill_order(self->host_table +
                                 (size_t)self->host_blocks[i] * PS_SPHERE_BLOCK_REALS,
                             layout->max_degree, m, self->constants[m]);
    }
    PS_TRY(ps_reals_write(self->device, &self->table, layout->precision, self->host_table,
                          blocks * PS_SPHERE_BLOCK_REALS, error));
    PS_TRY(ps_buffer_write(self->device, &self->blocks, 0, self->host_blocks,
                           orders * sizeof(uint32_t), error));
    self->table_pass = pass;
    return PSPEC_OK;
}

static double pass_harmonics(const ps_sphere_layout *layout, size_t pass) {
    const double orders = (double)ps_sphere_pass_orders(layout, pass);
    const double first = (double)(pass * layout->pass_orders);
    return orders * (layout->max_degree + 1 - first - (orders - 1) / 2);
}

static pspec_status add_slab(sphere_direct *self, size_t num_patterns, size_t pass, bool has_low,
                             bool is_first, ps_error *error) {
    const ps_sphere_layout *layout = &self->layout;
    const ps_sphere_points *points = &self->points;
    const size_t orders = ps_sphere_pass_orders(layout, pass);
    const double harmonics =
        (double)(points->num_vectors * layout->lanes) * pass_harmonics(layout, pass);
    const double flops_per_harmonic = layout->only_even ? 7 : 9;
    const sums_numbers numbers = {.stride = layout->stride,
                                  .capacity = points->capacity,
                                  .first_order = (uint32_t)(pass * layout->pass_orders),
                                  .num_orders = (uint32_t)orders,
                                  .max_degree = (uint32_t)layout->max_degree,
                                  .has_low = has_low,
                                  .is_first = is_first};
    ps_range range = {.rank = 3,
                      .global = {ps_divide_up(orders, layout->group_orders) * layout->group_items,
                                 num_patterns, 1},
                      .local = {layout->group_items, 1, 1},
                      .flops = flops_per_harmonic * harmonics};
    return PS_LAUNCH(self->device, self->sums_kernel, &range, error, PS_STRUCT(numbers),
                     PS_BUFFER(points->values), PS_BUFFER(points->turns),
                     PS_BUFFER(points->weights), PS_BUFFER(points->offsets), PS_BUFFER(self->table),
                     PS_BUFFER(self->blocks), PS_BUFFER(self->sums));
}

static pspec_status add_orders(sphere_direct *self, size_t num_patterns, size_t pass, bool has_low,
                               ps_error *error) {
    const ps_sphere_layout *layout = &self->layout;
    const size_t vectors = ps_divide_up((uint64_t)layout->max_degree + 1, layout->lanes);
    const double flops_per_harmonic = 18;
    const double harmonics = (double)num_patterns * pass_harmonics(layout, pass);
    const ps_range range =
        ps_range_heavy(self->device, vectors, num_patterns, 1, flops_per_harmonic * harmonics,
                       2 * harmonics * (double)layout->real_bytes);
    return PS_LAUNCH(self->device, self->power_kernel, &range, error, PS_BUFFER(self->sums),
                     PS_BUFFER(self->powers), PS_U32(pass * layout->pass_orders),
                     PS_U32(ps_sphere_pass_orders(layout, pass)), PS_U32(layout->max_degree),
                     PS_U64(layout->stride), PS_U32(has_low));
}

/* More points than a chunk: the sums have low parts. */
static bool has_low_parts(const sphere_direct *self, size_t longest) {
    return longest > PS_SPHERE_CHUNK || longest > self->layout.slab;
}

/* The coefficients of a pass of orders, in the device's sums. */
static pspec_status sum_pass(sphere_direct *self, const ps_batch *batch, size_t pass,
                             ps_error *error) {
    const size_t longest = ps_batch_longest(batch);
    const size_t slab = self->layout.slab;
    PS_TRY(upload_table(self, pass, error));
    for (size_t first = 0; first < longest; first += slab) {
        PS_TRY(ps_batch_go_on(batch, error));
        if (pass == 0 || longest > slab) { /* else they are still there */
            PS_TRY(ps_sphere_points_upload(&self->points, batch, first, error));
        }
        PS_TRY(add_slab(self, batch->num_patterns, pass, has_low_parts(self, longest), first == 0,
                        error));
    }
    return PSPEC_OK;
}

/* c_lm of an order from the first realization's sums, times 2^exponent. */
static pspec_status read_order(sphere_direct *self, size_t order, int32_t m, bool has_low,
                               int exponent, double *out, ps_error *error) {
    const ps_sphere_layout *layout = &self->layout;
    const size_t stride = layout->stride;
    const size_t bytes = PS_SPHERE_SUMS * stride * layout->real_bytes;
    const int64_t max_degree = layout->max_degree;
    double *to = out + m * (2 * max_degree + 1 - m);
    PS_TRY(ps_buffer_read(self->device, &self->sums, order * bytes, self->host_sums, bytes, error));
    for (int64_t l = m; l <= max_degree; l++) {
        const bool is_there = !layout->only_even || l % 2 == 0;
        for (size_t part = 0; part < 2; part++) {
            const size_t at = part * stride + (size_t)l;
            const double low =
                has_low ? ps_real_at(layout->precision, self->host_sums, 2 * stride + at) : 0;
            const double sum = ps_real_at(layout->precision, self->host_sums, at) + low;
            to[2 * l + (int64_t)part] = is_there ? ldexp(sum, exponent) : 0;
        }
    }
    return PSPEC_OK;
}

static pspec_status read_pass(sphere_direct *self, const ps_batch *one, size_t pass, bool has_low,
                              double *out, ps_error *error) {
    const int exponent = one->exponents != NULL ? one->exponents[0] : 0;
    for (size_t i = 0; i < ps_sphere_pass_orders(&self->layout, pass); i++) {
        const size_t m = pass * self->layout.pass_orders + i;
        PS_TRY(read_order(self, i, (int32_t)m, has_low, exponent, out, error));
    }
    return PSPEC_OK;
}

/* Sums on the device, and from them powers there and coefficients here (NULL: none). */
static pspec_status run_passes(sphere_direct *self, const ps_batch *batch, bool wants_powers,
                               double *coefficients, ps_error *error) {
    const bool has_low = has_low_parts(self, ps_batch_longest(batch));
    for (size_t pass = 0; pass < self->layout.num_passes; pass++) {
        PS_TRY(sum_pass(self, batch, pass, error));
        if (wants_powers) {
            PS_TRY(add_orders(self, batch->num_patterns, pass, has_low, error));
        }
        if (coefficients != NULL) {
            PS_TRY(read_pass(self, batch, pass, has_low, coefficients, error));
        }
    }
    return PSPEC_OK;
}

/* Of the whole batch in one go: with few degrees a read of every row took ten times as long as the
 * sums. */
static pspec_status give_rows(sphere_direct *self, const ps_batch *batch, ps_rows *rows,
                              ps_error *error) {
    PS_TRY(ps_late_rows_read(&self->rows, &self->powers, 0, batch->num_patterns, batch->scales,
                             NULL, error));
    *rows = ps_late_rows_give(&self->rows, batch->num_patterns);
    return PSPEC_OK;
}

/* ---- run --------------------------------------------------------------------------------- */

static pspec_status run(void *state, const ps_batch *batch, ps_rows *rows, ps_error *error) {
    PS_TRY(run_passes(state, batch, true, NULL, error));
    return give_rows(state, batch, rows, error);
}

static pspec_status coefficients(void *state, const ps_batch *one, ps_rows *rows, double *out,
                                 ps_error *error) {
    PS_TRY(run_passes(state, one, rows != NULL, out, error));
    return rows != NULL ? give_rows(state, one, rows, error) : PSPEC_OK;
}

static void describe(const void *state, ps_text *text) {
    const ps_sphere_layout *layout = &((const sphere_direct *)state)->layout;
    ps_text_append(text, "(sphere_direct precision=%s lanes=%u chunk=%d passes=%zu slab=%zu%s)",
                   ps_precision_name(layout->precision), layout->lanes, PS_SPHERE_CHUNK,
                   layout->num_passes, layout->slab, layout->only_even ? " even" : "");
}

const ps_engine ps_sphere_direct = {
    .name = "sphere_direct",
    .domains = PS_ON_SPHERE,
    .needs_device = true,
    .rows_on_host = true,
    .has_precision = {true, true, false},
    .survey = survey,
    .error_of_state = error_of_state,
    .state_bytes = sizeof(sphere_direct),
    .create = create,
    .run = run,
    .coefficients = coefficients,
    .describe = describe,
    .destroy = destroy,
};
