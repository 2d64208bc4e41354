/* The kernels of the sphere on their own: small sets, a chunk of several, every number of lanes. */
#include "harness_kernels.h"
#include "harness_sphere.h"

#include "engines/host/host_direct.h"
#include "engines/sphere/sphere_points.h"
#include "engines/sphere/sphere_layout.h"
#include "math/pi.h"
#include "sphere/sums.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { REALIZATIONS = 2, MAX_DEGREE = 19, STRIDE = 32, SUMS = 4, ARRAYS = 6, CHUNK = 32 };

static ps_device *device;
static uint64_t seed = 12;

typedef struct sphere_case {
    unsigned precision, lanes;
    bool only_even;
    size_t first_order, num_orders; /* of a pass */
    size_t items;                   /* of a work-group */
} sphere_case;

/* Points padded to whole vectors of 16; the second realization has three chunks. */
typedef struct sphere_data {
    size_t sizes[REALIZATIONS], begins[REALIZATIONS], capacity;
    double *points, *weights;
} sphere_data;

static sphere_data make_data(void) {
    sphere_data data = {.sizes = {13, 75}, .begins = {0, 16}, .capacity = 96};
    data.points = test_sphere_white_set(data.capacity, &seed);
    data.weights = calloc(data.capacity, sizeof(double));
    for (size_t r = 0; r < REALIZATIONS; r++) {
        for (size_t j = 0; j < data.sizes[r]; j++) {
            data.weights[data.begins[r] + j] = test_uniform(&seed) - 0.3;
        }
    }
    test_sphere_point(data.points, 0, 0, 1); /* poles, and sines whose powers underflow */
    test_sphere_point(data.points + 3, 0, 0, -1);
    test_sphere_point(data.points + 6, 1e-9, 1, 1);
    test_sphere_point(data.points + 9, 1e-3, 2, -1);
    test_sphere_point(data.points + 51, 1e-5, 3, 1);
    return data;
}

/* What prepare makes: on the device where it can, and the same on the host. */
static void prepare(const sphere_case *one, const sphere_data *data, test_memory *values,
                    test_memory *turns) {
    const size_t num = data->capacity;
    const size_t real_bytes = one->precision / 8;
    void *host = calloc(num * ARRAYS, real_bytes);
    uint64_t *host_turns = calloc(num, sizeof *host_turns);
    ps_sphere_prepare(data->points, num, one->only_even,
                      one->precision == 32 ? PS_SINGLE : PS_DOUBLE, num, host, host_turns);
    *values = test_memory_create(device, host, num * ARRAYS * real_bytes);
    *turns = test_memory_create(device, host_turns, num * sizeof *host_turns);
    if (ps_device_get_limits(device)->has_fp64) {
        const unsigned lanes = one->lanes > 8 ? 8 : one->lanes;
        ps_kernel *kernel = test_kernel(device, "sphere/prepare.cl", "sphere_prepare",
                                        "-DLANES=%u -DOUT_PRECISION=%u -DONLY_EVEN=%d", lanes,
                                        one->precision, one->only_even);
        test_memory points = test_memory_create(device, data->points, num * 3 * sizeof(double));
        test_memory made = test_memory_create(device, NULL, num * ARRAYS * real_bytes);
        test_memory made_turns = test_memory_create(device, NULL, num * sizeof(uint64_t));
        TEST_LAUNCH(device, kernel, 4, num / lanes, 1, 1, PS_BUFFER(points.buffer),
                    PS_BUFFER(made.buffer), PS_BUFFER(made_turns.buffer), PS_U64(num / lanes),
                    PS_U64(num));
        double *got = test_reals_read(&made, one->precision);
        double *expected = test_reals_read(values, one->precision);
        for (size_t i = 0; i < num * ARRAYS; i++) {
            const double allowed = one->precision == 32 ? 1.2e-7 : 4.5e-16; /* one unit */
            assert_true(fabs(got[i] - expected[i]) <= allowed * fmax(fabs(expected[i]), 1e-9));
        }
        test_memory_free_unchanged(&points);
        test_memory_free(&made);
        test_memory_free(&made_turns);
        free(got);
        free(expected);
    }
    free(host);
    free(host_turns);
}

