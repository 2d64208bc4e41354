/* shared/two_to.h, on the host and on the device: a part of shared_cases.h. */

#define SERIES_STEP(sum, x, next) fma(sum, x, next) /* as on devices */
#include "shared/two_to.h"

static void check_power(real t) {
    const long double exact = exp2l((long double)t);
    const real found = two_to(t);
    if (!(fabsl((long double)found - exact) < (long double)epsilon * exact)) {
        fail_msg("2^%.17g is off by %.3Lg units", (double)t,
                 ((long double)found - exact) / exact / (long double)epsilon);
    }
}

static real random_exponent(void) {
    return (real)((double)TWO_TO_LEAST * test_uniform(&seed) *
                  (test_uniform(&seed) < 0.5 ? 1 : 0.01));
}

static void powers_of_two_are_within_a_unit(void **state) {
    (void)state;
    for (int i = 0; i < 1000000; i++) {
        check_power(random_exponent());
        check_power((real)(2 * test_uniform(&seed))); /* of distances up to 4 */
    }
    for (int n = (int)TWO_TO_LEAST; n <= 100; n++) {
        assert_true(two_to((real)n) == (real)ldexp(1, n));
        check_power((real)n + (real)0.5);
        check_power((real)nextafter(n + 0.5, n));
    }
}

static void powers_below_the_least_are_that(void **state) {
    (void)state;
    const real least = two_to(TWO_TO_LEAST);
    const double t[4] = {1.0001 * (double)TWO_TO_LEAST, -2000, -1e30, -INFINITY};
    check_power(TWO_TO_LEAST);
    assert_true(least >= (PRECISION == 64 ? (real)DBL_MIN : (real)FLT_MIN));
    for (size_t i = 0; i < 4; i++) {
        assert_true(two_to((real)t[i]) == least);
    }
}

static void device_powers_equal_host_powers(void **state) {
    (void)state;
    const unsigned lanes = device_lanes();
    const size_t num = DEVICE_WORDS / lanes * lanes;
    real exponents[DEVICE_WORDS];
    for (size_t i = 0; i < num; i++) {
        exponents[i] = i < 100 ? (real)i / 2 - 100 : random_exponent() * (real)1.01;
    }
    ps_kernel *kernel = test_kernel(device, "probe/two_to.cl", "probe_two_to",
                                    "-DPRECISION=%d -DLANES=%u", PRECISION, lanes);
    test_memory in = test_memory_create(device, exponents, num * sizeof(real));
    test_memory out = test_reals_create(device, PRECISION, NULL, num);
    TEST_LAUNCH(device, kernel, 3, num / lanes, 1, 1, PS_BUFFER(in.buffer), PS_BUFFER(out.buffer),
                PS_U64(num));
    real *const powers = test_memory_read(&out);
    for (size_t i = 0; i < num; i++) {
        assert_true(powers[i] == two_to(exponents[i]));
    }
    free(powers);
    test_memory_free_unchanged(&in);
    test_memory_free(&out);
}
