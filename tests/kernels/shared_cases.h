/* The headers that host and device share, compiled as C with PRECISION 32 or 64 (test_shared_*.c),
 * against exact integers and long double; then the same on the device.
 */
#ifndef PRECISION
#error "define PRECISION first"
#endif

#include "harness_kernels.h"

#include <float.h>
#include <stdlib.h>

#include "math/pi.h"
#include "shared/pair.h"
#include "shared/turn.h"

__extension__ typedef __int128 wide;

/* Largest absolute errors of the cosine and the sine. Measured: 1.77e-7 over all words (float),
 * 3.70e-16 over 1e8 random ones (double). */
#if PRECISION == 64
static const long double turn_limit = 4e-16L;
static const double epsilon = DBL_EPSILON;
#else
static const long double turn_limit = 1.8e-7L;
static const double epsilon = FLT_EPSILON;
#endif

static ps_device *device; /* NULL: none, or not of this precision */
static uint64_t seed = 20;

static word random_word(void) {
    const uint64_t high = (uint64_t)(test_uniform(&seed) * 0x1p32);
    return (word)(high << 32 | (uint64_t)(test_uniform(&seed) * 0x1p32));
}

/* x as a multiple of 2^-scale, which it must be, or the difference to the nearest below. */
static wide to_wide(long double x, int scale) {
    int exponent = 0;
    const int64_t mantissa = (int64_t)ldexpl(frexpl(x, &exponent), 63);
    const int shift = exponent - 63 + scale;
    return shift >= 0 ? (wide)mantissa * ((wide)1 << shift) : (wide)mantissa / ((wide)1 << -shift);
}

/* ---- turn.h ------------------------------------------------------------------------------ */

static void check_turn(word u) {
    const long double angle = PS_TWO_PI_L * ldexpl((long double)u, -PRECISION);
    real cosine = 0, sine = 0;
    turn_cosine_sine(u, &cosine, &sine);
    const long double cosine_error = fabsl((long double)cosine - cosl(angle));
    const long double sine_error = fabsl((long double)sine - sinl(angle));
    if (!(cosine_error <= turn_limit && sine_error <= turn_limit)) {
        fail_msg("turn %llu / 2^%d: errors %.3Lg and %.3Lg", (unsigned long long)u, PRECISION,
                 cosine_error, sine_error);
    }
}

static void turn_is_within_its_limits(void **state) {
    (void)state;
    for (word eighth = 0; eighth < 8; eighth++) {
        const word centre = eighth * (TURN_QUARTER / 2);
        for (word i = 0; i < 1000; i++) {
            check_turn(centre + i);
            check_turn(centre - i);
        }
    }
    for (int bit = 0; bit < PRECISION; bit++) {
        check_turn((word)1 << bit);
        check_turn(~((word)1 << bit));
    }
    for (int i = 0; i < 1000000; i++) {
        check_turn(random_word());
    }
}

/* Reduction by half turns and even and odd polynomials: these hold to the last bit. */
static void turn_is_symmetric(void **state) {
    (void)state;
    for (int i = 0; i < 100000; i++) {
        const word u = i < 8 ? (word)i * (TURN_QUARTER / 2) : random_word();
        real c[3], s[3];
        turn_cosine_sine(u, &c[0], &s[0]);
        turn_cosine_sine(u + TURN_HALF, &c[1], &s[1]);
        turn_cosine_sine((word)0 - u, &c[2], &s[2]);
        assert_true(c[1] == -c[0] && s[1] == -s[0]);
        if ((word)(u << 1) != TURN_HALF) { /* -1/2 and 1/2 are the same r */
            assert_true(c[2] == c[0] && s[2] == -s[0]);
        }
    }
}

static void turn_of_nothing_is_exact(void **state) {
    (void)state;
    real cosine = 0, sine = 1;
    turn_cosine_sine(0, &cosine, &sine);
    assert_true(cosine == 1 && sine == 0);
    turn_cosine_sine(TURN_HALF, &cosine, &sine);
    assert_true(cosine == -1 && sine == 0);
}

/* ---- pair.h ------------------------------------------------------------------------------ */

static real random_real(int exponent_range) {
    const int exponent = (int)(test_uniform(&seed) * (2 * exponent_range + 1)) - exponent_range;
    return (real)ldexp(2 * test_uniform(&seed) - 1, exponent);
}

static void one_addition_is_exact(void **state) {
    (void)state;
    enum { RANGE = 16, SCALE = 88 }; /* test_uniform has 53 bits, the product of ranges 32 */
    for (int i = 0; i < 100000; i++) {
        const real a = random_real(RANGE), b = random_real(RANGE);
        real high = a, low = 0;
        pair_add(&high, &low, b);
        assert_true(high == (real)(a + b));
        assert_true(to_wide(high, SCALE) + to_wide(low, SCALE) ==
                    to_wide(a, SCALE) + to_wide(b, SCALE));
    }
}

static void one_square_is_exact(void **state) {
    (void)state;
    enum { SCALE = 106 };
    for (int i = 0; i < 100000; i++) {
        const real x = (real)(1 + test_uniform(&seed));
        real high = 0, low = 0;
        pair_add_square(&high, &low, x);
        const wide root = to_wide(x, SCALE / 2);
        assert_true(high == x * x);
        assert_true(to_wide(high, SCALE) + to_wide(low, SCALE) == root * root);
    }
}

static void cancellation_leaves_what_is_small(void **state) {
    (void)state;
    const real tiny = (real)ldexp(1, PRECISION == 64 ? -90 : -45);
    real high = 0, low = 0;
    pair_add(&high, &low, 1);
    pair_add(&high, &low, tiny);
    pair_add(&high, &low, -1);
    assert_true(high + low == tiny);
    high = low = 0; /* and when the larger one comes later */
    pair_add(&high, &low, tiny);
    pair_add(&high, &low, 1);
    pair_add(&high, &low, -1);
    assert_true(high + low == tiny);
}

