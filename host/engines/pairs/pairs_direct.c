/* The engine: runs of pairs in slabs; for each slab sums over its runs, which are added to those of
 * the slabs before. */
#include "engines/engine.h"

#include "base/memory.h"
#include "base/round.h"
#include "device/reals.h"
#include "engines/error_units.h"
#include "engines/pairs/pairs_degrees.h"

#include <math.h>
#include <stdlib.h>

/* Sums of the runs of a slab, for one realization: also about a tenth of a second of two cores,
 * since nothing stops a kernel. */
static const double slab_bytes = 4.0 * 1024 * 1024;

typedef struct run_layout {
    unsigned lanes;
    size_t stride;      /* of points */
    uint64_t num_runs;  /* of the largest realization */
    size_t num_degrees; /* rounded up */
    size_t slab;        /* runs at a time */
    double row_bytes, points_bytes;
} run_layout;

typedef struct pairs_direct {
    ps_device *device;
    ps_problem problem;
    ps_precision precision;
    run_layout layout;
    ps_pairs_points points;
    ps_pairs_degrees degrees;
    ps_kernel *kernel;
    ps_buffer partials;
} pairs_direct;

/* ---- what the planner asks --------------------------------------------------------------- */

static run_layout make_layout(const ps_problem *problem, const ps_device_limits *limits,
                              ps_precision precision) {
    const uint64_t num_points = problem->num_points > 0 ? problem->num_points : 1;
    const double real_bytes = (double)ps_real_bytes(precision);
    run_layout out = {.lanes = ps_engine_lanes(limits, precision),
                      .num_degrees = ps_pairs_num_degrees(problem->frequencies->max_frequency)};
    out.stride = ps_pairs_stride(num_points, out.lanes);
    out.num_runs = ps_divide_up(ps_pairs_vectors(num_points, out.lanes), PS_PAIRS_RUN);
    out.num_runs = out.num_runs > 0 ? out.num_runs : 1;
    out.row_bytes = (double)(PS_PAIRS_PARTS * out.num_degrees) * real_bytes;
    out.points_bytes = (double)(PS_PAIRS_ARRAYS * out.stride) * real_bytes;
    const double fit = slab_bytes / out.row_bytes;
    out.slab = fit < (double)out.num_runs ? (size_t)fmax(fit, 1) : (size_t)out.num_runs;
    return out;
}

static double largest_buffer(const run_layout *layout) {
    return fmax((double)layout->slab * layout->row_bytes, layout->points_bytes);
}

static ps_work work_of(const run_layout *layout, const ps_problem *problem) {
    const double realizations =
        problem->num_realizations > 0 ? (double)problem->num_realizations : 1;
    const double pairs =
        (double)ps_pairs_vectors(problem->num_points, layout->lanes) * layout->lanes * realizations;
    const double slabs = ceil((double)layout->num_runs / (double)layout->slab);
    const double kernels = 2; /* sums, and their sum */
    return (ps_work){.kernels = kernels,
                     .pair_degrees = pairs * ((double)layout->num_degrees + PS_PAIR_BEGIN_DEGREES),
                     .launches = 2 * slabs,
                     .fixed_bytes = layout->row_bytes,
                     .bytes_per_realization =
                         ((double)layout->slab + 1 + PS_READINGS) * layout->row_bytes,
                     .row_bytes = (double)problem->frequencies->num * sizeof(double),
                     .point_bytes = layout->points_bytes,
                     .coordinate_bytes = layout->points_bytes,
                     .largest_buffer_per_realization = largest_buffer(layout)};
}

static const ps_pairs_error_law error_laws[] = {
    [PS_SINGLE] = {4e-7, 4e-8, 3e-8}, [PS_DOUBLE] = {1e-15, 8e-17, 6e-17}};

static ps_survey survey(const ps_problem *problem, const ps_device_limits *limits,
                        ps_precision precision) {
    ps_survey result = {0};
    if (!ps_engine_sums_pairs(problem, &result.why_not) ||
        !ps_engine_on_device(limits, precision, &result.why_not)) {
        return result;
    }
    const run_layout layout = make_layout(problem, limits, precision);
    result.why_not = largest_buffer(&layout) > (double)limits->max_allocation_bytes
                         ? "needs a larger buffer than the device allows"
                         : NULL;
    result.work = work_of(&layout, problem);
    result.error = ps_pairs_rounding(&error_laws[precision], problem, ps_expected_power(problem));
    return result;
}

static double error_of_state(const void *state, double mean_power, double weight_share) {
    const pairs_direct *self = state;
    ps_problem problem = self->problem;
    problem.weight_share = weight_share;
    return ps_pairs_rounding(&error_laws[self->precision], &problem, mean_power);
}

