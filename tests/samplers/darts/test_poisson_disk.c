/* Maximal Poisson disk points: distances, saturation, the law of dart throwing, numbers, power. */
#include "test_blue_noise.h"

static const double SIGMAS = 4;

static ps_blue_noise ask(unsigned dimension, size_t num_points) {
    return (ps_blue_noise){.dimension = dimension,
                           .radius = test_radius(&ps_poisson_disk_kind, dimension, 0, num_points)};
}

static void no_two_points_are_nearer_than_the_radius(void **state) {
    (void)state;
    const size_t numbers[] = {1, 2, 3, 5, 8, 13, 30, 200, 2000};
    for (unsigned dimension = 2; dimension <= 3; dimension++) {
        for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
            const ps_blue_noise asked = ask(dimension, numbers[i]);
            size_t num = 0;
            double *const points = test_make_set(&ps_poisson_disk_kind, asked, i, &num);
            double least = 0;
            double mean = 0;
            assert_true(num > 0);
            test_assert_in_cube(dimension, points, num);
            test_distances(dimension, points, num, &least, &mean);
            assert_true(least >= asked.radius * (1 - 1e-15));
            free(points);
        }
    }
}

/* Where two circles cross, or nowhere when this is false. */
static bool crossing(const double *a, const double *b, double radius, int side, double *place) {
    const double square = test_square_distance(2, a, b);
    if (square >= 4 * radius * radius) {
        return false;
    }
    double to_b[2];
    for (unsigned i = 0; i < 2; i++) {
        const double difference = b[i] - a[i];
        to_b[i] = difference - rint(difference);
    }
    const double height = side * sqrt(radius * radius / square - 0.25);
    place[0] = a[0] + to_b[0] / 2 - height * to_b[1];
    place[1] = a[1] + to_b[1] / 2 + height * to_b[0];
    place[0] -= floor(place[0]);
    place[1] -= floor(place[1]);
    return true;
}

/* Is the place in an open disk of a point other than i and j? */
static bool is_covered(const double *points, size_t num, size_t i, size_t j, double radius,
                       const double *place) {
    const double rounding = 1e-9; /* parts of cells narrower than that count as covered */
    for (size_t k = 0; k < num; k++) {
        const double square = test_square_distance(2, place, points + 2 * k);
        if (k != i && k != j && square < radius * radius * (1 + rounding)) {
            return true;
        }
    }
    return false;
}

/* A hole would have corners, where two circles cross outside of all other disks. */
static void no_place_of_the_plane_is_left(void **state) {
    (void)state;
    const ps_blue_noise asked = ask(2, 1024);
    size_t num = 0;
    size_t num_crossings = 0;
    double *const points = test_make_set(&ps_poisson_disk_kind, asked, 0, &num);
    for (size_t i = 0; i < num; i++) {
        for (size_t j = 0; j < i; j++) {
            double place[2];
            for (int side = -1; side <= 1; side += 2) {
                if (crossing(points + 2 * i, points + 2 * j, asked.radius, side, place)) {
                    assert_true(is_covered(points, num, i, j, asked.radius, place));
                    num_crossings++;
                }
            }
        }
    }
    assert_true(num_crossings > 2 * num); /* there was something to see */
    free(points);
}

static void no_place_of_the_cube_is_left(void **state) {
    (void)state;
    enum { PROBES = 100000 };
    const ps_blue_noise asked = ask(3, 400);
    size_t num = 0;
    double *const points = test_make_set(&ps_poisson_disk_kind, asked, 0, &num);
    ps_random random = ps_random_init(2, PS_STREAM_COORDINATES, 0);
    for (unsigned i = 0; i < PROBES; i++) {
        double place[3];
        ps_random_fill_uniform(&random, place, 3);
        assert_true(test_nearest(3, points, num, num, place) < asked.radius);
    }
    free(points);
}

enum { DARTS = 10000, MORE_DARTS = 4 * DARTS };

/* Plain darts; early: how many points there are after DARTS. */
static size_t throw_plainly(const ps_blue_noise *asked, uint64_t realization, double *points,
                            size_t *early) {
    ps_random random = ps_random_init(7, PS_STREAM_COORDINATES, realization);
    size_t num = 0;
    for (unsigned i = 0; i < MORE_DARTS; i++) {
        double *const place = points + num * asked->dimension;
        *early = i == DARTS ? num : *early;
        ps_random_fill_uniform(&random, place, asked->dimension);
        num += test_nearest(asked->dimension, points, num, num, place) >= asked->radius;
    }
    return num;
}