/* Whole numbers whose sum needs more digits than `real` has: exact, in any order. */
static void whole_numbers_add_exactly(void **state) {
    (void)state;
    const double largest = PRECISION == 64 ? 0x1p50 : 0x1p22;
    real high = 0, low = 0, square = 0, square_low = 0;
    wide sum = 0, sum_squares = 0;
    for (int i = 0; i < 20000; i++) {
        const real x = (real)rint(test_uniform(&seed) * largest);
        pair_add(&high, &low, x);
        sum += (wide)x;
        pair_add_square(&square, &square_low, (real)rint((double)x / 1024));
        sum_squares += (wide)rint((double)x / 1024) * (wide)rint((double)x / 1024);
    }
    assert_true((wide)high + (wide)low == sum);
    assert_true((wide)square + (wide)square_low == sum_squares);
    assert_true((wide)high != sum); /* one number would not have been enough */
}

/* A million terms of every size. The error, 8 eps^2 (float) and 1 eps^2 (double) here, comes from
 * rounding in the low part; a plain sum is off by 1e6 times that. */
static void a_million_terms(void **state) {
    (void)state;
    enum { TERMS = 1000000, RANGE = 8, SCALE = 80 };
    real high = 0, low = 0;
    double sizes = 0;
    wide sum = 0;
    for (int i = 0; i < TERMS; i++) {
        const real x = random_real(RANGE);
        pair_add(&high, &low, x);
        sum += to_wide(x, SCALE);
        sizes += fabs((double)x);
    }
    const wide difference = to_wide(high, SCALE) + to_wide(low, SCALE) - sum;
    const double error = fabs(ldexp((double)difference, -SCALE));
    if (!(error <= 64 * epsilon * epsilon * sizes)) {
        fail_msg("error %.3g of %.3g, %.3g units of eps^2", error, sizes,
                 error / sizes / epsilon / epsilon);
    }
}

/* ---- the same on the device -------------------------------------------------------------- */

enum { DEVICE_WORDS = 8 * 125 };

static unsigned device_lanes(void) {
    if (device == NULL) {
        skip();
    }
    return ps_engine_lanes(ps_device_get_limits(device), PRECISION == 64 ? PS_DOUBLE : PS_SINGLE);
}

/* Every operation in turn.h is correctly rounded in C and in OpenCL C: equal to the last bit. */
static void device_turns_equal_host_turns(void **state) {
    (void)state;
    const unsigned lanes = device_lanes();
    const size_t num = DEVICE_WORDS / lanes * lanes;
    word words[DEVICE_WORDS];
    for (size_t i = 0; i < DEVICE_WORDS; i++) {
        words[i] = i < 24 ? (word)i / 3 * (TURN_QUARTER / 2) + (word)(i % 3) - 1 : random_word();
    }
    ps_kernel *kernel = test_kernel(device, "probe/turn.cl", "probe_turn",
                                    "-DPRECISION=%d -DLANES=%u", PRECISION, lanes);
    for (size_t g = 0; g < 3; g++) {
        test_memory in = test_memory_create(device, words, num * sizeof(word));
        test_memory cosine = test_reals_create(device, PRECISION, NULL, num);
        test_memory sine = test_reals_create(device, PRECISION, NULL, num);
        TEST_LAUNCH(device, kernel, TEST_GROUP_SIZES[g], num / lanes, 1, 1, PS_BUFFER(in.buffer),
                    PS_BUFFER(cosine.buffer), PS_BUFFER(sine.buffer), PS_U64(num));
        real *const c = test_memory_read(&cosine), *const s = test_memory_read(&sine);
        for (size_t i = 0; i < num; i++) {
            real host_c = 0, host_s = 0;
            turn_cosine_sine(words[i], &host_c, &host_s);
            assert_true(c[i] == host_c && s[i] == host_s);
        }
        free(c);
        free(s);
        test_memory_free_unchanged(&in);
        test_memory_free(&cosine);
        test_memory_free(&sine);
    }
}

#include "phase_cases.h"
#include "two_to_cases.h"

static ps_device *open_if_there_is_one(void) {
    ps_device *opened = NULL;
    ps_error error = {0};
    const pspec_status status = ps_device_open(&opened, getenv("POINTSPEC_DEVICE"), false, &error);
    if (status == PSPEC_OK && !test_has_precision(opened, PRECISION)) {
        ps_device_close(opened);
        return NULL;
    }
    return opened;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(turn_is_within_its_limits),
        cmocka_unit_test(turn_is_symmetric),
        cmocka_unit_test(turn_of_nothing_is_exact),
        cmocka_unit_test(one_addition_is_exact),
        cmocka_unit_test(one_square_is_exact),
        cmocka_unit_test(cancellation_leaves_what_is_small),
        cmocka_unit_test(whole_numbers_add_exactly),
        cmocka_unit_test(a_million_terms),
        cmocka_unit_test(powers_of_two_are_within_a_unit),
        cmocka_unit_test(powers_below_the_least_are_that),
        cmocka_unit_test(phases_are_exact),
        cmocka_unit_test(device_turns_equal_host_turns),
        cmocka_unit_test(device_powers_equal_host_powers),
        cmocka_unit_test(device_phases_equal_host_phases),
    };
    device = open_if_there_is_one();
    const int failures = cmocka_run_group_tests_name(
        PRECISION == 64 ? "shared_double" : "shared_single", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
