/* accumulate/weighted.cl alone, with whole numbers chosen so that every sum is exact in a pair, and
 * neither products nor sums are in one number: results must be equal, not near.
 */
#include "harness_kernels.h"

#include "accumulate/blocks.h"
#include "base/round.h"
#include "spectra/accumulate/accumulate_device.h"

#include <math.h>
#include <stdlib.h>

static ps_device *device;
static uint64_t seed = 6;

/* lanes 0 stands for the device's own. */
typedef struct build {
    unsigned precision, lanes;
    size_t num_groups; /* how many work-group sizes */
} build;

static const build builds[] = {{32, 0, 3}, {64, 0, 1}, {32, 4, 3}, {32, 1, 1}, {64, 2, 1}};

/* Sums of this many weighted sums stand behind each other. */
enum { WEIGHTED = 2 };

typedef struct weighted_case {
    const build *one;
    size_t group, stride, num_rows;
    size_t num_blocks, num_groups; /* of slots; of realizations, of which the last is not full */
    const double *power;
    double *weights[WEIGHTED]; /* every third is 0 */
} weighted_case;

/* Powers where all weights are 0 are NaN, like what is left in padding. */
static test_memory weighted_powers(const weighted_case *with) {
    double *power = calloc(with->num_rows * with->stride, sizeof *power);
    for (size_t i = 0; i < with->num_rows * with->stride; i++) {
        power[i] = i % with->stride % 3 == 0 ? NAN : with->power[i];
    }
    const test_memory made =
        test_reals_create(device, with->one->precision, power, with->num_rows * with->stride);
    free(power);
    return made;
}

static void launch_weighted(const weighted_case *with, const test_memory *sums) {
    const build *one = with->one;
    ps_kernel *kernel = test_kernel(device, "accumulate/weighted.cl", "accumulate_weighted",
                                    "-DPRECISION=%u -DLANES=%u", one->precision, one->lanes);
    const blocks_numbers numbers = {.stride = with->stride,
                                    .num_pieces = with->num_blocks,
                                    .num_realizations = (uint32_t)with->num_rows};
    test_memory power = weighted_powers(with);
    for (size_t w = 0; w < WEIGHTED; w++) {
        test_memory weights =
            test_reals_create(device, one->precision, with->weights[w], with->stride);
        TEST_LAUNCH(device, kernel, with->group, with->num_blocks, with->num_groups, 1,
                    PS_STRUCT(numbers), PS_BUFFER(power.buffer), PS_BUFFER(weights.buffer),
                    PS_BUFFER(sums->buffer), PS_U64(w));
        test_memory_free_unchanged(&weights);
    }
    test_memory_free(&power);
}

static int64_t weigh_block(const weighted_case *with, size_t w, size_t row, size_t block) {
    int64_t sum = 0;
    const size_t begin = block * PS_ACCUMULATE_BLOCK;
    const size_t end =
        begin + PS_ACCUMULATE_BLOCK < with->stride ? begin + PS_ACCUMULATE_BLOCK : with->stride;
    for (size_t slot = begin; row < with->num_rows && slot < end; slot++) {
        sum += (int64_t)with->weights[w][slot] * (int64_t)with->power[row * with->stride + slot];
    }
    return sum;
}

static void check_weighted_sums(const weighted_case *with) {
    const size_t lanes = with->one->lanes;
    const size_t num_blocks = with->num_blocks;
    const size_t num_rows = with->num_groups * lanes;
    test_memory sums =
        test_reals_create(device, with->one->precision, NULL, WEIGHTED * num_blocks * num_rows * 2);
    launch_weighted(with, &sums);
    double *found = test_reals_read(&sums, with->one->precision);
    for (size_t i = 0; i < WEIGHTED * num_rows * num_blocks; i++) {
        const size_t w = i / num_blocks / num_rows, row = i / num_blocks % num_rows;
        const size_t block = i % num_blocks;
        const size_t entry = (w * num_rows / lanes + row / lanes) * num_blocks + block;
        const double *pair = found + entry * 2 * lanes + row % lanes;
        assert_true(isfinite(pair[0]) && isfinite(pair[lanes]));
        assert_true((int64_t)pair[0] + (int64_t)pair[lanes] == weigh_block(with, w, row, block));
    }
    free(found);
    test_memory_free(&sums);
}

static void check_case(weighted_case *with) {
    const bool is_double = with->one->precision == 64;
    const size_t num = with->num_rows * with->stride;
    double *power = test_whole_numbers(&seed, num, is_double ? 0x1p30 : 0x1p16);
    with->power = power;
    for (size_t w = 0; w < WEIGHTED; w++) {
        with->weights[w] = test_whole_numbers(&seed, with->stride, is_double ? 0x1p23 : 0x1p12);
        for (size_t slot = 0; slot < with->stride; slot += 3) {
            with->weights[w][slot] = 0;
        }
    }
    for (size_t g = 0; g < with->one->num_groups; g++) {
        with->group = TEST_GROUP_SIZES[g];
        check_weighted_sums(with);
    }
    for (size_t w = 0; w < WEIGHTED; w++) {
        free(with->weights[w]);
    }
    free(power);
}

/* Less than a block, a block, two and a part. */
static void check_build(const build *one) {
    const size_t strides[] = {one->lanes, 5 * one->lanes, PS_ACCUMULATE_BLOCK,
                              2 * PS_ACCUMULATE_BLOCK + 3 * one->lanes};
    for (size_t i = 0; i < sizeof strides / sizeof strides[0]; i++) {
        const size_t num_rows = one->lanes + (one->lanes + 1) / 2;
        weighted_case with = {.one = one,
                              .stride = strides[i],
                              .num_rows = num_rows,
                              .num_blocks = ps_divide_up(strides[i], PS_ACCUMULATE_BLOCK),
                              .num_groups = ps_divide_up(num_rows, one->lanes)};
        check_case(&with);
    }
}

static void weighted_sums(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof builds / sizeof builds[0]; i++) {
        build one = builds[i];
        if (one.lanes == 0) {
            one.lanes = ps_engine_lanes(ps_device_get_limits(device),
                                        one.precision == 64 ? PS_DOUBLE : PS_SINGLE);
        }
        if (test_has_precision(device, one.precision)) {
            check_build(&one);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(weighted_sums)};
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("kernels_weighted", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
