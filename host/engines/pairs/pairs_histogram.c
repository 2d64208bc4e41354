/* The engine: runs of pairs in slabs, each run into a histogram of its own, all added up; then
 * weights of nodes from the moments of the bins, and Legendre sums over the nodes. */
#include "engines/engine.h"

#include "base/memory.h"
#include "base/round.h"
#include "device/reals.h"
#include "engines/error_units.h"
#include "engines/pairs/pairs_bins.h"
#include "engines/pairs/pairs_state.h"

#include <math.h>
#include <stdlib.h>

/* Histograms of the runs of a slab, for one realization. */
static const double slab_bytes = 8.0 * 1024 * 1024;

/* Pairs of a run at least, for each number of its histogram, which is cleared and added up: a tenth
 * of the time of the pairs; and for a work-item to be worth it. */
enum { PAIRS_PER_NUMBER = 4, LEAST_RUN = 1 << 14 };

/* Bins may lose this part of the tolerance: more leaves too little for the rounding of single
 * precision at 1e-5 and L = 500, and a quarter takes a tenth more bins than a half; but not less
 * than precision does, nor so much that it shows in a plot. */
static const double share_of_bins = 0.25;
static const double least_bound[] = {[PS_SINGLE] = 1e-7, [PS_DOUBLE] = 1e-15};
static const double largest_bound = 1e-3;

typedef struct histogram_layout {
    ps_pairs_layout pairs;
    size_t num_bins, num_nodes; /* bins of either side; nodes of both, as many as moments */
    size_t node_runs;           /* of nodes */
    double histogram_bytes;
} histogram_layout;

static const char program[] = "pairs/histogram.cl";

typedef struct pairs_histogram {
    ps_pairs_state pairs;
    double bound;
    histogram_layout layout;
    ps_kernel *histogram_kernel, *nodes_kernel, *sums_kernel;
    ps_buffer scale, matrix, nodes;
    ps_buffer moments, weights, node_partials;
} pairs_histogram;

/* ---- what the planner asks --------------------------------------------------------------- */

static size_t find_bins(const ps_problem *problem, ps_precision precision) {
    const double wanted = fmin(share_of_bins * problem->tolerance, largest_bound);
    return ps_pairs_bins_choose(problem->frequencies->max_frequency,
                                fmax(wanted, least_bound[precision]));
}

static histogram_layout make_layout(const ps_problem *problem, const ps_device_limits *limits,
                                    ps_precision precision) {
    histogram_layout out = {.pairs = ps_pairs_layout_of(problem, limits, precision),
                            .num_bins = find_bins(problem, precision)};
    const unsigned lanes = out.pairs.lanes;
    out.num_nodes = 2 * out.num_bins * PS_PAIRS_MOMENTS;
    out.node_runs = ps_divide_up(out.num_nodes / lanes, PS_PAIRS_RUN);
    out.histogram_bytes = (double)out.num_nodes * (double)ps_real_bytes(precision);
    const uint64_t wanted = PAIRS_PER_NUMBER * out.num_nodes;
    ps_pairs_layout_cut(&out.pairs, problem,
                        ps_divide_up(wanted > LEAST_RUN ? wanted : LEAST_RUN, lanes),
                        out.histogram_bytes, slab_bytes);
    return out;
}

static double largest_buffer(const histogram_layout *layout) {
    const double histograms = fmax((double)layout->pairs.slab, 2) * layout->histogram_bytes;
    return fmax(fmax(histograms, layout->pairs.points_bytes),
                (double)layout->node_runs * layout->pairs.row_bytes);
}

/* What a set costs besides, as pairs: 1 us for the kernels and 2 us of the host at N = 64 .. 256
 * (Zen 5, PoCL 3.1). */
static const double pairs_per_set = 2500;

static ps_work work_of(const histogram_layout *layout, const ps_problem *problem) {
    const double realizations =
        problem->num_realizations > 0 ? (double)problem->num_realizations : 1;
    const double pairs =
        (double)ps_pairs_vectors(problem->num_points, layout->pairs.lanes) * layout->pairs.lanes;
    const double slabs = ceil((double)layout->pairs.num_runs / (double)layout->pairs.slab);
    const double tables =
        2 * layout->histogram_bytes + layout->pairs.row_bytes; /* nodes have two numbers */
    const double histograms = ((double)layout->pairs.slab + 3) * layout->histogram_bytes;
    const double rows = ((double)layout->node_runs + 1 + PS_READINGS) * layout->pairs.row_bytes;
    return (ps_work){
        .programs = 1,
        .binned_pairs = (pairs + pairs_per_set +
                         (double)(layout->pairs.num_runs * layout->num_nodes) / PAIRS_PER_NUMBER) *
                        realizations,
        .node_degrees = (double)layout->num_nodes *
                        ((double)layout->pairs.num_degrees + PS_PAIR_BEGIN_DEGREES) * realizations,
        .launches = 2 * slabs + 3,
        .fixed_bytes = 2 * tables,
        .host_bytes = tables,
        .bytes_per_realization = histograms + rows,
        .row_bytes = (double)problem->frequencies->num * sizeof(double),
        .point_bytes = layout->pairs.points_bytes,
        .coordinate_bytes = layout->pairs.points_bytes,
        .largest_buffer_per_realization = largest_buffer(layout)};
}

