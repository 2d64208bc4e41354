/* The engine: runs of pairs in slabs; for each slab sums over its runs, which are added to those of
 * the slabs before. */
#include "engines/engine.h"

#include "device/reals.h"
#include "engines/error_units.h"
#include "engines/pairs/pairs_state.h"

#include <math.h>

/* Sums of the runs of a slab, for one realization: also about a tenth of a second of two cores,
 * since nothing stops a kernel. */
static const double slab_bytes = 4.0 * 1024 * 1024;

/* GPUs (kernels/pairs/sums_shared.cl) have longer runs, whose rows one work-item for a few degrees
 * adds up, one after the other: 512 of them for 4096 points, work for all units. */
enum { GPU_RUN = 4 * PS_PAIRS_RUN, GPU_ITEMS = 64 };

typedef struct pairs_direct {
    ps_pairs_state pairs;
    ps_kernel *kernel;
    bool is_shared; /* runs are of work-groups, not of work-items */
} pairs_direct;

/* ---- what the planner asks --------------------------------------------------------------- */

static ps_pairs_layout make_layout(const ps_problem *problem, const ps_device_limits *limits,
                                   ps_precision precision) {
    ps_pairs_layout out = ps_pairs_layout_of(problem, limits, precision);
    ps_pairs_layout_cut(&out, problem, limits->has_dedicated_local_memory ? GPU_RUN : PS_PAIRS_RUN,
                        out.row_bytes, slab_bytes);
    return out;
}

static double largest_buffer(const ps_pairs_layout *layout) {
    return fmax((double)layout->slab * layout->row_bytes, layout->points_bytes);
}

static ps_work work_of(const ps_pairs_layout *layout, const ps_problem *problem,
                       const ps_device_limits *limits) {
    const double realizations =
        problem->num_realizations > 0 ? (double)problem->num_realizations : 1;
    const double pairs =
        (double)ps_pairs_vectors(problem->num_points, layout->lanes) * layout->lanes * realizations;
    const double slabs = ceil((double)layout->num_runs / (double)layout->slab);
    const double idle = limits->has_dedicated_local_memory
                            ? ps_engine_idle_factor((double)layout->num_runs * realizations, limits)
                            : 1; /* whose runs are many */
    return (ps_work){
        .programs = limits->has_dedicated_local_memory ? 2 : 1,
        .pair_degrees = pairs * ((double)layout->num_degrees + PS_PAIR_BEGIN_DEGREES) * idle,
        .launches = 2 * slabs,
        .fixed_bytes = layout->row_bytes,
        .bytes_per_realization = ((double)layout->slab + 1 + PS_READINGS) * layout->row_bytes,
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
    const ps_pairs_layout layout = make_layout(problem, limits, precision);
    result.why_not = largest_buffer(&layout) > (double)limits->max_allocation_bytes
                         ? "needs a larger buffer than the device allows"
                         : NULL;
    result.work = work_of(&layout, problem, limits);
    result.error = ps_pairs_rounding(&error_laws[precision], problem, ps_expected_power(problem));
    return result;
}

static double error_of_state(const void *state, double mean_power, double weight_share) {
    const ps_pairs_state *self = state;
    ps_problem problem = self->problem;
    problem.weight_share = weight_share;
    return ps_pairs_rounding(&error_laws[self->precision], &problem, mean_power);
}

static pspec_status create(void *state, const ps_problem *problem, ps_precision precision,
                           size_t batch, ps_device *device, ps_error *error) {
    pairs_direct *const self = state;
    const ps_device_limits *limits = ps_device_get_limits(device);
    const ps_pairs_layout layout = make_layout(problem, limits, precision);
    self->is_shared = limits->has_dedicated_local_memory;
    PS_TRY(ps_pairs_create(&self->pairs, self->is_shared ? "pairs/fold.cl" : "pairs/sums.cl",
                           problem, precision, &layout, batch, device, error));
    ps_defines defines = ps_pairs_defines(&self->pairs);
    if (self->is_shared) {
        ps_defines_add(&defines, "-DJOBS=%d", GPU_ITEMS);
    }
    PS_TRY(ps_kernel_get(
        device, &self->kernel, self->is_shared ? "pairs/sums_shared.cl" : "pairs/sums.cl",
        self->is_shared ? "pairs_sums_shared" : "pairs_sums", defines.text, error));
    return ps_buffer_create(device, &self->pairs.partials,
                            batch * layout.slab * (size_t)layout.row_bytes, "sums of runs of pairs",
                            error);
}

/* ---- run --------------------------------------------------------------------------------- */

static pspec_status add_slab(void *state, size_t num_patterns, uint64_t first, size_t num_runs,
                             ps_error *error) {
    const pairs_direct *direct = state;
    ps_pairs_state *const self = state;
    const ps_pairs_layout *layout = &self->layout;
    const double flops_per_degree = 6; /* as they are counted: docs/engines/pairs_direct.md */
    const double pairs =
        (double)num_runs * (double)layout->run_vectors * layout->lanes * (double)num_patterns;
    const size_t items = direct->is_shared ? GPU_ITEMS : 1;
    const ps_range range = {.rank = 3,
                            .global = {num_runs * items, num_patterns, 1},
                            .local = {items, 1, 1},
                            .flops = flops_per_degree * pairs * (double)layout->num_degrees};
    PS_TRY(PS_LAUNCH(self->device, direct->kernel, &range, error, PS_BUFFER(self->points.filled),
                     PS_BUFFER(self->counts), PS_BUFFER(self->inverses), PS_BUFFER(self->partials),
                     PS_U64(layout->stride), PS_U64(first), PS_U32(layout->num_degrees),
                     PS_U64(layout->run_vectors)));
    return ps_pairs_fold(self, &self->partials, num_patterns, num_runs, first == 0, error);
}

static pspec_status run(void *state, const ps_batch *batch, ps_rows *rows, ps_error *error) {
    PS_TRY(ps_pairs_run(state, batch, add_slab, error));
    return ps_pairs_read(state, batch, rows, error);
}

static void describe(const void *state, ps_text *text) {
    const ps_pairs_state *self = state;
    ps_text_append(text, "(pairs_direct precision=%s lanes=%u ", ps_precision_name(self->precision),
                   self->layout.lanes);
    if (((const pairs_direct *)state)->is_shared) {
        ps_text_append(text, "items=%d run=%llu", GPU_ITEMS,
                       (unsigned long long)self->layout.run_vectors);
    } else {
        ps_text_append(text, "chunk=%d run=%d", PS_PAIRS_CHUNK, PS_PAIRS_RUN_CHUNKS);
    }
    ps_text_append(text, "%s)", self->problem.frequencies->degree_step == 2 ? " even" : "");
}

const ps_engine ps_pairs_direct = {
    .name = "pairs_direct",
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
    .destroy = ps_pairs_free,
};
