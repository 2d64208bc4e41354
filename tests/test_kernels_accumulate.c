/* accumulate/modes.cl and bins.cl alone, with whole numbers chosen so that every sum is exact in a
 * pair and beyond the reach of one number: results must be equal, not near.
 */
#include "harness_kernels.h"

#include <math.h>
#include <stdlib.h>

__extension__ typedef __int128 wide;

static ps_device *device;
static uint64_t seed = 5;

/* lanes 0 stands for the device's own. */
typedef struct build {
    unsigned precision, lanes;
    size_t num_groups; /* how many work-group sizes */
} build;

static const build builds[] = {{32, 0, 3}, {64, 0, 1}, {32, 1, 1}, {64, 4, 1}};

static void for_all_builds(void (*check)(const build *)) {
    for (size_t i = 0; i < sizeof builds / sizeof builds[0]; i++) {
        build one = builds[i];
        if (one.lanes == 0) {
            one.lanes = ps_engine_lanes(ps_device_get_limits(device),
                                        one.precision == 64 ? PS_DOUBLE : PS_SINGLE);
        }
        if (test_has_precision(device, one.precision)) {
            check(&one);
        }
    }
}

/* ---- modes ------------------------------------------------------------------------------- */

/* Squares that need a pair themselves, and low parts that stay exact. */
static double largest_power(unsigned precision) {
    return precision == 64 ? 0x1p32 : 0x1p16;
}

static void check_state(const build *one, const test_memory *sums, size_t stride,
                        const double *power, size_t num_rows) {
    double *found = test_reals_read(sums, one->precision);
    for (size_t i = 0; i < stride; i++) {
        wide sum = 0, squares = 0;
        for (size_t r = 0; r < num_rows; r++) {
            const int64_t p = (int64_t)power[r * stride + i];
            sum += p;
            squares += (wide)p * p;
        }
        assert_true((wide)found[i] + (wide)found[stride + i] == sum);
        assert_true((wide)found[2 * stride + i] + (wide)found[3 * stride + i] == squares);
    }
    free(found);
}

static void launch_modes(const build *one, cl_kernel kernel, size_t group, const double *power,
                         size_t num_rows, size_t stride, const test_memory *sums) {
    test_memory rows = test_reals_create(device, one->precision, power, num_rows * stride);
    TEST_LAUNCH(device, kernel, group, stride / one->lanes, 1, 1, PS_BUFFER(rows.buffer),
                PS_BUFFER(sums->buffer), PS_U32(num_rows), PS_U64(stride));
    test_memory_free_unchanged(&rows);
}

/* Batches of 7, 0, 1 and 32 realizations, one after the other. */
static void check_modes(const build *one) {
    const size_t batches[] = {7, 0, 1, 32}, tiles[] = {1, 2, 5, 67};
    cl_kernel kernel = test_kernel(device, "accumulate/modes.cl", "accumulate_modes",
                                   "-DPRECISION=%u -DLANES=%u", one->precision, one->lanes);
    for (size_t t = 0; t < 4; t++) {
        const size_t stride = tiles[t] * one->lanes;
        double *power = test_whole_numbers(&seed, 40 * stride, largest_power(one->precision));
        double *zeros = calloc(4 * stride, sizeof *zeros);
        for (size_t g = 0; g < one->num_groups; g++) {
            test_memory sums = test_reals_create(device, one->precision, zeros, 4 * stride);
            size_t done = 0;
            for (size_t b = 0; b < 4; b++) {
                launch_modes(one, kernel, test_group_sizes[g], power + done * stride, batches[b],
                             stride, &sums);
                done += batches[b];
                check_state(one, &sums, stride, power, done);
            }
            test_memory_free(&sums);
        }
        free(zeros);
        free(power);
    }
    clReleaseKernel(kernel);
}

static void modes(void **state) {
    (void)state;
    for_all_builds(check_modes);
}

/* ---- bins -------------------------------------------------------------------------------- */

/* Pieces of bins: two pieces, one, none at all, one of a single member, five. */
enum { BINS = 5, PIECES = 9, MEMBERS = 101, STRIDE_TILES = 3, GROUPS = 2 };
static const uint32_t pieces[PIECES][2] = {{0, 16},  {16, 20}, {20, 37}, {37, 38}, {38, 54},
                                           {54, 70}, {70, 86}, {86, 86}, {86, 101}};
static const uint32_t bins[BINS][2] = {{0, 2}, {2, 3}, {3, 3}, {3, 4}, {4, 9}};