/* The bound of the bins, and rounding, mostly of the place in a bin. Pairs of the same chord go
 * into one bin, where a run adds them up one by one: if all are alike, each addition may round by
 * half a unit, the same way. */
static const ps_pairs_error_law error_laws[] = {
    [PS_SINGLE] = {1e-6, 2e-7, 3e-8}, [PS_DOUBLE] = {5e-15, 4e-16, 6e-17}};

static double error_of(const histogram_layout *layout, const ps_problem *problem,
                       ps_precision precision, double mean_power) {
    static const double half_unit[] = {[PS_SINGLE] = 0x1p-25, [PS_DOUBLE] = 0x1p-54};
    const double num = (double)problem->num_points;
    const double pairs =
        fmin((double)layout->pairs.run_vectors * layout->pairs.lanes, num * (num - 1) / 2);
    const double share = fmin(1, fabs(mean_power) * ps_weight_share(problem));
    return half_unit[precision] * pairs * share +
           ps_pairs_bins_bound(problem->frequencies->max_frequency, layout->num_bins) +
           ps_pairs_rounding(&error_laws[precision], problem, mean_power);
}

static ps_survey survey(const ps_problem *problem, const ps_device_limits *limits,
                        ps_precision precision) {
    ps_survey result = {0};
    if (!ps_engine_sums_pairs(problem, &result.why_not) ||
        !ps_engine_on_device(limits, precision, &result.why_not)) {
        return result;
    }
    const histogram_layout layout = make_layout(problem, limits, precision);
    result.why_not = largest_buffer(&layout) > (double)limits->max_allocation_bytes
                         ? "needs a larger buffer than the device allows"
                         : NULL;
    result.work = work_of(&layout, problem);
    result.error = error_of(&layout, problem, precision, ps_expected_power(problem));
    return result;
}

static double error_of_state(const void *state, double mean_power, double weight_share) {
    const pairs_histogram *self = state;
    ps_problem problem = self->pairs.problem;
    problem.weight_share = weight_share;
    return error_of(&self->layout, &problem, self->pairs.precision, mean_power);
}

/* ---- create and destroy ------------------------------------------------------------------ */

static void destroy(void *state) {
    pairs_histogram *self = state;
    ps_pairs_free(&self->pairs);
    PS_BUFFERS_RELEASE(&self->scale, &self->matrix, &self->nodes, &self->moments, &self->weights,
                       &self->node_partials);
}

static pspec_status create_kernels(pairs_histogram *self, ps_error *error) {
    const ps_defines defines = ps_pairs_defines(&self->pairs);
    ps_device *const device = self->pairs.device;
    PS_TRY(ps_kernel_get(device, &self->histogram_kernel, program, "pairs_histogram", defines.text,
                         error));
    PS_TRY(ps_kernel_get(device, &self->nodes_kernel, program, "pairs_nodes", defines.text, error));
    return ps_kernel_get(device, &self->sums_kernel, program, "pairs_nodes_sums", defines.text,
                         error);
}

static pspec_status upload_tables(pairs_histogram *self, ps_error *error) {
    const double sqrt2 = 1.4142135623730951;
    const double per_chord = (double)self->layout.num_bins / sqrt2;
    double matrix[PS_PAIRS_MOMENTS * PS_PAIRS_MOMENTS];
    void *nodes = NULL;
    PS_TRY(ps_reals_upload(self->pairs.device, &self->scale, self->pairs.precision, &per_chord, 1,
                           "the width of a bin", error));
    ps_pairs_bins_matrix(matrix);
    PS_TRY(ps_reals_upload(self->pairs.device, &self->matrix, self->pairs.precision, matrix,
                           sizeof matrix / sizeof matrix[0], "a table of cosines", error));
    PS_TRY(ps_allocate(&nodes, 2 * self->layout.num_nodes, sizeof(double), "nodes", error));
    ps_pairs_bins_nodes(self->layout.num_bins, nodes);
    const pspec_status status =
        ps_reals_upload(self->pairs.device, &self->nodes, self->pairs.precision, nodes,
                        2 * self->layout.num_nodes, "nodes", error);
    free(nodes);
    return status;
}

static pspec_status create_buffers(pairs_histogram *self, size_t batch, ps_error *error) {
    const histogram_layout *layout = &self->layout;
    const size_t histogram = (size_t)layout->histogram_bytes;
    const ps_wanted_buffer wanted[] = {
        {&self->pairs.partials, batch * layout->pairs.slab * histogram,
         "histograms of runs of pairs"},
        {&self->moments, batch * PS_PAIRS_PARTS * histogram, "histograms"},
        {&self->weights, batch * histogram, "weights of nodes"},
        {&self->node_partials, batch * layout->node_runs * (size_t)layout->pairs.row_bytes,
         "sums of runs of nodes"}};
    return PS_BUFFERS_CREATE(self->pairs.device, wanted, error);
}

