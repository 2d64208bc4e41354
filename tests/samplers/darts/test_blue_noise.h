/* What tests of points with a least distance on the torus share. */
#ifndef TEST_BLUE_NOISE_H
#define TEST_BLUE_NOISE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "files/digest.h"
#include "samplers/darts/distance.h"

/* At which such a sampler makes num_points in the mean. */
static inline double test_radius(const ps_distance_kind *kind, unsigned dimension, unsigned tries,
                                 size_t num_points) {
    const ps_blue_noise asked = {.dimension = dimension, .tries = tries};
    return kind->radius(&asked, num_points);
}

/* One set in fresh memory, which the caller frees. */
static inline double *test_make_set(const ps_distance_kind *kind, ps_blue_noise asked,
                                    uint64_t realization, size_t *num) {
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, realization);
    ps_error error = {0};
    if (asked.most_points == 0) {
        asked.most_points = kind->most_points(&asked);
    }
    double *const points = malloc((asked.most_points + 1) * asked.dimension * sizeof *points);
    assert_non_null(points);
    if (kind->make(&asked, &random, points, num, &error) != PSPEC_OK) {
        fail_msg("%s", error.message);
    }
    return points;
}

/* Square of the wrapped distance. */
static inline double test_square_distance(unsigned dimension, const double *a, const double *b) {
    double square = 0;
    for (unsigned i = 0; i < dimension; i++) {
        double difference = a[i] - b[i];
        difference -= difference > 0.5 ? 1 : difference < -0.5 ? -1 : 0;
        square += difference * difference;
    }
    return square;
}

/* To the nearest of the points but number `but`. */
static inline double test_nearest(unsigned dimension, const double *points, size_t num, size_t but,
                                  const double *place) {
    double least = HUGE_VAL;
    for (size_t j = 0; j < num; j++) {
        const double square = test_square_distance(dimension, place, points + j * dimension);
        least = j != but && square < least ? square : least;
    }
    return sqrt(least);
}

/* Least and mean distance to the nearest neighbour. */
static inline void test_distances(unsigned dimension, const double *points, size_t num,
                                  double *least, double *mean) {
    double sum = 0;
    *least = HUGE_VAL;
    for (size_t i = 0; i < num; i++) {
        const double d = test_nearest(dimension, points, num, i, points + i * dimension);
        *least = d < *least ? d : *least;
        sum += d;
    }
    *mean = sum / (double)num;
}

static inline void test_assert_in_cube(unsigned dimension, const double *points, size_t num) {
    for (size_t i = 0; i < num * dimension; i++) {
        assert_true(points[i] >= 0 && points[i] < 1);
    }
}

/* Numbers of points of so many sets. */
typedef struct test_numbers {
    double mean, variance, error; /* error: of the mean */
} test_numbers;

static inline test_numbers test_count(const ps_distance_kind *kind, const ps_blue_noise *asked,
                                      unsigned num_sets) {
    double sum = 0;
    double squares = 0;
    for (unsigned r = 0; r < num_sets; r++) {
        size_t num = 0;
        free(test_make_set(kind, *asked, r, &num));
        sum += (double)num;
        squares += (double)num * (double)num;
    }
    const double mean = sum / num_sets;
    const double variance = (squares / num_sets - mean * mean) * num_sets / (num_sets - 1);
    return (test_numbers){mean, variance, sqrt(variance / num_sets)};
}

static inline void test_assert_between(const char *what, double value, double low, double high) {
    if (!(value >= low && value <= high)) {
        fail_msg("%s: %.10g is not between %g and %g", what, value, low, high);
    }
}

static inline void test_assert_digest(const char *what, const double *points, size_t count,
                                      const char *expected) {
    char digest[PS_DIGEST_BYTES];
    ps_digest_bytes(points, count * sizeof *points, digest);
    if (strcmp(digest, expected) != 0) {
        fail_msg("%s: the bits of the points have the digest %s, not %s", what, digest, expected);
    }
}

static inline void test_assert_refused(const ps_distance_kind *kind, ps_blue_noise asked,
                                       pspec_status status, const char *expected) {
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, 0);
    ps_error error = {0};
    double point[4];
    size_t num = 1;
    assert_int_equal(kind->make(&asked, &random, point, &num, &error), status);
    assert_int_equal(num, 0);
    if (strstr(error.message, expected) == NULL) {
        fail_msg("\"%s\" lacks \"%s\"", error.message, expected);
    }
}

#endif
