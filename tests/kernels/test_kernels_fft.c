/* nufft/transform/fft.h alone: every length without prime factors above 7 up to MOST, and large
 * ones, against
 * long double sums, each lane with numbers of its own; impulses; work-groups of one item and of
 * several, equal to the bit; tables of plans.
 *
 * Errors of random data, root mean square in units of that of the result, stay below u (units_once
 * + units_per_pass * passes), u = 2^-24 or 2^-53.
 */
#include "harness_kernels.h"

#include "engines/nufft/fft.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double units_once = 0.4;
static const double units_per_pass = 0.6;

static ps_device *device;
static bool is_simulated; /* by Oclgrind: a thousand times slower */
static uint64_t seed = 11;

typedef struct build {
    unsigned precision, lanes;
    size_t group; /* work-items, besides one */
    bool is_simulated;
} build;

static const build builds[] = {{32, 16, 32, false}, {32, 8, 3, false},  {32, 4, 5, true},
                               {32, 1, 32, false},  {64, 8, 32, false}, {64, 4, 3, false},
                               {64, 1, 3, true}};
enum { NUM_BUILDS = sizeof builds / sizeof builds[0], NUM_GROUPS = 2 };

static bool does_run(const build *one) {
    return test_has_precision(device, one->precision) && (!is_simulated || one->is_simulated);
}

static size_t local_bytes_of(const build *one, uint32_t length) {
    return (size_t)length * 2 * one->lanes * one->precision / 8;
}

static bool fits(const build *one, uint32_t length) {
    return local_bytes_of(one, length) <= ps_device_get_limits(device)->local_bytes;
}

/* As launches of engines do, where the device allows fewer. */
static size_t group_of(size_t wanted) {
    const size_t most = ps_device_get_limits(device)->max_work_group_size;
    return wanted < most ? wanted : most;
}

/* ---- transforms -------------------------------------------------------------------------- */

/* data, result: [NUM_GROUPS][length][re, im][lanes] */
static double *transform(const build *one, ps_kernel *kernel, uint32_t length, const double *data,
                         size_t group) {
    const size_t num = (size_t)NUM_GROUPS * length * 2 * one->lanes;
    ps_fft_plan plan = {0};
    assert_ok(ps_fft_plan_create(&plan, length, one->precision == 64 ? PS_DOUBLE : PS_SINGLE,
                                 device, error));
    test_memory memory = test_reals_create(device, one->precision, data, num);
    test_memory result = test_reals_create(device, one->precision, NULL, num);
    TEST_LAUNCH(device, kernel, group, group, NUM_GROUPS, 1, PS_BUFFER(memory.buffer),
                PS_BUFFER(result.buffer), PS_U32(length), PS_BUFFER(plan.radices),
                PS_BUFFER(plan.twiddles), PS_BUFFER(plan.position),
                PS_LOCAL(local_bytes_of(one, length)));
    double *found = test_reals_read(&result, one->precision);
    test_memory_free_unchanged(&memory);
    test_memory_free(&result);
    ps_fft_plan_free(&plan);
    return found;
}

static ps_kernel *make_kernel(const build *one) {
    return test_kernel(device, "probe/fft.cl", "probe_fft", "-DPRECISION=%u -DLANES=%u",
                       one->precision, one->lanes);
}

/* exp(-2 pi i t / length) */
static long double *make_roots(uint32_t length) {
    long double *roots = malloc((size_t)length * 2 * sizeof *roots);
    for (uint32_t t = 0; t < length; t++) {
        roots[2 * t] = cosl(PS_TWO_PI_L * t / length);
        roots[2 * t + 1] = -sinl(PS_TWO_PI_L * t / length);
    }
    return roots;
}

/* Sum over cells of one lane, at frequency k. */
static void direct_sum(const double *data, const long double *roots, uint32_t length,
                       unsigned lanes, uint32_t k, long double sum[2]) {
    sum[0] = sum[1] = 0;
    for (uint32_t j = 0; j < length; j++) {
        const long double *root = roots + (uint64_t)j * k % length * 2;
        const long double re = data[(size_t)2 * j * lanes];
        const long double im = data[((size_t)2 * j + 1) * lanes];
        sum[0] += re * root[0] - im * root[1];
        sum[1] += re * root[1] + im * root[0];
    }
}

