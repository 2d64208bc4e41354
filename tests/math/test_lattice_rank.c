/* Lattice points by number: counts, ranks and means against lists of all points. */
#include "harness.h"

#include "frequencies/frequencies.h"
#include "math/lattice_rank.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Boxes that hold all points with |k|^2 <= largest^2 + largest, small enough to walk through. */
static const int32_t largest[] = {40, 12, 7, 4, 3, 2};

static bool advance(int32_t *k, unsigned dimension, int32_t most) {
    for (unsigned i = dimension; i-- > 0;) {
        if (k[i] < most) {
            k[i]++;
            return true;
        }
        k[i] = -most;
    }
    return false;
}

/* Every rank of the shell is the next of its points in lexicographic order. */
static void check_shell(const ps_lattice *lattice, int32_t box, int64_t low, int64_t high) {
    const unsigned d = lattice->dimension;
    int32_t k[PS_LATTICE_MAX_DIMENSION];
    int32_t found[PS_LATTICE_MAX_DIMENSION];
    uint64_t rank = 0;
    long double norms = 0;
    const uint64_t num = ps_lattice_count(lattice, low, high);
    for (unsigned i = 0; i < d; i++) {
        k[i] = -box;
    }
    do {
        const int64_t norm2 = ps_frequency_norm2(k, d);
        if (norm2 < low || norm2 > high) {
            continue;
        }
        assert_true(rank < num);
        ps_lattice_unrank(lattice, low, high, rank, found);
        assert_memory_equal(k, found, d * sizeof *k);
        if (low > 0) { /* the upper half of the ranks is the half lattice */
            assert_int_equal(ps_frequency_is_in_half_lattice(k, d), rank >= num / 2);
        }
        norms += sqrtl((long double)norm2);
        rank++;
    } while (advance(k, d, box));
    assert_int_equal(rank, num);
    if (num > 0) {
        const double mean = (double)(norms / (long double)num);
        assert_true(fabs(ps_lattice_mean_norm(lattice, low, high) - mean) <=
                    8 * DBL_EPSILON * mean);
    }
}

static void ranks_are_places_in_lexicographic_order(void **state) {
    (void)state;
    for (unsigned d = 1; d <= PS_LATTICE_MAX_DIMENSION; d++) {
        const int64_t most = largest[d - 1];
        ps_lattice lattice;
        assert_ok(ps_lattice_create(&lattice, d, most * most + most, error));
        for (int64_t b = 1; b <= most; b++) {
            check_shell(&lattice, (int32_t)most, b * b - b + 1, b * b + b);
        }
        for (int64_t norm2 = 0; norm2 <= most * most; norm2 += 3) {
            check_shell(&lattice, (int32_t)most, norm2, norm2);
        }
        check_shell(&lattice, (int32_t)most, 0, most * most + most);
        ps_lattice_free(&lattice);
    }
}

/* The counts lie within them, and they are no wider than the shells at the surface. */
static void estimates_are_bounds(void **state) {
    (void)state;
    const double rounding = 1 + 1e-12; /* in one dimension bounds are met */
    for (unsigned d = 1; d <= PS_LATTICE_MAX_DIMENSION; d++) {
        const int64_t most = d <= 3 ? 40000 : 2500;
        ps_lattice lattice;
        assert_ok(ps_lattice_create(&lattice, d, most, error));
        for (int64_t norm2 = 0; norm2 <= most; norm2++) {
            const ps_lattice_bounds bounds = ps_lattice_estimate(d, norm2);
            const double count = (double)ps_lattice_count(&lattice, 0, norm2);
            assert_true(bounds.least <= count * rounding && count <= bounds.most * rounding);
        }
        const ps_lattice_bounds last = ps_lattice_estimate(d, most);
        assert_true(last.most < 1.4 * last.least);
        ps_lattice_free(&lattice);
    }
}

/* r_2(n) = 4 (d_1(n) - d_3(n)), r_4(n) = 8 times the divisors not divisible by 4 (Jacobi). */
static void counts_are_those_of_jacobi(void **state) {
    (void)state;
    enum { MOST = 3000 };
    ps_lattice two;
    ps_lattice four;
    assert_ok(ps_lattice_create(&two, 2, MOST, error));
    assert_ok(ps_lattice_create(&four, 4, MOST, error));
    for (int64_t n = 1; n <= MOST; n++) {
        int64_t r2 = 0;
        int64_t r4 = 0;
        for (int64_t divisor = 1; divisor <= n; divisor++) {
            if (n % divisor == 0) {
                r2 += divisor % 4 == 1 ? 4 : divisor % 4 == 3 ? -4 : 0;
                r4 += divisor % 4 != 0 ? 8 * divisor : 0;
            }
        }
        assert_int_equal(ps_lattice_count(&two, n, n), r2);
        assert_int_equal(ps_lattice_count(&four, n, n), r4);
    }
    ps_lattice_free(&two);
    ps_lattice_free(&four);
}

/* Far beyond what can be listed: points lie where they should, neighbours in rank are neighbours in
 * order, and the mirror image has the mirrored rank. */
static void large_shells(void **state) {
    (void)state;
    enum { RING = 120 };
    const int64_t b = RING;
    const int64_t low = b * b - b + 1;
    const int64_t high = b * b + b;
    uint64_t seed = 5;
    ps_lattice lattice;
    assert_ok(ps_lattice_create(&lattice, 6, high, error));
    const uint64_t num = ps_lattice_count(&lattice, low, high);
    const double expected = 6 * 5.16771278004997 * pow(RING, 5); /* pi^3/6 r^6, derived */
    assert_true(fabs((double)num / expected - 1) < 1e-3);
    for (int i = 0; i < 2000; i++) {
        const uint64_t rank = (uint64_t)(test_uniform(&seed) * (double)(num - 1));
        int32_t k[3][PS_LATTICE_MAX_DIMENSION];
        ps_lattice_unrank(&lattice, low, high, rank, k[0]);
        ps_lattice_unrank(&lattice, low, high, rank + 1, k[1]);
        ps_lattice_unrank(&lattice, low, high, num - 1 - rank, k[2]);
        const int64_t norm2 = ps_frequency_norm2(k[0], 6);
        assert_true(low <= norm2 && norm2 <= high);
        unsigned axis = 0;
        while (axis < 6 && k[0][axis] == k[1][axis]) {
            axis++;
        }
        assert_true(axis < 6 && k[0][axis] < k[1][axis]);
        for (axis = 0; axis < 6; axis++) {
            assert_int_equal(k[2][axis], -k[0][axis]);
        }
    }
    ps_lattice_free(&lattice);
}

static void too_many_to_count(void **state) {
    (void)state;
    const int64_t fits = 1235;
    ps_error message = {0};
    ps_lattice lattice;
    assert_ok(ps_lattice_create(&lattice, 6, fits * fits + fits, error));
    assert_true(ps_lattice_count(&lattice, 1, fits * fits + fits) > UINT64_MAX / 4 * 3);
    ps_lattice_free(&lattice);
    assert_int_equal(ps_lattice_create(&lattice, 6, 1240 * 1240, &message),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(message.message, "more than can be counted"));
    assert_null(lattice.within[0]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ranks_are_places_in_lexicographic_order),
        cmocka_unit_test(estimates_are_bounds),
        cmocka_unit_test(counts_are_those_of_jacobi),
        cmocka_unit_test(large_shells),
        cmocka_unit_test(too_many_to_count),
    };
    return cmocka_run_group_tests_name("lattice_rank", tests, NULL, NULL);
}
