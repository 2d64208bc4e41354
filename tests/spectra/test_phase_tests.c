/* Rayleigh's test against Kluyver's integral, its rate of false alarms against what was asked for,
 * and the sums of products of the sphere against their definition. */
#include "harness.h"

#include "math/gauss_legendre.h"
#include "math/pi.h"
#include "math/random/random.h"
#include "spectra/phases/phase_tests.h"
#include "spectra/phases/turn_products.h"

#include <gsl/gsl_sf_bessel.h>
#include <gsl/gsl_sf_legendre.h>

#include <math.h>
#include <stdlib.h>

static void assert_near(double found, double expected, double tolerance) {
    if (!(fabs(found - expected) <= tolerance)) {
        fail_msg("%.17g instead of %.17g", found, expected);
    }
}

/* ---- probabilities ------------------------------------------------------------------------- */

/* P(sum of num random unit vectors is longer than length), by Kluyver:
 * 1 - length int_0^inf J_1(length t) J_0(t)^num dt, by the rule of trapezoids and the terms of
 * Euler and Maclaurin at t = 0. */
static double kluyver(unsigned num, double length) {
    const double step = 2e-3;
    const double end = 400; /* J_0^num < (2 / pi t)^(num / 2) */
    const double first = length / 2;
    const double third = -6 * (pow(length, 3) / 16 + length * num / 8);
    double sum = 0;
    for (double t = step; t < end; t += step) {
        sum += gsl_sf_bessel_J1(length * t) * pow(gsl_sf_bessel_J0(t), num);
    }
    return 1 - length * (step * sum + step * step / 12 * first - pow(step, 4) / 720 * third);
}

static void probabilities_of_resultants(void **state) {
    (void)state;
    const double rounding = 1e-10; /* of the integral */
    static const unsigned nums[] = {8, 10, 16, 32, 128};
    for (size_t i = 0; i < sizeof nums / sizeof nums[0]; i++) {
        for (double z = 0.25; z < 18 && z < nums[i]; z += 1.5) {
            const double length = sqrt(z * nums[i]);
            const double exact = kluyver(nums[i], length);
            const double found = ps_rayleigh_p_value(nums[i], length / nums[i]);
            if (exact > 1.003 * found + rounding) {
                fail_msg("num %u, z %g: %g is less than %g", nums[i], z, found, exact);
            }
            if (nums[i] >= 32 && z < 12 && found > 1.06 * exact + rounding) {
                fail_msg("num %u, z %g: %g is much more than %g", nums[i], z, found, exact);
            }
        }
    }
    assert_near(ps_rayleigh_p_value(7, 1), 1, 0);
    assert_near(ps_rayleigh_p_value(100, 0), 1, 0);
}

static void least_realizations(void **state) {
    (void)state;
    for (size_t num_tests = 1; num_tests < 1000000; num_tests *= 10) {
        const uint64_t least = ps_phase_tests_least(num_tests, 1e-3);
        assert_true(ps_rayleigh_p_value(least, 1) * (double)num_tests <= 1e-3);
        assert_true(ps_rayleigh_p_value(least - 1, 1) * (double)num_tests > 1e-3);
    }
}

/* Phases of one quantity are those of the others turned: as dependent as can be. */
static void false_alarms_and_findings(void **state) {
    (void)state;
    enum { NUM_TESTS = 50, NUM_SETS = 40, NUM_CHECKS = 2000 };
    const double rate = 0.05;
    ps_random random = ps_random_init(5, 0, 0);
    int alarms = 0;
    for (int check = 0; check < NUM_CHECKS; check++) {
        ps_phase_test tests[NUM_TESTS] = {{0}};
        for (int r = 0; r < NUM_SETS; r++) {
            for (int i = 0; i < NUM_TESTS; i++) {
                const double angle = PS_TWO_PI * ps_random_uniform(&random);
                ps_phase_test_add(&tests[i], (double[2]){3 * cos(angle), 3 * sin(angle)}, 1);
            }
        }
        assert_ok(ps_phase_tests_judge(tests, NUM_TESTS, rate, error));
        int num = 0;
        for (int i = 0; i < NUM_TESTS; i++) {
            assert_int_equal(tests[i].num, NUM_SETS);
            assert_true(tests[i].differs == (tests[i].adjusted_p_value <= rate));
            assert_true(tests[i].adjusted_p_value >= tests[i].p_value);
            num += tests[i].differs;
        }
        alarms += num > 0;
    }
    /* at most the rate and four standard deviations; not much fewer, for they are independent */
    assert_true(alarms < NUM_CHECKS * rate + 4 * sqrt(NUM_CHECKS * rate));
    assert_true(alarms > NUM_CHECKS * rate - 4 * sqrt(NUM_CHECKS * rate));
    /* half of the phases equal, one quantity with rounding between its values */
    ps_phase_test tests[3] = {{0}};
    for (int r = 0; r < NUM_SETS; r++) {
        const double angle = PS_TWO_PI * ps_random_uniform(&random);
        ps_phase_test_add(&tests[0], (double[2]){cos(angle), sin(angle)}, 0);
        ps_phase_test_add(&tests[1], (double[2]){r % 2 == 0 ? 1 : cos(angle), 0}, 1e-9);
        ps_phase_test_add(&tests[1], (double[2]){1e-10, 0}, 1e-9); /* rounding */
    }
    ps_phase_test_add(&tests[2], (double[2]){1, 0}, 0); /* one phase */
    assert_ok(ps_phase_tests_judge(tests, 3, 1e-3, error));
    assert_int_equal(tests[1].num, NUM_SETS);
    assert_true(!tests[0].differs && tests[1].differs);
    /* what has no phases does not count */
    assert_near(tests[1].adjusted_p_value, 2 * tests[1].p_value, 0);
    assert_true(!tests[2].differs && tests[2].adjusted_p_value >= 1);
}

