/* Lattices of frequencies against their definition, and the limits with their messages. */
#include "harness.h"

#include "frequencies/frequencies.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Lattices small enough to be walked through in every dimension. */
static const int32_t largest_to_try[] = {40, 12, 6, 3, 2, 2};

/* Lexicographic order: negative when a comes before b. */
static int compare(const int32_t *a, const int32_t *b, unsigned dimension) {
    unsigned i = 0;
    while (i < dimension && a[i] == b[i]) {
        i++;
    }
    return i == dimension ? 0 : a[i] < b[i] ? -1 : 1;
}

/* Counts the vectors of the half lattice by walking through the box as a number in base 2K+1. */
static size_t count_by_definition(unsigned dimension, int32_t max_frequency, bool is_ball) {
    size_t box = 1;
    size_t count = 0;
    const size_t width = 2 * (size_t)max_frequency + 1;
    for (unsigned i = 0; i < dimension; i++) {
        box *= width;
    }
    for (size_t place = 0; place < box; place++) {
        int64_t norm2 = 0;
        int32_t first = 0; /* non-zero component */
        size_t rest = place;
        for (unsigned i = 0; i < dimension; i++, rest /= width) {
            const int32_t k = (int32_t)(rest % width) - max_frequency;
            norm2 += (int64_t)k * k;
            first = first == 0 ? k : first;
        }
        const int64_t limit = (int64_t)max_frequency * max_frequency + max_frequency;
        count += first > 0 && (!is_ball || norm2 <= limit);
    }
    return count;
}

static void check_lattice(unsigned dimension, int32_t max_frequency, bool is_ball) {
    ps_frequencies set = {0};
    assert_ok(ps_frequencies_lattice(&set, dimension, max_frequency, is_ball, error));
    assert_null(set.vectors);
    const size_t promised = set.num;
    assert_ok(ps_frequencies_enumerate(&set, error));
    const size_t expected = count_by_definition(dimension, max_frequency, is_ball);
    assert_int_equal(set.num, expected);
    if (!is_ball) {
        assert_int_equal(promised, expected);
    }
    /* Of the right size and number, in the half lattice and ascending: then they are the lattice.
     */
    const int64_t limit = (int64_t)max_frequency * max_frequency + max_frequency;
    for (size_t i = 0; i < set.num; i++) {
        const int32_t *k = set.vectors + i * dimension;
        assert_true(ps_frequency_is_in_half_lattice(k, dimension));
        assert_true(!is_ball || ps_frequency_norm2(k, dimension) <= limit);
        assert_true(i == 0 || compare(k - dimension, k, dimension) < 0);
        for (unsigned axis = 0; axis < dimension; axis++) {
            assert_in_range((intmax_t)k[axis] + max_frequency, 0, 2 * max_frequency);
        }
    }
    ps_frequencies_free(&set);
    assert_null(set.vectors);
}

static void lattices(void **state) {
    (void)state;
    for (unsigned dimension = 1; dimension <= PS_MAX_DIMENSION; dimension++) {
        for (int32_t k = 1; k <= largest_to_try[dimension - 1]; k++) {
            check_lattice(dimension, k, false);
            check_lattice(dimension, k, true);
        }
    }
}

/* In one dimension a ball is the box; the promise for balls is their volume. */
static void promised_size_of_balls(void **state) {
    (void)state;
    ps_frequencies set = {0};
    assert_ok(ps_frequencies_lattice(&set, 1, 1000, true, error));
    assert_int_equal(set.num, 1000);
    for (unsigned dimension = 2; dimension <= 3; dimension++) {
        assert_ok(ps_frequencies_lattice(&set, dimension, 50, true, error));
        const double promised = (double)set.num;
        assert_ok(ps_frequencies_enumerate(&set, error));
        assert_true(fabs(promised / (double)set.num - 1) < 0.01);
        ps_frequencies_free(&set);
    }
}

/* Exactly one of k and -k is in the half lattice, and 0 is not. */
static void half_lattice(void **state) {
    (void)state;
    uint64_t seed = 6;
    const int32_t zero[PS_MAX_DIMENSION] = {0};
    for (unsigned dimension = 1; dimension <= PS_MAX_DIMENSION; dimension++) {
        assert_false(ps_frequency_is_in_half_lattice(zero, dimension));
        for (int i = 0; i < 1000; i++) {
            int32_t k[PS_MAX_DIMENSION];
            int32_t minus[PS_MAX_DIMENSION];
            for (unsigned axis = 0; axis < dimension; axis++) {
                k[axis] = (int32_t)(3 * test_uniform(&seed)) - 1;
                minus[axis] = -k[axis];
            }
            const bool is_zero = memcmp(k, zero, dimension * sizeof *k) == 0;
            const int both = ps_frequency_is_in_half_lattice(k, dimension) +
                             ps_frequency_is_in_half_lattice(minus, dimension);
            assert_int_equal(both, is_zero ? 0 : 1);
        }
    }
}