static test_memory make_table(const sphere_case *one, test_memory *blocks) {
    uint32_t offsets[MAX_DEGREE + 1];
    const size_t num =
        ps_sphere_all_blocks(MAX_DEGREE, (int32_t)one->first_order, one->num_orders, offsets);
    double *table = calloc(num, PS_SPHERE_BLOCK_REALS * sizeof *table);
    long double constant = sqrtl(1 / PS_FOUR_PI_L);
    for (size_t m = 0; m < one->first_order + one->num_orders; m++) {
        constant = m > 0 ? ps_sphere_next_constant(constant, (int32_t)m) : constant;
        if (m >= one->first_order) {
            ps_sphere_fill_order(table +
                                     offsets[m - one->first_order] * (size_t)PS_SPHERE_BLOCK_REALS,
                                 MAX_DEGREE, (int32_t)m, constant);
        }
    }
    *blocks = test_memory_create(device, offsets, one->num_orders * sizeof *offsets);
    test_memory memory =
        test_reals_create(device, one->precision, table, num * PS_SPHERE_BLOCK_REALS);
    free(table);
    return memory;
}

static void check_sums(const sphere_case *one, const sphere_data *data, const double *sums) {
    const double allowed = one->precision == 32 ? 2e-5 : 4e-14;
    for (size_t r = 0; r < REALIZATIONS; r++) {
        const pspec_pattern pattern = {3, data->sizes[r], data->points + 3 * data->begins[r],
                                       data->weights + data->begins[r]};
        for (int32_t l = 0; l <= MAX_DEGREE; l += one->only_even ? 2 : 1) {
            ps_host_degree exact;
            assert_ok(ps_host_degree_create(&exact, l, error));
            ps_host_degree_sum(&exact, &pattern);
            for (size_t i = 0; i < one->num_orders && (int32_t)(one->first_order + i) <= l; i++) {
                const double *row = sums + (r * one->num_orders + i) * SUMS * STRIDE + l;
                for (size_t part = 0; part < 2; part++) {
                    const double got = row[part * STRIDE] + row[(part + 2) * STRIDE];
                    assert_true(fabs(got - (double)exact.sums[one->first_order + i][part]) <=
                                allowed);
                }
            }
            ps_host_degree_free(&exact);
        }
    }
}

static void check_powers(const sphere_case *one, const double *sums, const double *powers) {
    for (size_t r = 0; r < REALIZATIONS; r++) {
        for (size_t l = 0; l <= MAX_DEGREE; l += one->only_even ? 2 : 1) {
            double expected = one->first_order > 0 ? 1 : 0; /* what the pass before left */
            for (size_t i = 0; i < one->num_orders && one->first_order + i <= l; i++) {
                const double *row = sums + (r * one->num_orders + i) * SUMS * STRIDE + l;
                const double re = row[0] + row[2 * STRIDE];
                const double im = row[STRIDE] + row[3 * STRIDE];
                expected += (re * re + im * im) * (one->first_order + i == 0 ? 0.5 : 1);
            }
            const double *got = powers + r * 2 * STRIDE + l;
            const double allowed = one->precision == 32 ? 1e-6 : 1e-14;
            assert_true(fabs(got[0] + got[STRIDE] - expected) <= allowed * expected);
        }
    }
}

static void run_power(const sphere_case *one, const test_memory *sums_memory, const double *sums) {
    double begun[REALIZATIONS * 2 * STRIDE] = {0};
    for (size_t i = 0; i < (size_t)REALIZATIONS * 2 * STRIDE; i++) {
        begun[i] = i / STRIDE % 2 == 0;
    }
    ps_kernel *kernel = test_kernel(device, "sphere/power.cl", "sphere_power",
                                    "-DPRECISION=%u -DLANES=%u", one->precision, one->lanes);
    for (size_t g = 0; g < 2; g++) {
        test_memory powers =
            test_reals_create(device, one->precision, begun, (size_t)REALIZATIONS * 2 * STRIDE);
        TEST_LAUNCH(device, kernel, g == 0 ? 1 : 4, STRIDE / one->lanes, REALIZATIONS, 1,
                    PS_BUFFER(sums_memory->buffer), PS_BUFFER(powers.buffer),
                    PS_U32(one->first_order), PS_U32(one->num_orders), PS_U32(MAX_DEGREE),
                    PS_U64(STRIDE), PS_U32(1));
        double *got = test_reals_read(&powers, one->precision);
        check_powers(one, sums, got);
        free(got);
        test_memory_free(&powers);
    }
}