static pspec_status create(void *state, const ps_problem *problem, ps_precision precision,
                           size_t batch, ps_device *device, ps_error *error) {
    pairs_histogram *const self = state;
    self->layout = make_layout(problem, ps_device_get_limits(device), precision);
    self->bound = ps_pairs_bins_bound(problem->frequencies->max_frequency, self->layout.num_bins);
    PS_TRY(ps_pairs_create(&self->pairs, program, problem, precision, &self->layout.pairs, batch,
                           device, error));
    PS_TRY(create_kernels(self, error));
    PS_TRY(upload_tables(self, error));
    return create_buffers(self, batch, error);
}

/* ---- run --------------------------------------------------------------------------------- */

static pspec_status add_slab(void *state, size_t num_patterns, uint64_t first, size_t num_runs,
                             ps_error *error) {
    const pairs_histogram *self = state;
    const ps_pairs_state *pairs = &self->pairs;
    const histogram_layout *layout = &self->layout;
    const double flops_per_pair = 40; /* counted in the source */
    const double flops_per_number = 6;
    const double rows = (double)(num_runs * num_patterns);
    const double num_pairs = rows * (double)(layout->pairs.run_vectors * layout->pairs.lanes);
    const ps_range range = {.rank = 3,
                            .global = {num_runs, num_patterns, 1},
                            .local = {1, 1, 1},
                            .flops = flops_per_pair * num_pairs};
    const ps_range fold = ps_range_heavy(
        pairs->device, layout->num_nodes / layout->pairs.lanes, num_patterns, 1,
        flops_per_number * rows * (double)layout->num_nodes, rows * layout->histogram_bytes);
    PS_TRY(PS_LAUNCH(pairs->device, self->histogram_kernel, &range, error,
                     PS_BUFFER(pairs->points.filled), PS_BUFFER(pairs->counts),
                     PS_BUFFER(pairs->partials), PS_U64(layout->pairs.stride), PS_U64(first),
                     PS_U64(layout->pairs.run_vectors), PS_U32(layout->num_bins),
                     PS_BUFFER(self->scale)));
    return PS_LAUNCH(pairs->device, pairs->fold, &fold, error, PS_BUFFER(pairs->partials),
                     PS_BUFFER(self->moments), PS_U64(num_runs), PS_U32(layout->num_nodes),
                     PS_U32(1), PS_U32(first == 0));
}

/* Legendre sums from the histograms. */
static pspec_status sum_nodes(pairs_histogram *self, size_t num_patterns, ps_error *error) {
    const histogram_layout *layout = &self->layout;
    const double flops_per_degree = 6;
    const double numbers = (double)(layout->num_nodes * num_patterns);
    const ps_range nodes = ps_range_heavy(self->pairs.device, 2 * layout->num_bins, num_patterns, 1,
                                          2 * PS_PAIRS_MOMENTS * numbers,
                                          4 * layout->histogram_bytes * (double)num_patterns);
    const ps_range range = {.rank = 3,
                            .global = {layout->node_runs, num_patterns, 1},
                            .local = {1, 1, 1},
                            .flops =
                                flops_per_degree * numbers * (double)layout->pairs.num_degrees};
    PS_TRY(PS_LAUNCH(self->pairs.device, self->nodes_kernel, &nodes, error,
                     PS_BUFFER(self->moments), PS_BUFFER(self->matrix), PS_BUFFER(self->weights),
                     PS_U64(2 * layout->num_bins), PS_U64(layout->num_nodes)));
    PS_TRY(PS_LAUNCH(self->pairs.device, self->sums_kernel, &range, error, PS_BUFFER(self->nodes),
                     PS_BUFFER(self->weights), PS_BUFFER(self->pairs.inverses),
                     PS_BUFFER(self->node_partials), PS_U64(layout->num_nodes),
                     PS_U32(layout->pairs.num_degrees)));
    return ps_pairs_fold(&self->pairs, &self->node_partials, num_patterns, layout->node_runs, true,
                         error);
}

static pspec_status run(void *state, const ps_batch *batch, ps_rows *rows, ps_error *error) {
    PS_TRY(ps_pairs_run(state, batch, add_slab, error));
    PS_TRY(sum_nodes(state, batch->num_patterns, error));
    return ps_pairs_read(state, batch, rows, error);
}

static void describe(const void *state, ps_text *text) {
    const pairs_histogram *self = state;
    ps_text_append(text,
                   "(pairs_histogram precision=%s lanes=%u bins=2x%zu moments=%d bound=%.2g%s)",
                   ps_precision_name(self->pairs.precision), self->pairs.layout.lanes,
                   self->layout.num_bins, PS_PAIRS_MOMENTS, self->bound,
                   self->pairs.problem.frequencies->degree_step == 2 ? " even" : "");
}

const ps_engine ps_pairs_histogram = {
    .name = "pairs_histogram",
    .domains = PS_ON_SPHERE,
    .needs_device = true,
    .rows_on_host = true,
    .sums_pairs = true,
    .has_precision = {true, true, false},
    .survey = survey,
    .error_of_state = error_of_state,
    .state_bytes = sizeof(pairs_histogram),
    .create = create,
    .run = run,
    .describe = describe,
    .destroy = destroy,
};