/* members: slots in any order, some of them twice. */
static void make_members(uint32_t members[MEMBERS], size_t stride) {
    for (size_t i = 0; i < MEMBERS; i++) {
        members[i] = (uint32_t)(test_uniform(&seed) * (double)stride);
    }
}

/* Sum over members[begin .. end - 1] of the row of one lane of a group. */
static int64_t sum_members(const double *power, const uint32_t *members, size_t row, size_t stride,
                           size_t begin, size_t end) {
    int64_t sum = 0;
    for (size_t i = begin; i < end; i++) {
        sum += (int64_t)power[row * stride + members[i]];
    }
    return sum;
}

static void check_pairs(const build *one, const test_memory *sums, size_t num,
                        const uint32_t (*ranges)[2], const double *power, const uint32_t *members,
                        size_t stride) {
    double *found = test_reals_read(sums, one->precision);
    for (size_t i = 0; i < GROUPS * num * one->lanes; i++) {
        const size_t lane = i % one->lanes, entry = i / one->lanes % num;
        const size_t row = i / one->lanes / num * one->lanes + lane;
        const double *pair = found + i / one->lanes * 2 * one->lanes + lane;
        const int64_t sum =
            sum_members(power, members, row, stride, ranges[entry][0], ranges[entry][1]);
        assert_true(isfinite(pair[0]) && isfinite(pair[one->lanes]));
        assert_true((int64_t)pair[0] + (int64_t)pair[one->lanes] == sum);
    }
    free(found);
}

static void launch_bins(const build *one, size_t group, const double *power,
                        const uint32_t *members, size_t stride) {
    cl_kernel first = test_kernel(device, "accumulate/bins.cl", "accumulate_bin_pieces",
                                  "-DPRECISION=%u -DLANES=%u", one->precision, one->lanes);
    cl_kernel second = test_kernel(device, "accumulate/bins.cl", "accumulate_bin_fold",
                                   "-DPRECISION=%u -DLANES=%u", one->precision, one->lanes);
    const size_t entry = 2 * one->lanes;
    test_memory rows =
        test_reals_create(device, one->precision, power, GROUPS * one->lanes * stride);
    test_memory slots = test_memory_create(device, members, MEMBERS * sizeof *members);
    test_memory ranges = test_memory_create(device, pieces, sizeof pieces);
    test_memory bin_ranges = test_memory_create(device, bins, sizeof bins);
    test_memory sums = test_reals_create(device, one->precision, NULL, GROUPS * PIECES * entry);
    test_memory result = test_reals_create(device, one->precision, NULL, GROUPS * BINS * entry);
    TEST_LAUNCH(device, first, group, PIECES, GROUPS, 1, PS_BUFFER(rows.buffer),
                PS_BUFFER(slots.buffer), PS_BUFFER(ranges.buffer), PS_BUFFER(sums.buffer),
                PS_U64(PIECES), PS_U64(stride));
    TEST_LAUNCH(device, second, group, BINS, GROUPS, 1, PS_BUFFER(sums.buffer),
                PS_BUFFER(bin_ranges.buffer), PS_BUFFER(result.buffer), PS_U64(BINS),
                PS_U64(PIECES));
    uint32_t bin_members[BINS][2];
    for (size_t b = 0; b < BINS; b++) {
        const bool is_empty = bins[b][0] == bins[b][1];
        bin_members[b][0] = is_empty ? 0 : pieces[bins[b][0]][0];
        bin_members[b][1] = is_empty ? 0 : pieces[bins[b][1] - 1][1];
    }
    check_pairs(one, &sums, PIECES, pieces, power, members, stride);
    check_pairs(one, &result, BINS, (const uint32_t(*)[2])bin_members, power, members, stride);
    test_memory_free_unchanged(&rows);
    test_memory_free_unchanged(&slots);
    test_memory_free_unchanged(&ranges);
    test_memory_free_unchanged(&bin_ranges);
    test_memory_free(&sums);
    test_memory_free(&result);
    clReleaseKernel(first);
    clReleaseKernel(second);
}

static void check_bins(const build *one) {
    const size_t stride = STRIDE_TILES * one->lanes;
    uint32_t members[MEMBERS];
    make_members(members, stride);
    double *power = test_whole_numbers(&seed, GROUPS * one->lanes * stride,
                                       one->precision == 64 ? 0x1p53 : 0x1p24);
    for (size_t g = 0; g < one->num_groups; g++) {
        launch_bins(one, test_group_sizes[g], power, members, stride);
    }
    free(power);
}

static void bins_of_pieces(void **state) {
    (void)state;
    for_all_builds(check_bins);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(modes),
        cmocka_unit_test(bins_of_pieces),
    };
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("kernels_accumulate", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
