/* BNOT: equal areas, points at centroids, the same bits for ever. */
#include "brute_cells.h"
#include "set_distances.h"
#include "stop_at_the_third.h"

#include <string.h>

#include "files/digest.h"
#include "samplers/optimized/bnot.h"

enum { NUM = 1024, SETS = 3 };

static ps_bnot_outcome optimise(size_t num, double eps, uint64_t realization, double *points,
                                double *weights) {
    ps_bnot_outcome outcome = {0};
    ps_error error = {0};
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, realization);
    ps_random_fill_uniform(&random, points, 2 * num);
    if (ps_bnot_optimise(num, eps, NULL, points, weights, &outcome, &error) != PSPEC_OK) {
        fail_msg("%s", error.message);
    }
    return outcome;
}

/* By cells that the library has no part in. */
static void areas_are_equal_and_points_are_at_centroids(void **state) {
    (void)state;
    static const size_t nums[] = {16, 50, 200};
    double points[2 * 200];
    double x[200], y[200], w[200];
    for (unsigned n = 0; n < sizeof nums / sizeof nums[0]; n++) {
        const size_t num = nums[n];
        const ps_bnot_outcome outcome = optimise(num, 1, n, points, w);
        double away2 = 0;
        for (size_t i = 0; i < num; i++) {
            assert_true(points[2 * i] >= 0 && points[2 * i] < 1);
            assert_true(points[2 * i + 1] >= 0 && points[2 * i + 1] < 1);
            x[i] = points[2 * i];
            y[i] = points[2 * i + 1];
        }
        for (size_t i = 0; i < num; i++) {
            const brute_cell cell = brute_clip(num, x, y, w, i);
            assert_close(cell.area * (double)num, 1, PS_BNOT_CAPACITY);
            away2 += cell.x * cell.x + cell.y * cell.y;
        }
        assert_true(outcome.capacity <= PS_BNOT_CAPACITY);
        assert_true(outcome.distance <= 0.015);
        assert_close(sqrt(away2), outcome.distance, 1e-3);
    }
}

static void few_moves_are_enough(void **state) {
    (void)state;
    static double points[2 * NUM];
    for (uint64_t r = 0; r < SETS; r++) {
        assert_in_range(optimise(NUM, 1, r, points, NULL).moves, 7, 12);
    }
}

static void smaller_eps_is_more_regular(void **state) {
    (void)state;
    static double points[2 * NUM];
    optimise(NUM, 0.5, 0, points, NULL);
    assert_close(measure_distances(NUM, points).mean, 0.896, 0.004);
    const ps_bnot_outcome outcome = optimise(NUM, 0.2, 0, points, NULL);
    assert_close(measure_distances(NUM, points).mean, 0.919, 0.004);
    assert_true(outcome.distance <= 0.2 * 0.015);
}

static void a_lattice_stays_where_it_is(void **state) {
    (void)state;
    double points[2 * 64];
    ps_bnot_outcome outcome;
    ps_error error = {0};
    for (int i = 0; i < 64; i++) {
        points[2 * i] = i % 8 / 8.0;
        points[2 * i + 1] = i / 8 / 8.0;
    }
    assert_int_equal(ps_bnot_optimise(64, 1, NULL, points, NULL, &outcome, &error), PSPEC_OK);
    assert_int_equal(outcome.moves, 0);
    for (int i = 0; i < 64; i++) {
        assert_true(points[2 * i] == i % 8 / 8.0 && points[2 * i + 1] == i / 8 / 8.0);
    }
}

static void clumped_points_spread_and_equal_ones_are_refused(void **state) {
    (void)state;
    double points[2 * 128];
    ps_bnot_outcome outcome;
    ps_error error = {0};
    for (double side = 0.1; side > 1e-5; side /= 10) {
        ps_random random = ps_random_init(2, PS_STREAM_COORDINATES, 0);
        ps_random_fill_uniform(&random, points, 2 * 128);
        for (size_t i = 0; i < 2 * 128; i++) {
            points[i] = 0.9 + side * points[i];
        }
        assert_int_equal(ps_bnot_optimise(128, 1, NULL, points, NULL, &outcome, &error), PSPEC_OK);
        assert_true(outcome.capacity <= PS_BNOT_CAPACITY);
    }
    points[2] = points[0];
    points[3] = points[1];
    assert_int_equal(ps_bnot_optimise(128, 1, NULL, points, NULL, NULL, &error), PSPEC_ERROR_INPUT);
    assert_non_null(strstr(error.message, "coincide"));
}

static void what_cannot_be_made_is_refused(void **state) {
    (void)state;
    double points[32];
    ps_error error = {0};
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, 0);
    assert_int_equal(ps_bnot_make(15, 1, &random, NULL, points, &error),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(error.message, "from 16"));
    static const double wrong[] = {0, 0.0199, 10.1, NAN, -1};
    for (unsigned k = 0; k < sizeof wrong / sizeof wrong[0]; k++) {
        assert_int_equal(ps_bnot_check(16, wrong[k], &error), PSPEC_ERROR_INVALID_ARGUMENT);
        assert_non_null(strstr(error.message, "eps"));
    }
    assert_int_equal(ps_bnot_check(16, 0.02, &error), PSPEC_OK);
}

static void whoever_watches_may_stop_it(void **state) {
    (void)state;
    static double points[2 * NUM];
    unsigned calls = 0;
    const ps_watch watch = {stop_at_the_third, &calls};
    ps_error error = {0};
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, 0);
    assert_int_equal(ps_bnot_make(NUM, 1, &random, &watch, points, &error), PSPEC_ERROR_CANCELLED);
    assert_int_equal(calls, 3);
}

/* Recorded: the bits of a set stay the same, with any compiler and on any machine. */
static void the_bits_of_a_set_are_these(void **state) {
    (void)state;
    static double points[2 * NUM];
    char digest[PS_DIGEST_BYTES];
    optimise(NUM, 1, 0, points, NULL);
    ps_digest_bytes(points, sizeof points, digest);
    assert_string_equal(digest, "b36d04ca84926b5f507a51bfb0b2cffe");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(areas_are_equal_and_points_are_at_centroids),
        cmocka_unit_test(few_moves_are_enough),
        cmocka_unit_test(smaller_eps_is_more_regular),
        cmocka_unit_test(a_lattice_stays_where_it_is),
        cmocka_unit_test(clumped_points_spread_and_equal_ones_are_refused),
        cmocka_unit_test(what_cannot_be_made_is_refused),
        cmocka_unit_test(whoever_watches_may_stop_it),
        cmocka_unit_test(the_bits_of_a_set_are_these),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