/* ---- create and destroy ------------------------------------------------------------------ */

static void destroy(void *state) {
    pairs_direct *self = state;
    ps_pairs_points_free(&self->points);
    ps_pairs_degrees_free(&self->degrees);
    ps_buffer_release(&self->partials);
}

static pspec_status create_kernel(pairs_direct *self, const ps_problem *problem,
                                  ps_precision precision, ps_error *error) {
    const ps_defines defines = ps_pairs_defines(problem, precision, self->layout.lanes);
    return ps_kernel_get(self->device, &self->kernel, "pairs/sums.cl", "pairs_sums", defines.text,
                         error);
}

static pspec_status create(void *state, const ps_problem *problem, ps_precision precision,
                           size_t batch, ps_device *device, ps_error *error) {
    pairs_direct *const self = state;
    self->device = device;
    self->problem = *problem;
    self->precision = precision;
    self->layout = make_layout(problem, ps_device_get_limits(device), precision);
    const unsigned lanes = self->layout.lanes;
    PS_TRY(ps_pairs_points_create(&self->points, problem->num_points, batch, precision, lanes,
                                  device, error));
    PS_TRY(
        ps_pairs_degrees_create(&self->degrees, problem, precision, lanes, batch, device, error));
    PS_TRY(create_kernel(self, problem, precision, error));
    return ps_buffer_create(device, &self->partials,
                            batch * self->layout.slab * self->degrees.row_bytes,
                            "sums of runs of pairs", error);
}

/* ---- run --------------------------------------------------------------------------------- */

static pspec_status add_slab(pairs_direct *self, size_t num_patterns, uint64_t first,
                             size_t num_runs, ps_error *error) {
    const run_layout *layout = &self->layout;
    const double flops_per_degree = 6; /* as they are counted: docs/engines/pairs_direct.md */
    const double pairs = (double)num_runs * PS_PAIRS_RUN * layout->lanes * (double)num_patterns;
    const ps_range range = {.rank = 3,
                            .global = {num_runs, num_patterns, 1},
                            .local = {1, 1, 1},
                            .flops = flops_per_degree * pairs * (double)layout->num_degrees};
    PS_TRY(PS_LAUNCH(self->device, self->kernel, &range, error,
                     PS_BUFFER(self->points.points.filled), PS_BUFFER(self->points.counts),
                     PS_BUFFER(self->degrees.inverses), PS_BUFFER(self->partials),
                     PS_U64(layout->stride), PS_U64(first), PS_U32(layout->num_degrees)));
    return ps_pairs_degrees_fold(&self->degrees, &self->partials, num_patterns, num_runs,
                                 first == 0, error);
}

static pspec_status run(void *state, const ps_batch *batch, ps_rows *rows, ps_error *error) {
    pairs_direct *self = state;
    const uint64_t num_runs = ps_pairs_count_runs(batch, self->layout.lanes, PS_PAIRS_RUN);
    PS_TRY(ps_pairs_points_upload(&self->points, batch, error));
    for (uint64_t first = 0; first < num_runs; first += self->layout.slab) {
        const uint64_t rest = num_runs - first;
        PS_TRY(first == 0 ? ps_batch_go_on(batch, error)
                          : ps_batch_go_on_after(batch, self->device, error));
        PS_TRY(add_slab(self, batch->num_patterns, first,
                        rest < self->layout.slab ? (size_t)rest : self->layout.slab, error));
    }
    return ps_pairs_degrees_read(&self->degrees, &self->points, batch, rows, error);
}

static void describe(const void *state, ps_text *text) {
    const pairs_direct *self = state;
    ps_text_append(text, "(pairs_direct precision=%s lanes=%u chunk=%d run=%d%s)",
                   ps_precision_name(self->degrees.precision), self->layout.lanes, PS_PAIRS_CHUNK,
                   PS_PAIRS_RUN_CHUNKS, self->degrees.frequencies->degree_step == 2 ? " even" : "");
}

const ps_engine ps_pairs_direct = {
    .name = "pairs_direct",
    .summary = "Legendre polynomials of all pairs of points on the device",
    .domains = PS_ON_SPHERE,
    .needs_device = true,
    .rows_on_host = true,
    .sums_pairs = true,
    .has_precision = {true, true, false},
    .survey = survey,
    .error_of_state = error_of_state,
    .state_bytes = sizeof(pairs_direct),
    .create = create,
    .run = run,
    .describe = describe,
    .destroy = destroy,
};