static void norms_do_not_overflow(void **state) {
    (void)state;
    const int32_t k[] = {1 << 28, -(1 << 28), 1 << 28, 1 << 28, -(1 << 28), 1 << 28};
    assert_int_equal(ps_frequency_norm2(k, 6), 6 * ((int64_t)1 << 56));
}

/* ---- limits ------------------------------------------------------------------------------ */

/* The largest K that the message names is accepted, the next one is not. */
static void largest_lattices(void **state) {
    (void)state;
    for (unsigned dimension = 1; dimension <= PS_MAX_DIMENSION; dimension++) {
        ps_frequencies set = {0};
        ps_error said = {0};
        long largest = 0;
        assert_int_equal(ps_frequencies_lattice(&set, dimension, INT32_MAX, false, &said),
                         PSPEC_ERROR_INVALID_ARGUMENT);
        const char *number = strstr(said.message, "between 1 and ");
        assert_non_null(number);
        assert_int_equal(sscanf(number, "between 1 and %ld", &largest), 1);
        assert_int_equal(ps_frequencies_lattice(&set, dimension, (int32_t)largest, false, &said),
                         PSPEC_OK);
        const double box = (pow(2.0 * (double)largest + 1, dimension) - 1) / 2;
        assert_true(fabs((double)set.num / box - 1) < 1e-12);
        assert_true(box <= 0x1p29);
        const double next = (pow(2.0 * (double)largest + 3, dimension) - 1) / 2;
        assert_true(next > 0x1p29 || largest == PS_MAX_FREQUENCY);
        for (int is_ball = 0; is_ball <= 1; is_ball++) {
            assert_int_equal(
                ps_frequencies_lattice(&set, dimension, (int32_t)largest + 1, is_ball != 0, &said),
                PSPEC_ERROR_INVALID_ARGUMENT);
        }
    }
}

static void refused_lattices(void **state) {
    (void)state;
    const struct {
        unsigned dimension;
        int32_t max_frequency;
        const char *names;
    } cases[] = {{0, 10, "dimension 0"},
                 {7, 10, "dimension 7"},
                 {UINT_MAX, 1, "not between 1 and 6"},
                 {2, 0, "max frequency 0"},
                 {2, -5, "max frequency -5"},
                 {3, INT32_MIN, "not between 1 and"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        ps_frequencies set = {0};
        ps_error said = {0};
        assert_int_equal(
            ps_frequencies_lattice(&set, cases[i].dimension, cases[i].max_frequency, false, &said),
            PSPEC_ERROR_INVALID_ARGUMENT);
        assert_non_null(strstr(said.message, cases[i].names));
    }
}

static pspec_status make_list(ps_frequencies *set, const int32_t *vectors, size_t num,
                              ps_error *said) {
    int32_t *copy = malloc(num * 2 * sizeof *copy);
    assert_non_null(copy);
    memcpy(copy, vectors, num * 2 * sizeof *copy);
    return ps_frequencies_list(set, 2, num, copy, said);
}

static void lists(void **state) {
    (void)state;
    ps_frequencies set = {0};
    ps_error said = {0};
    const int32_t largest = PS_MAX_FREQUENCY;
    const int32_t good[] = {0, 0, 3, -largest, largest, 7};
    assert_int_equal(make_list(&set, good, 3, &said), PSPEC_OK);
    assert_int_equal(set.kind, PS_FREQUENCIES_LIST);
    assert_int_equal(set.num, 3);
    assert_int_equal(set.max_frequency, largest);
    const int32_t *vectors = set.vectors;
    assert_ok(ps_frequencies_enumerate(&set, error)); /* nothing to do */
    assert_ptr_equal(set.vectors, vectors);
    assert_memory_equal(set.vectors, good, sizeof good);
    ps_frequencies_free(&set);
    const int32_t bad[] = {largest + 1, -(largest + 1), INT32_MIN, INT32_MAX};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        char number[16];
        const int32_t list[] = {1, 2, 3, bad[i]};
        snprintf(number, sizeof number, "%d", (int)bad[i]);
        assert_int_equal(make_list(&set, list, 2, &said), PSPEC_ERROR_INVALID_ARGUMENT);
        assert_non_null(strstr(said.message, "frequency 2"));
        assert_non_null(strstr(said.message, number));
        assert_non_null(strstr(said.message, "268435456"));
        ps_frequencies_free(&set);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lattices),
        cmocka_unit_test(promised_size_of_balls),
        cmocka_unit_test(half_lattice),
        cmocka_unit_test(norms_do_not_overflow),
        cmocka_unit_test(largest_lattices),
        cmocka_unit_test(refused_lattices),
        cmocka_unit_test(lists),
    };
    return cmocka_run_group_tests_name("frequencies", tests, NULL, NULL);
}