static unsigned passes_of(uint32_t length) {
    uint32_t radices[PS_FFT_MAX_PASSES];
    unsigned passes = 0;
    assert_true(ps_fft_radices(length, radices));
    while (radices[passes] != 0) {
        passes++;
    }
    return passes;
}

/* Relative, at `some` frequencies of all. */
static double error_of(const build *one, uint32_t length, const double *data, const double *found) {
    const uint32_t some = 16;
    const size_t row = (size_t)2 * one->lanes;
    const uint32_t step = length > some ? length / some : 1;
    long double *roots = make_roots(length);
    double error = 0;
    double size = 0;
    for (uint32_t k = 0; k < length; k += step) {
        for (size_t lane = 0; lane < (size_t)NUM_GROUPS * one->lanes; lane++) {
            const size_t first = lane / one->lanes * length * row + lane % one->lanes;
            const double *at = found + first + k * row;
            long double sum[2];
            direct_sum(data + first, roots, length, one->lanes, k, sum);
            error += (double)(powl(at[0] - sum[0], 2) + powl(at[one->lanes] - sum[1], 2));
            size += (double)(sum[0] * sum[0] + sum[1] * sum[1]);
        }
    }
    free(roots);
    return sqrt(error / size);
}

/* The bound divided by the error; the same bits from a group of several. */
static double check_length(const build *one, ps_kernel *kernel, uint32_t length) {
    const double unit = one->precision == 64 ? 0x1p-53 : 0x1p-24;
    const size_t num = (size_t)NUM_GROUPS * length * 2 * one->lanes;
    double *data = test_whole_numbers(&seed, num, 1000);
    double *found = transform(one, kernel, length, data, 1);
    double *shared = transform(one, kernel, length, data, group_of(one->group));
    const double bound = unit * (units_once + units_per_pass * passes_of(length));
    const double error = error_of(one, length, data, found);
    if (!(error <= bound)) {
        fail_msg("length %u precision %u lanes %u: error %.2e bound %.2e", length, one->precision,
                 one->lanes, error, bound);
    }
    assert_memory_equal(found, shared, num * sizeof(double));
    free(data);
    free(found);
    free(shared);
    return error > 0 ? bound / error : HUGE_VAL; /* length 1 is exact */
}

/* Every length up to `most`, and the large ones; what the device has no room for is left out.
 * Returns how many lengths ran. */
static unsigned check_lengths(const build *one, uint32_t most) {
    static const uint32_t large[] = {1280, 1536, 1715, 2000, 2048, 2401, 2560, 3125, 4096, 6561};
    const uint32_t num_large = is_simulated ? 0 : sizeof large / sizeof large[0];
    ps_kernel *kernel = make_kernel(one);
    double smallest = HUGE_VAL;
    unsigned num = 0;
    unsigned num_fitting = 0;
    uint32_t length = 1;
    for (uint32_t i = 0; i < num_large || length <= most; num++) {
        const uint32_t n = length <= most ? length : large[i++];
        length = length <= most ? ps_fft_length((uint64_t)length + 1) : length;
        if (fits(one, n)) {
            smallest = fmin(smallest, check_length(one, kernel, n));
            num_fitting++;
        }
    }
    print_message("precision %u, %2u lanes: smallest slack %.2f\n", one->precision, one->lanes,
                  smallest);
    if (num_fitting < num) {
        print_message("left out: %u of %u lengths, for local memory of %llu bytes\n",
                      num - num_fitting, num,
                      (unsigned long long)ps_device_get_limits(device)->local_bytes);
    }
    return num_fitting;
}

static void lengths(void **state) {
    (void)state;
    for (size_t b = 0; b < NUM_BUILDS; b++) {
        if (does_run(&builds[b])) {
            assert_true(check_lengths(&builds[b], is_simulated ? 16 : 512) > 0);
        }
    }
}

