/* The kernels of pairs on their own: small sets, several runs, every number of lanes. */
#include "harness_kernels.h"
#include "harness_pairs.h"

#include "engines/pairs/pairs_bins.h"
#include "engines/pairs/pairs_state.h"

#include <math.h>
#include <stdlib.h>

enum { SETS = 2, LAST = 16, CHUNK = 2, RUN = 2, MOST = 23, ARRAYS = 8 };

static ps_device *device;
static uint64_t seed = 12;
static const size_t sizes[SETS] = {
    9, MOST}; /* odd ones: no round of pairs counts half; and then even ones */

typedef struct pairs_case {
    unsigned precision, lanes;
    size_t fewer; /* points */
} pairs_case;

typedef struct pairs_data {
    size_t stride;
    pspec_pattern patterns[SETS];
    double *points[SETS], *weights[SETS];
    test_memory on_device, counts;
} pairs_data;

/* What pairs_points.c makes, without low parts: exact in double precision, and near enough for
 * these tests. */
static pairs_data make_data(const pairs_case *one) {
    pairs_data data = {.stride = ps_pairs_stride(MOST, one->lanes)};
    double *host = calloc(SETS * ARRAYS * data.stride, sizeof(double));
    uint64_t counts[SETS];
    for (size_t r = 0; r < SETS; r++) {
        const size_t num = counts[r] = sizes[r] - one->fewer;
        data.points[r] = test_sphere_white_set(num, &seed);
        data.weights[r] = calloc(num, sizeof(double));
        for (size_t at = 0; at < ps_pairs_stride(num, one->lanes); at++) {
            double *to = host + r * ARRAYS * data.stride + at;
            const size_t j = at % num;
            data.weights[r][j] = at < num ? test_uniform(&seed) - 0.3 : data.weights[r][j];
            for (size_t axis = 0; axis < 3; axis++) {
                to[axis * data.stride] = data.points[r][3 * j + axis];
            }
            to[6 * data.stride] = data.weights[r][j];
            to[7 * data.stride] = at < num ? data.weights[r][j] : 0;
        }
        data.patterns[r] = (pspec_pattern){3, num, data.points[r], data.weights[r]};
    }
    data.on_device = test_reals_create(device, one->precision, host, SETS * ARRAYS * data.stride);
    data.counts = test_memory_create(device, counts, sizeof counts);
    free(host);
    return data;
}

static void free_data(pairs_data *data) {
    test_memory_free_unchanged(&data->on_device);
    test_memory_free_unchanged(&data->counts);
    for (size_t r = 0; r < SETS; r++) {
        free(data->points[r]);
        free(data->weights[r]);
    }
}

static test_memory make_inverses(const pairs_case *one) {
    double inverses[LAST];
    for (int l = 1; l <= LAST; l++) {
        inverses[l - 1] = 1.0 / l;
    }
    return test_reals_create(device, one->precision, inverses, LAST);
}

/* Groups of so many work-items, as the kernels want them. */
#define LAUNCH_GROUPS(kernel, items, first, ...)                                                   \
    do {                                                                                           \
        const ps_range groups = {                                                                  \
            .rank = 3, .global = {(first) * (items), SETS, 1}, .local = {(items), 1, 1}};          \
        assert_ok(PS_LAUNCH(device, (kernel), &groups, error, __VA_ARGS__));                       \
    } while (0)
#define LAUNCH_ALONE(kernel, first, ...) LAUNCH_GROUPS(kernel, 1, first, __VA_ARGS__)

/* Sums over runs [set][num_runs][2][LAST] against long double, the diagonal added. */
static void check_sums(const pairs_case *one, const pairs_data *data, const double *sums,
                       size_t num_runs, double limit) {
    for (size_t r = 0; r < SETS; r++) {
        const pspec_pattern *set = &data->patterns[r];
        const double size = test_weight_sizes(set);
        long double *exact = test_pair_sums(set, LAST);
        double diagonal = 0;
        for (size_t j = 0; j < set->num_points; j++) {
            diagonal += set->weights[j] * set->weights[j];
        }
        for (size_t l = 1; l <= LAST; l++) {
            double sum = 0;
            for (size_t run = 0; run < num_runs; run++) {
                const double *row = sums + (r * num_runs + run) * 2 * LAST;
                sum += row[l - 1] + row[LAST + l - 1];
            }
            const double off = fabs(diagonal + 2 * sum - (double)exact[l]) / (size * size);
            if (!(off <= limit)) {
                fail_msg("precision %u lanes %u, degree %zu is off by %g", one->precision,
                         one->lanes, l, off);
            }
        }
        free(exact);
    }
}

static double limit_of(const pairs_case *one) {
    return one->precision == 32 ? 1e-6 : 2e-15;
}

static size_t count_runs(const pairs_case *one, size_t run) {
    return (ps_pairs_vectors(MOST - one->fewer, one->lanes) + run - 1) / run;
}