/* ---- products of the sphere ---------------------------------------------------------------- */

enum { DEGREE = 7, NUM = (DEGREE + 1) * (DEGREE + 2) };

static size_t place_of(int l, int m) {
    return (size_t)(m * (2 * DEGREE + 1 - m) / 2 + l);
}

/* c_lm, l > 0, at a point. */
static double field(const double *c, double z, double phi) {
    double sum = 0;
    for (int l = 1; l <= DEGREE / 2; l++) {
        sum += c[2 * place_of(l, 0)] * gsl_sf_legendre_sphPlm(l, 0, z);
        for (int m = 1; m <= l; m++) {
            const double *const value = c + 2 * place_of(l, m);
            sum += 2 * gsl_sf_legendre_sphPlm(l, m, z) *
                   (value[0] * cos(m * phi) + value[1] * sin(m * phi));
        }
    }
    return sum;
}

/* Integrals of f^2 Y_lm by a rule of twice the nodes. */
static void integrate(const double *c, int l, int m, double out[2]) {
    enum { NODES = 2 * DEGREE + 2, AZIMUTHS = 4 * DEGREE };
    double nodes[NODES];
    double weights[NODES];
    ps_gauss_legendre(NODES, nodes, weights);
    out[0] = out[1] = 0;
    for (int i = 0; i < NODES; i++) {
        const double z = 2 * nodes[i] - 1;
        for (int j = 0; j < AZIMUTHS; j++) {
            const double phi = PS_TWO_PI * j / AZIMUTHS;
            const double f = field(c, z, phi);
            const double weight =
                2 * PS_TWO_PI * weights[i] / AZIMUTHS * f * f * gsl_sf_legendre_sphPlm(l, m, z);
            out[0] += weight * cos(m * phi);
            out[1] += weight * sin(m * phi);
        }
    }
}

/* Several sets at a time give what each gives alone. */
static void products_of_turns(void **state) {
    (void)state;
    enum { SETS = 3 };
    static double c[SETS * NUM];
    static double together[SETS * NUM];
    static double alone[NUM];
    ps_random random = ps_random_init(11, 0, 0);
    ps_turn_products *products = NULL;
    for (int i = 0; i < SETS * NUM; i++) {
        c[i] = ps_random_uniform(&random) - 0.5;
    }
    for (int r = 0; r < SETS; r++) {
        for (int l = 0; l <= DEGREE; l++) {
            c[r * NUM + 2 * (int)place_of(l, 0) + 1] = 0;
        }
    }
    assert_ok(ps_turn_products_create(&products, DEGREE, error));
    ps_turn_products_run(products, SETS, c, together);
    for (int r = 0; r < SETS; r++) {
        ps_turn_products_run(products, 1, c + r * NUM, alone);
        assert_memory_equal(alone, together + r * NUM, sizeof alone);
        for (int l = 0; l <= DEGREE; l++) {
            for (int m = 0; m <= l; m++) {
                double expected[2];
                integrate(c + r * NUM, l, m, expected);
                assert_near(alone[2 * place_of(l, m)], expected[0], 1e-13);
                assert_near(alone[2 * place_of(l, m) + 1], expected[1], 1e-13);
            }
        }
    }
    ps_turn_products_destroy(products);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(probabilities_of_resultants),
        cmocka_unit_test(least_realizations),
        cmocka_unit_test(false_alarms_and_findings),
        cmocka_unit_test(products_of_turns),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