/* Room for length 10 and no more, as a GPU with 48 KiB has it for 384 (8 lanes of doubles). */
static void lengths_of_small_devices(void **state) {
    (void)state;
    const build one = {32, 4, 5, true};
    ps_device_set_local_bytes(device, local_bytes_of(&one, 10));
    assert_int_equal(check_lengths(&one, 16), 10);
    ps_device_set_local_bytes(device, 0);
}

/* A one in every cell in turn: a wave of constant size in its lane, zeros in every other one. */
static void impulses(void **state) {
    (void)state;
    static const uint32_t some[] = {7, 30, 42, 64, 126};
    const build one = {32, 4, 1, true};
    const size_t row = (size_t)2 * one.lanes;
    ps_kernel *kernel = make_kernel(&one);
    for (size_t i = 0; i < (is_simulated ? 2 : sizeof some / sizeof some[0]); i++) {
        const uint32_t length = some[i];
        const double allowed = 0x1p-24 * 1.5 * passes_of(length); /* measured 1.1 */
        long double *roots = make_roots(length);
        for (uint32_t place = 0; place < length; place += is_simulated ? 4 : 1) {
            double *data = calloc(NUM_GROUPS * length * row, sizeof(double));
            const unsigned lane = place % one.lanes;
            data[place * row + lane] = 1;
            double *found = transform(&one, kernel, length, data, 1);
            for (size_t at = 0; at < NUM_GROUPS * length * row; at++) {
                if (at >= length * row || at % one.lanes != lane) {
                    assert_true(found[at] == 0);
                    continue;
                }
                const size_t root = at / row * place % length * 2 + at / one.lanes % 2;
                assert_true(fabs(found[at] - (double)roots[root]) < allowed);
            }
            free(data);
            free(found);
        }
        free(roots);
    }
}

/* Numbers of one lane change nothing in the others, whatever they are. */
static void lanes_apart(void **state) {
    (void)state;
    enum { LENGTH = 30, LANE = 2 };
    const build one = {32, 4, 1, true};
    const size_t num = (size_t)NUM_GROUPS * LENGTH * 2 * one.lanes;
    ps_kernel *kernel = make_kernel(&one);
    double *data = test_whole_numbers(&seed, num, 1000);
    double *found = transform(&one, kernel, LENGTH, data, 1);
    for (size_t i = LANE; i < num; i += one.lanes) {
        data[i] = i % 3 == 0 ? NAN : 1e30;
    }
    double *other = transform(&one, kernel, LENGTH, data, 1);
    for (size_t i = 0; i < num; i++) {
        assert_true(i % one.lanes == LANE || memcmp(&found[i], &other[i], sizeof(double)) == 0);
    }
    free(data);
    free(found);
    free(other);
}

/* ---- plans ------------------------------------------------------------------------------- */

static void lengths_there_are(void **state) {
    (void)state;
    uint32_t radices[PS_FFT_MAX_PASSES];
    assert_int_equal(ps_fft_length(0), 1);
    assert_int_equal(ps_fft_length(11), 12);
    assert_int_equal(ps_fft_length(13), 14);
    assert_int_equal(ps_fft_length(1025), 1029);
    assert_int_equal(ps_fft_length(UINT32_MAX), 0);
    assert_false(ps_fft_radices(11, radices));
    assert_false(ps_fft_radices(0, radices));
    assert_false(ps_fft_radices(UINT32_MAX, radices));
    assert_true(ps_fft_radices(0x80000000, radices));
    assert_true(isinf(ps_fft_flops(11)));
    assert_true(ps_fft_flops(1024) < 5 * 1024 * 10); /* no more than textbooks count */
    for (uint32_t n = 1; n < 3000; n++) {
        uint32_t rest = n;
        for (uint32_t p = 2; p < 8; p++) {
            while (rest % p == 0) {
                rest /= p;
            }
        }
        assert_true(ps_fft_radices(n, radices) == (rest == 1));
        assert_true((ps_fft_length(n) == n) == (rest == 1));
    }
}