static void check_case(const sphere_case *one) {
    if (!test_has_precision(device, one->precision)) {
        return;
    }
    enum { ORDERS = 3 };
    sphere_data data = make_data();
    test_memory values, turns, blocks;
    prepare(one, &data, &values, &turns);
    test_memory table = make_table(one, &blocks);
    test_memory weights = test_reals_create(device, one->precision, data.weights, data.capacity);
    const uint64_t ends[] = {0, 16 / one->lanes, 96 / one->lanes};
    test_memory offsets = test_memory_create(device, ends, sizeof ends);
    const size_t num_sums = REALIZATIONS * one->num_orders * SUMS * STRIDE;
    test_memory sums = test_reals_create(device, one->precision, NULL, num_sums);
    const size_t items = one->items;
    const ps_range range = {
        .rank = 3,
        .global = {(one->num_orders + ORDERS - 1) / ORDERS * items, REALIZATIONS, 1},
        .local = {items, 1, 1}};
    ps_kernel *kernel =
        test_kernel(device, "sphere/sums.cl", "sphere_sums",
                    "-DPRECISION=%u -DLANES=%u -DCHUNK=%d -DJOBS=%zu -DORDERS=%d -DONLY_EVEN=%d",
                    one->precision, one->lanes, CHUNK, items, ORDERS, one->only_even);
    const sums_numbers numbers = {.stride = STRIDE,
                                  .capacity = data.capacity,
                                  .first_order = (uint32_t)one->first_order,
                                  .num_orders = (uint32_t)one->num_orders,
                                  .max_degree = MAX_DEGREE,
                                  .has_low = 1,
                                  .is_first = 1};
    assert_ok(PS_LAUNCH(device, kernel, &range, error, PS_STRUCT(numbers), PS_BUFFER(values.buffer),
                        PS_BUFFER(turns.buffer), PS_BUFFER(weights.buffer),
                        PS_BUFFER(offsets.buffer), PS_BUFFER(table.buffer),
                        PS_BUFFER(blocks.buffer), PS_BUFFER(sums.buffer)));
    double *got = test_reals_read(&sums, one->precision);
    check_sums(one, &data, got);
    run_power(one, &sums, got);
    free(got);
    test_memory_free_unchanged(&values);
    test_memory_free_unchanged(&turns);
    test_memory_free_unchanged(&blocks);
    test_memory_free_unchanged(&table);
    test_memory_free_unchanged(&weights);
    test_memory_free_unchanged(&offsets);
    test_memory_free(&sums);
    free(data.points);
    free(data.weights);
}

static void single(void **state) {
    (void)state;
    check_case(&(sphere_case){32, 16, false, 0, 20, 1});
    check_case(&(sphere_case){32, 4, false, 8, 7, 1});
    check_case(&(sphere_case){32, 16, true, 0, 20, 1});
    check_case(&(sphere_case){32, 1, false, 0, 5, 1});
    check_case(&(sphere_case){32, 4, false, 3, 9, 64});
}

static void double_precision(void **state) {
    (void)state;
    check_case(&(sphere_case){64, 8, false, 0, 20, 1});
    check_case(&(sphere_case){64, 2, true, 5, 15, 1});
    check_case(&(sphere_case){64, 4, false, 0, 20, 64});
    check_case(&(sphere_case){64, 1, true, 2, 11, 16});
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(single),
                                       cmocka_unit_test(double_precision)};
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("kernels_sphere", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
