/* Turns and rotations: accuracy, orthogonality, uniformity over SO(3). */
#include "harness.h"

#include "math/pi.h"
#include "math/random/rotation.h"
#include "math/turns.h"

#include <math.h>

/* ---- turns --------------------------------------------------------------------------------- */

static void assert_angle(ps_turns angle, long double turns) {
    double cosine = 0;
    double sine = 0;
    ps_turns_cosine_sine(angle, &cosine, &sine);
    /* 2^-53 is a unit in the last place of numbers in [1/2, 1]; the largest error of 2e6 was 1.33.
     */
    const double allowed = 1.4 * 0x1p-53;
    assert_true(fabsl(cosine - cosl(PS_TWO_PI_L * turns)) <= allowed);
    assert_true(fabsl(sine - sinl(PS_TWO_PI_L * turns)) <= allowed);
}

static void turns_have_right_cosines_and_sines(void **state) {
    (void)state;
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, 0);
    for (unsigned i = 0; i < 20000; i++) {
        const double turns = ps_random_uniform(&random);
        const uint64_t fraction = ps_random_u64(&random);
        const double rest = (ps_random_uniform(&random) - 0.5) / 2;
        assert_angle(ps_turns_of(turns), turns);
        assert_angle(ps_turns_of_fraction(fraction), (long double)fraction * 0x1p-64L);
        assert_angle((ps_turns){i % 7, rest}, (i % 7) * 0.25L + rest);
    }
    for (unsigned i = 0; i <= 64; i++) { /* every edge between quadrants and octants */
        double cosine = 0;
        double sine = 0;
        ps_turns_cosine_sine(ps_turns_of(i / 64.0), &cosine, &sine);
        assert_true(i % 16 != 0 || fabs(cosine) + fabs(sine) == 1); /* quarters */
        assert_angle(ps_turns_of(i / 64.0), i / 64.0L);
        assert_angle(ps_turns_of(nextafter(i / 64.0, 0)), nextafter(i / 64.0, 0));
        assert_angle(ps_turns_of_fraction((uint64_t)i << 58), i / 64.0L);
        assert_angle(ps_turns_of_fraction(((uint64_t)i << 58) - 1), i / 64.0L - 0x1p-64L);
    }
}

/* Near a multiple of a quarter, what is small is right to its own last place. */
static void small_angles_keep_their_digits(void **state) {
    (void)state;
    for (unsigned quarter = 0; quarter < 4; quarter++) {
        double cosine = 0;
        double sine = 0;
        ps_turns_cosine_sine(ps_turns_of_fraction(((uint64_t)quarter << 62) + 3), &cosine, &sine);
        const double angle = (double)(3 * 0x1p-64L * PS_TWO_PI_L);
        const double small = quarter % 2 == 0 ? sine : cosine;
        assert_true(fabs(fabs(small) - angle) <= 0x1p-52 * angle);
    }
    double cosine = 0;
    double sine = 0;
    ps_turns_cosine_sine(ps_turns_of(0.75), &cosine, &sine);
    assert_true(cosine == 0 && sine == -1);
}

/* ---- rotations ----------------------------------------------------------------------------- */

static double dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double determinant(const ps_rotation *r) {
    const double(*m)[3] = r->matrix;
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

static void random_rotations_are_rotations(void **state) {
    (void)state;
    ps_random random = ps_random_init(7, PS_STREAM_ROTATION, 0);
    for (unsigned repeat = 0; repeat < 10000; repeat++) {
        const ps_rotation r = ps_rotation_random(&random);
        for (unsigned i = 0; i < 3; i++) {
            for (unsigned j = 0; j <= i; j++) {
                assert_true(fabs(dot(r.matrix[i], r.matrix[j]) - (i == j)) <= 5e-16);
            }
        }
        assert_true(fabs(determinant(&r) - 1) <= 1e-15);
    }
}

static void portable_rotations_are_the_same(void **state) {
    (void)state;
    for (uint64_t r = 0; r < 10000; r++) {
        ps_random random = ps_random_init(7, PS_STREAM_ROTATION, r);
        ps_random again = random;
        const ps_rotation rotation = ps_rotation_random(&random);
        const ps_rotation portable = ps_rotation_random_portable(&again);
        for (unsigned i = 0; i < 9; i++) {
            assert_true(fabs(rotation.matrix[i / 3][i % 3] - portable.matrix[i / 3][i % 3]) <=
                        0x1p-50);
        }
        assert_true(ps_random_u64(&random) == ps_random_u64(&again));
    }
}

enum { NUM_ROTATIONS = 20000, NUM_SIGMAS = 5 };

static void assert_mean(double sum, double expected, double variance) {
    const double sigma = sqrt(variance / NUM_ROTATIONS);
    assert_true(fabs(sum / NUM_ROTATIONS - expected) <= NUM_SIGMAS * sigma);
}

/* Haar measure: every entry is uniform on [-1,1]; the trace has moments 0, 1, 3 of order 1, 2, 4,
 * which uniform angles about uniform axes would not have. One rotation of each realization, as they
 * are used. */
static void random_rotations_are_uniform(void **state) {
    (void)state;
    double first[3][3] = {{0}};
    double second[3][3] = {{0}};
    double products = 0;
    double traces[2] = {0};
    for (uint64_t r = 0; r < NUM_ROTATIONS; r++) {
        ps_random random = ps_random_init(1, PS_STREAM_ROTATION, r);
        const ps_rotation rotation = ps_rotation_random(&random);
        const double(*m)[3] = rotation.matrix;
        for (unsigned i = 0; i < 9; i++) {
            first[i / 3][i % 3] += m[i / 3][i % 3];
            second[i / 3][i % 3] += m[i / 3][i % 3] * m[i / 3][i % 3];
        }
        const double trace = m[0][0] + m[1][1] + m[2][2];
        traces[0] += trace;
        traces[1] += trace * trace;
        products += m[0][0] * m[1][2];
    }
    for (unsigned i = 0; i < 9; i++) {
        assert_mean(first[i / 3][i % 3], 0, 1.0 / 3);
        assert_mean(second[i / 3][i % 3], 1.0 / 3, 1.0 / 5 - 1.0 / 9);
    }
    assert_mean(products, 0, 2.0 / 15); /* E R_11^2 R_23^2 = 2/15 */
    assert_mean(traces[0], 0, 1);
    assert_mean(traces[1], 1, 3 - 1);
}

/* q = cos(a/2) + sin(a/2) k, of any length, turns x towards y by a. */
static void quaternions_turn_as_they_say(void **state) {
    (void)state;
    const ps_rotation rotation = ps_rotation_of_quaternion(3 * cos(0.3), 0, 0, 3 * sin(0.3));
    double v[6] = {1, 0, 0, 0, 0, 1};
    ps_rotate(&rotation, v, 2);
    assert_true(fabs(v[0] - cos(0.6)) < 1e-15 && fabs(v[1] - sin(0.6)) < 1e-15 && v[2] == 0);
    assert_true(v[3] == 0 && v[4] == 0 && v[5] == 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(turns_have_right_cosines_and_sines),
        cmocka_unit_test(small_angles_keep_their_digits),
        cmocka_unit_test(random_rotations_are_rotations),
        cmocka_unit_test(portable_rotations_are_the_same),
        cmocka_unit_test(random_rotations_are_uniform),
        cmocka_unit_test(quaternions_turn_as_they_say),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
