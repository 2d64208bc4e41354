/* Points of the plane on the sphere: the same bits one by one and in blocks, all their digits near
 * poles and quarters, no -0. */
#include "harness.h"

#include "math/lift.h"
#include "math/pi.h"
#include "math/random/random.h"

#include <math.h>
#include <string.h>

enum { MOST = 200 };

/* Edges of quarters and eighths, poles, the equator, and what lies beside them. */
static void make_pairs(double *pairs, size_t num, uint64_t seed) {
    ps_random random = ps_random_init(seed, PS_STREAM_COORDINATES, 0);
    for (size_t j = 0; j < num; j++) {
        const double edge = (double)(j % 17) / 16;
        const double beside = j % 3 == 0 ? edge : nextafter(edge, j % 3 == 1 ? 0 : 1);
        pairs[2 * j] = j % 4 == 0 ? fmin(beside, 1 - 0x1p-53) : ps_random_uniform(&random);
        pairs[2 * j + 1] = j % 5 == 0 ? fmin(beside, 1 - 0x1p-53) : ps_random_uniform(&random);
    }
}

static void blocks_have_the_bits_of_points(void **state) {
    (void)state;
    for (size_t num = 0; num <= MOST; num += 1 + num / 7) {
        for (size_t first = 0; first <= num; first += 1 + num / 3) {
            double pairs[2 * MOST];
            double points[3 * MOST] = {0};
            make_pairs(pairs, num, num);
            memcpy(points, pairs, 2 * num * sizeof *points);
            ps_sphere_lift(num % 2 == 0, first, num, points);
            assert_memory_equal(points, pairs, 2 * first * sizeof *points); /* not wanted yet */
            for (size_t j = first; j < num; j++) {
                double one[3] = {pairs[2 * j], pairs[2 * j + 1]};
                ps_sphere_lift(num % 2 == 0, 0, 1, one);
                assert_memory_equal(points + 3 * j, one, sizeof one);
            }
        }
    }
}

static void assert_near(double found, long double expected, double allowed) {
    assert_true(fabsl(found - expected) <= allowed);
    assert_true(found != 0 || !signbit(found));
}

static void points_keep_their_digits(void **state) {
    double pairs[2 * MOST];
    (void)state;
    for (uint64_t seed = 0; seed < 200; seed++) {
        double points[3 * MOST];
        make_pairs(pairs, MOST, seed);
        memcpy(points, pairs, sizeof pairs);
        ps_sphere_lift(false, 0, MOST, points);
        for (size_t j = 0; j < MOST; j++) {
            const long double x = pairs[2 * j];
            const long double angle = 2 * 3.14159265358979323846264338327950288L * pairs[2 * j + 1];
            const long double rho = 2 * sqrtl(x * (1 - x));
            /* rounding of t (2 - t), of the root, of cosine or sine, of the product, each half a
             * unit or less */
            const double allowed = 3 * 0x1p-53 * (double)rho;
            assert_near(points[3 * j], rho * cosl(angle), allowed);
            assert_near(points[3 * j + 1], rho * sinl(angle), allowed);
            assert_near(points[3 * j + 2], 2 * x - 1, 0x1p-53);
        }
    }
}

static void quarters_are_exact(void **state) {
    (void)state;
    for (int quarter = 0; quarter < 4; quarter++) {
        double point[3] = {0.5, quarter / 4.0};
        ps_sphere_lift(false, 0, 1, point);
        assert_true(point[0] == (quarter % 2 == 0 ? 1 - quarter : 0));
        assert_true(point[1] == (quarter % 2 == 1 ? 2 - quarter : 0));
        assert_true(point[2] == 0);
    }
    double pole[3] = {0, 0.3};
    ps_sphere_lift(false, 0, 1, pole);
    assert_true(pole[0] == 0 && pole[1] == 0 && pole[2] == -1);
    double equator[3] = {0, 0.125};
    ps_sphere_lift(true, 0, 1, equator);
    assert_true(fabs(equator[0] - equator[1]) <= 0x1p-53 && equator[2] == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_have_the_bits_of_points),
        cmocka_unit_test(points_keep_their_digits),
        cmocka_unit_test(quarters_are_exact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