/* Of a run by a work-item, or by a work-group, in a round or in two. */
static void check_runs(const pairs_case *one, const char *file, const char *name, size_t items,
                       size_t run) {
    const size_t num_runs = count_runs(one, run);
    pairs_data data = make_data(one);
    test_memory inverses = make_inverses(one);
    test_memory partials =
        test_reals_create(device, one->precision, NULL, SETS * num_runs * 2 * LAST);
    ps_kernel *kernel =
        test_kernel(device, file, name, "-DPRECISION=%u -DLANES=%u -DCHUNK=%d -DONLY_EVEN=0",
                    one->precision, one->lanes, CHUNK);
    LAUNCH_GROUPS(kernel, items, num_runs, PS_BUFFER(data.on_device.buffer),
                  PS_BUFFER(data.counts.buffer), PS_BUFFER(inverses.buffer),
                  PS_BUFFER(partials.buffer), PS_U64(data.stride), PS_U64(0), PS_U32(LAST),
                  PS_U64(run));
    double *sums = test_reals_read(&partials, one->precision);
    check_sums(one, &data, sums, num_runs, limit_of(one));
    free(sums);
    test_memory_free(&partials);
    test_memory_free_unchanged(&inverses);
    free_data(&data);
}

static void check_pair_sums(const pairs_case *one) {
    enum { ITEMS = 64, ROUND = 2 * ITEMS };
    check_runs(one, "pairs/sums.cl", "pairs_sums", 1, CHUNK * RUN);
    check_runs(one, "pairs/sums_shared.cl", "pairs_sums_shared", ITEMS, ROUND);
    check_runs(one, "pairs/sums_shared.cl", "pairs_sums_shared", ITEMS, 2 * ROUND);
}

/* Of the program that pairs_histogram has, with a run of so many chunks. */
static ps_kernel *chain_kernel(const pairs_case *one, const char *name, int run) {
    return test_kernel(device, "pairs/histogram.cl", name,
                       "-DPRECISION=%u -DLANES=%u -DCHUNK=64 -DRUN=%d", one->precision, one->lanes,
                       run);
}

/* From pairs to moments to nodes to sums. */
static void check_histogram(const pairs_case *one) {
    enum { BINS = 24, NODES = 2 * BINS * PS_PAIRS_MOMENTS, RUN_VECTORS = 1000 };
    const double per_chord = BINS / sqrt(2);
    double matrix[PS_PAIRS_MOMENTS * PS_PAIRS_MOMENTS];
    double nodes[2 * NODES];
    pairs_data data = make_data(one);
    ps_pairs_bins_matrix(matrix);
    ps_pairs_bins_nodes(BINS, nodes);
    test_memory inverses = make_inverses(one);
    test_memory scale = test_reals_create(device, one->precision, &per_chord, 1);
    test_memory table =
        test_reals_create(device, one->precision, matrix, PS_PAIRS_MOMENTS * PS_PAIRS_MOMENTS);
    test_memory places = test_reals_create(device, one->precision, nodes, 2 * NODES);
    test_memory histograms = test_reals_create(device, one->precision, NULL, SETS * NODES);
    test_memory moments = test_reals_create(device, one->precision, NULL, SETS * 2 * NODES);
    test_memory weights = test_reals_create(device, one->precision, NULL, SETS * NODES);
    test_memory partials = test_reals_create(device, one->precision, NULL, SETS * 2 * LAST);
    ps_kernel *histogram = chain_kernel(one, "pairs_histogram", NODES);
    ps_kernel *fold = chain_kernel(one, "pairs_fold", NODES);
    ps_kernel *to_nodes = chain_kernel(one, "pairs_nodes", NODES);
    ps_kernel *sum = chain_kernel(one, "pairs_nodes_sums", NODES);
    LAUNCH_ALONE(histogram, 1, PS_BUFFER(data.on_device.buffer), PS_BUFFER(data.counts.buffer),
                 PS_BUFFER(histograms.buffer), PS_U64(data.stride), PS_U64(0), PS_U64(RUN_VECTORS),
                 PS_U32(BINS), PS_BUFFER(scale.buffer));
    TEST_LAUNCH(device, fold, 4, NODES / one->lanes, SETS, 1, PS_BUFFER(histograms.buffer),
                PS_BUFFER(moments.buffer), PS_U64(1), PS_U32(NODES), PS_U32(1), PS_U32(1));
    TEST_LAUNCH(device, to_nodes, 4, 2 * BINS, SETS, 1, PS_BUFFER(moments.buffer),
                PS_BUFFER(table.buffer), PS_BUFFER(weights.buffer), PS_U64(2 * BINS),
                PS_U64(NODES));
    LAUNCH_ALONE(sum, 1, PS_BUFFER(places.buffer), PS_BUFFER(weights.buffer),
                 PS_BUFFER(inverses.buffer), PS_BUFFER(partials.buffer), PS_U64(NODES),
                 PS_U32(LAST));
    double *sums = test_reals_read(&partials, one->precision);
    check_sums(one, &data, sums, 1, ps_pairs_bins_bound(LAST, BINS) + 5 * limit_of(one));
    free(sums);
    test_memory *const made[] = {&histograms, &moments, &weights, &partials};
    test_memory *const given[] = {&inverses, &scale, &table, &places};
    for (size_t i = 0; i < 4; i++) {
        test_memory_free(made[i]);
        test_memory_free_unchanged(given[i]);
    }
    free_data(&data);
}

static void check_all(void (*check)(const pairs_case *one)) {
    for (unsigned precision = 32; precision <= 64; precision += 32) {
        for (unsigned lanes = 1; lanes <= 16 && test_has_precision(device, precision); lanes *= 2) {
            for (size_t fewer = 0; fewer < 2; fewer++) {
                const pairs_case one = {precision, lanes, fewer};
                check(&one);
            }
        }
    }
}

static void pair_sums(void **state) {
    (void)state;
    check_all(check_pair_sums);
}

static void histograms(void **state) {
    (void)state;
    check_all(check_histogram);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(pair_sums), cmocka_unit_test(histograms)};
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("kernels_pairs", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