/* After t darts in the plane the points that are still to come fall like 1/sqrt(t) (J. Feder, 1980;
 * Y. Pomeau, 1980): with four times the darts half of them are missing. */
static void darts_thrown_plainly_come_to_the_same(void **state) {
    (void)state;
    enum { SETS = 400 };
    const ps_blue_noise asked = {.dimension = 2, .radius = 0.19};
    double points[2 * 64];
    double sum = 0;
    double squares = 0;
    for (unsigned r = 0; r < SETS; r++) {
        size_t early = 0;
        const size_t num = throw_plainly(&asked, r, points, &early);
        const double last = 2 * (double)num - (double)early;
        sum += last;
        squares += last * last;
    }
    const test_numbers ours = test_count(&ps_poisson_disk_kind, &asked, SETS);
    const double mean = sum / SETS;
    const double variance = (squares / SETS - mean * mean) * SETS / (SETS - 1);
    test_assert_between("difference of means", ours.mean - mean,
                        -SIGMAS * sqrt((ours.variance + variance) / SETS),
                        SIGMAS * sqrt((ours.variance + variance) / SETS));
}

/* The mean is the number asked for, and the variance that of the plateau, since the power at k -> 0
 * is the variance of the number over its mean: 0.058 in the plane. */
static void numbers_of_points_are_those_asked_for(void **state) {
    (void)state;
    enum { SETS = 400 };
    const ps_blue_noise plane = ask(2, 1024);
    const test_numbers in_plane = test_count(&ps_poisson_disk_kind, &plane, SETS);
    assert_true(fabs(in_plane.mean - 1024) < SIGMAS * in_plane.error);
    const double plateau = 0.058;
    assert_true(fabs(in_plane.variance / in_plane.mean / plateau - 1) < SIGMAS * sqrt(2.0 / SETS));
    const ps_blue_noise cube = ask(3, 512);
    const test_numbers in_cube = test_count(&ps_poisson_disk_kind, &cube, SETS / 8);
    assert_true(fabs(in_cube.mean - 512) < SIGMAS * in_cube.error);
}

static void bits_are_those_of_every_machine(void **state) {
    (void)state;
    size_t num = 0;
    double *points = test_make_set(&ps_poisson_disk_kind, ask(2, 1000), 3, &num);
    test_assert_digest("plane", points, 2 * num, "3c66d61604077a593296a8dddf5be6fa");
    free(points);
    points = test_make_set(&ps_poisson_disk_kind, ask(3, 300), 3, &num);
    test_assert_digest("cube", points, 3 * num, "2e1fd886937e0efed83666a2de90118e");
    free(points);
}

static void few_points_are_made_too(void **state) {
    (void)state;
    const struct {
        size_t asked;
        double low, high;
    } cases[] = {{1, 1, 1},       {2, 2, 2},     {3, 3.9, 4},
                 {4, 3.95, 4.05}, {8, 7.9, 8.2}, {64, 63.5, 64.5}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const ps_blue_noise asked = ask(2, cases[i].asked);
        const test_numbers made = test_count(&ps_poisson_disk_kind, &asked, 300);
        test_assert_between("mean number", made.mean, cases[i].low, cases[i].high);
    }
}

static void impossible_radii_are_refused(void **state) {
    (void)state;
    const double wrong[] = {0, -1, 0.708, HUGE_VAL, (double)NAN};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        const ps_blue_noise asked = {.dimension = 2, .radius = wrong[i], .most_points = 1};
        test_assert_refused(&ps_poisson_disk_kind, asked, PSPEC_ERROR_INVALID_ARGUMENT,
                            "at most 0.707107");
    }
    const ps_blue_noise tiny = {.dimension = 2, .radius = 1e-5, .most_points = 1};
    test_assert_refused(&ps_poisson_disk_kind, tiny, PSPEC_ERROR_INVALID_ARGUMENT,
                        "cells in 2 dimensions, more than 2^32");
    const ps_blue_noise crowded = {.dimension = 2, .radius = 0.3, .most_points = 1};
    test_assert_refused(&ps_poisson_disk_kind, crowded, PSPEC_ERROR_MEMORY, "room for 1 points");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_two_points_are_nearer_than_the_radius),
        cmocka_unit_test(no_place_of_the_plane_is_left),
        cmocka_unit_test(no_place_of_the_cube_is_left),
        cmocka_unit_test(darts_thrown_plainly_come_to_the_same),
        cmocka_unit_test(numbers_of_points_are_those_asked_for),
        cmocka_unit_test(bits_are_those_of_every_machine),
        cmocka_unit_test(few_points_are_made_too),
        cmocka_unit_test(impossible_radii_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