/* No length from `least` to a quarter beyond the next one is cheaper than the good one. */
static void good_lengths(void **state) {
    (void)state;
    for (uint32_t least = 1; least < 3000; least += least < 100 ? 1 : 37) {
        const uint32_t good = ps_fft_good_length(least);
        assert_true(good >= least && ps_fft_length(good) == good);
        const uint32_t last = ps_fft_length(least) * 5 / 4;
        assert_true(good <= last);
        for (uint32_t n = ps_fft_length(least); n <= last; n = ps_fft_length((uint64_t)n + 1)) {
            assert_true(ps_fft_cycles(n) >= ps_fft_cycles(good));
        }
    }
    assert_int_equal(ps_fft_good_length(UINT32_MAX), 0);
}

/* Radices multiply to the length; positions are a permutation. */
static void positions(void **state) {
    (void)state;
    enum { MOST = 1000 };
    for (uint32_t n = 1; n < MOST; n = ps_fft_length((uint64_t)n + 1)) {
        uint32_t radices[PS_FFT_MAX_PASSES];
        bool is_taken[MOST] = {false};
        uint32_t product = 1;
        assert_true(ps_fft_radices(n, radices));
        for (const uint32_t *radix = radices; *radix != 0; radix++) {
            product *= *radix;
        }
        assert_int_equal(product, n);
        for (uint32_t k = 0; k < n; k++) {
            const uint32_t position = ps_fft_position(n, radices, k);
            assert_true(position < n && !is_taken[position]);
            is_taken[position] = true;
        }
    }
}

/* As nufft/transform/fft.h reads them: [pass][t][j - 1] of a transform of the length that is left,
 * each correctly rounded (or nearly, where long double decides a tie). */
static void check_twiddles(uint32_t length) {
    uint32_t radices[PS_FFT_MAX_PASSES];
    ps_fft_plan plan = {0};
    assert_ok(ps_fft_plan_create(&plan, length, PS_DOUBLE, device, error));
    double *found = malloc(plan.twiddles.bytes + 1);
    assert_ok(ps_buffer_read(device, &plan.twiddles, 0, found, plan.twiddles.bytes, error));
    assert_true(ps_fft_radices(length, radices));
    size_t at = 0;
    uint32_t whole = length;
    for (const uint32_t *radix = radices; *radix != 0; whole /= *radix, radix++) {
        long double *roots = make_roots(whole);
        for (uint32_t t = 0; t < whole / *radix; t++) {
            for (uint32_t j = 1; j < *radix; j++, at += 2) {
                assert_true(fabsl(found[at] - roots[2 * t * j]) < 0x1p-54L * 1.01L);
                assert_true(fabsl(found[at + 1] - roots[2 * t * j + 1]) < 0x1p-54L * 1.01L);
            }
        }
        free(roots);
    }
    assert_true(plan.twiddles.bytes == at * sizeof(double));
    free(found);
    ps_fft_plan_free(&plan);
}

static void twiddles(void **state) {
    (void)state;
    static const uint32_t some[] = {2, 7, 8, 60, 105, 128, 343, 1000, 2048};
    for (size_t i = 0; i < sizeof some / sizeof some[0]; i++) {
        check_twiddles(some[i]);
    }
    ps_fft_plan plan = {0};
    ps_error failure = {0};
    assert_int_equal(ps_fft_plan_create(&plan, 22, PS_SINGLE, device, &failure),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    ps_fft_plan_free(&plan);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lengths_there_are), cmocka_unit_test(good_lengths),
        cmocka_unit_test(positions),         cmocka_unit_test(twiddles),
        cmocka_unit_test(lanes_apart),       cmocka_unit_test(impulses),
        cmocka_unit_test(lengths),           cmocka_unit_test(lengths_of_small_devices),
    };
    device = test_open_device();
    is_simulated = strcmp(ps_device_get_limits(device)->platform, "Oclgrind") == 0;
    const int failures = cmocka_run_group_tests_name("kernels_fft", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
