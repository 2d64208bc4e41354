/* Bridson's points: distances, neighbours, numbers, power, bits. */
#include "test_blue_noise.h"

static const double SIGMAS = 4;

static ps_blue_noise ask(unsigned dimension, unsigned tries, size_t num_points) {
    return (ps_blue_noise){.dimension = dimension,
                           .tries = tries,
                           .radius = test_radius(&ps_bridson_kind, dimension, tries, num_points)};
}

/* Every point but the first has its parent within two radii, and no other within one. */
static void distances_are_between_one_and_two_radii(void **state) {
    (void)state;
    const size_t numbers[] = {1, 2, 3, 5, 8, 13, 30, 200, 1500};
    for (unsigned dimension = 2; dimension <= 4; dimension++) {
        for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
            const ps_blue_noise asked = ask(dimension, 30, numbers[i]);
            size_t num = 0;
            double *const points = test_make_set(&ps_bridson_kind, asked, i, &num);
            assert_true(num > 0);
            test_assert_in_cube(dimension, points, num);
            for (size_t j = 1; j < num; j++) {
                const double *const point = points + j * dimension;
                const double earlier = test_nearest(dimension, points, j, num, point);
                assert_true(earlier >= asked.radius * (1 - 1e-15));
                assert_true(earlier <= 2 * asked.radius * (1 + 1e-15));
            }
            free(points);
        }
    }
}

/* A parent is left behind after so many failures in a row: with many tries no hole that a point
 * would fit into with room to spare is left. */
static void many_tries_leave_no_wide_holes(void **state) {
    (void)state;
    enum { PROBES = 100000 };
    const ps_blue_noise asked = ask(2, 1000, 300);
    size_t num = 0;
    double *const points = test_make_set(&ps_bridson_kind, asked, 0, &num);
    ps_random random = ps_random_init(2, PS_STREAM_COORDINATES, 0);
    for (unsigned i = 0; i < PROBES; i++) {
        double place[2];
        ps_random_fill_uniform(&random, place, 2);
        assert_true(test_nearest(2, points, num, num, place) < 1.1 * asked.radius);
    }
    free(points);
}

static void numbers_of_points_are_those_asked_for(void **state) {
    (void)state;
    const struct {
        unsigned dimension, tries, sets;
        size_t num_points;
    } cases[] = {{2, 30, 200, 1024}, {2, 10, 100, 1024}, {2, 100, 50, 1024}, {2, 15, 100, 1024},
                 {2, 2, 100, 1024},  {3, 30, 50, 1024},  {3, 70, 20, 1024},  {4, 30, 12, 1024}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const ps_blue_noise asked = ask(cases[i].dimension, cases[i].tries, cases[i].num_points);
        const test_numbers made = test_count(&ps_bridson_kind, &asked, cases[i].sets);
        const double measured = 0.01; /* what the header says */
        const double n = (double)cases[i].num_points;
        test_assert_between("mean number", made.mean, n * (1 - measured) - SIGMAS * made.error,
                            n * (1 + measured) + SIGMAS * made.error);
    }
    const ps_blue_noise usual = ask(2, 30, 1024);
    const test_numbers made = test_count(&ps_bridson_kind, &usual, 300);
    test_assert_between("mean number, 30 tries", made.mean, 1024 - SIGMAS * made.error,
                        1024 + SIGMAS * made.error);
}

static void bits_are_those_of_every_machine(void **state) {
    (void)state;
    const char *const digests[] = {"33d3856001c9a8a951f67af0185c48b6",
                                   "3fb6440ffa0fa09f2afc179be81e0b3b",
                                   "a2171bba905976681e4f24c50d596e55"};
    for (unsigned dimension = 2; dimension <= 4; dimension++) {
        size_t num = 0;
        double *const points = test_make_set(&ps_bridson_kind, ask(dimension, 30, 500), 3, &num);
        test_assert_digest("points", points, dimension * num, digests[dimension - 2]);
        free(points);
    }
}

static void impossible_questions_are_refused(void **state) {
    (void)state;
    ps_blue_noise asked = {.dimension = 3, .radius = 0.9, .tries = 30, .most_points = 1};
    test_assert_refused(&ps_bridson_kind, asked, PSPEC_ERROR_INVALID_ARGUMENT, "at most 0.866025");
    asked.radius = 0.3;
    asked.tries = 1;
    test_assert_refused(&ps_bridson_kind, asked, PSPEC_ERROR_INVALID_ARGUMENT,
                        "1 tries are not between 2 and 1000");
    asked.tries = 30;
    test_assert_refused(&ps_bridson_kind, asked, PSPEC_ERROR_MEMORY, "room for 1 points");
    asked.radius = 1e-4;
    test_assert_refused(&ps_bridson_kind, asked, PSPEC_ERROR_INVALID_ARGUMENT, "more than 2^32");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distances_are_between_one_and_two_radii),
        cmocka_unit_test(many_tries_leave_no_wide_holes),
        cmocka_unit_test(numbers_of_points_are_those_asked_for),
        cmocka_unit_test(bits_are_those_of_every_machine),
        cmocka_unit_test(impossible_questions_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
