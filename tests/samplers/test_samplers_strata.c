/* Grids: factorisation, occupancy of strata, permutations, edges of strata. */
#include "test_samplers.h"

#include <math.h>
#include <string.h>

#include "math/random/random.h"
#include "samplers/torus/strata.h"

/* ---- factorisation, against enumeration of all tuples -----------------------------------------
 */

/* Smallest aspect over all ways to write n as an ascending product of d factors >= smallest. */
static double smallest_aspect(uint64_t n, unsigned d, uint64_t smallest, uint64_t first) {
    if (d == 1) {
        return n >= smallest ? (double)n / (double)(first > 0 ? first : n) : HUGE_VAL;
    }
    double best = HUGE_VAL;
    for (uint64_t f = smallest; f <= n; f++) {
        if (n % f == 0) {
            best = fmin(best, smallest_aspect(n / f, d - 1, f, first > 0 ? first : f));
        }
    }
    return best;
}

static void factorisation_has_the_smallest_aspect(void **state) {
    (void)state;
    for (unsigned d = 1; d <= PS_MAX_DIMENSION; d++) {
        for (uint64_t n = 1; n <= 600; n++) {
            uint64_t counts[PS_MAX_DIMENSION] = {0};
            const double aspect = smallest_aspect(n, d, 1, 0);
            assert_int_equal(ps_strata_factorise(n, d, counts), aspect <= 2);
            if (aspect <= 2) {
                uint64_t product = counts[0];
                for (unsigned i = 1; i < d; i++) {
                    assert_true(counts[i] >= counts[i - 1]);
                    product *= counts[i];
                }
                assert_int_equal(product, n);
                assert_true((double)counts[d - 1] / (double)counts[0] == aspect);
            }
        }
    }
}

static void nearest_admissible_numbers_are_named(void **state) {
    (void)state;
    for (unsigned d = 2; d <= PS_MAX_DIMENSION; d++) {
        uint64_t expected_below = 1;
        for (uint64_t n = 1; n <= 300; n++) {
            uint64_t below = 0;
            uint64_t above = 0;
            expected_below = smallest_aspect(n, d, 1, 0) <= 2 ? n : expected_below;
            uint64_t expected_above = n;
            while (smallest_aspect(expected_above, d, 1, 0) > 2) {
                expected_above++;
            }
            ps_strata_nearest(n, d, &below, &above);
            assert_int_equal(below, expected_below);
            assert_int_equal(above, expected_above);
        }
    }
}

static void powers_of_2_and_the_papers_3072_get_the_known_grids(void **state) {
    (void)state;
    uint64_t counts[PS_MAX_DIMENSION];
    assert_true(ps_strata_factorise(2048, 2, counts));
    assert_int_equal(counts[0], 32);
    assert_int_equal(counts[1], 64);
    assert_true(ps_strata_factorise(3072, 2, counts));
    assert_int_equal(counts[0], 48);
    assert_int_equal(counts[1], 64);
    assert_true(ps_strata_factorise((uint64_t)1 << 40, 2, counts));
    assert_int_equal(counts[0], 1 << 20);
}

/* ---- occupancy --------------------------------------------------------------------------------
 */

/* One point in every stratum; the index of a stratum is what any reader would compute. */
static void assert_one_per_stratum(const ps_sampler_request *request, const uint64_t *counts) {
    double *points = generate_points(request, 3);
    unsigned char *is_taken = calloc(request->num_points, 1);
    assert_non_null(is_taken);
    for (size_t j = 0; j < request->num_points; j++) {
        size_t stratum = 0;
        for (unsigned i = 0; i < request->dimension; i++) {
            const double x = points[j * request->dimension + i];
            stratum = stratum * counts[i] + (size_t)floor(x * (double)counts[i]);
        }
        assert_true(stratum < request->num_points);
        assert_false(is_taken[stratum]);
        is_taken[stratum] = 1;
    }
    free(is_taken);
    free(points);
}

typedef struct grid {
    const char *text;
    unsigned dimension;
    uint64_t counts[PS_MAX_DIMENSION];
} grid;

static const grid GRIDS[] = {
    {"jittered", 1, {997}},
    {"jittered", 2, {32, 32}},
    {"jittered", 2, {25, 40}},
    {"jittered", 2, {1024, 1024}},
    {"jittered:strata=7x3", 2, {7, 3}},
    {"jittered:strata=1x1009", 2, {1, 1009}},
    {"jittered", 3, {10, 10, 10}},
    {"jittered:strata=2x9x5", 3, {2, 9, 5}},
    {"jittered", 4, {5, 6, 6, 6}},
    {"jittered", 5, {3, 3, 3, 3, 3}},
    {"jittered", 6, {3, 3, 3, 3, 3, 3}},
    {"regular", 1, {997}},
    {"regular", 2, {49, 49}},
    {"regular:strata=103x5", 2, {103, 5}},
    {"regular", 6, {3, 3, 3, 3, 3, 3}},
    {"jittered", 2, {1, 1}},
};

static void every_stratum_holds_one_point(void **state) {
    (void)state;
    for (size_t g = 0; g < sizeof GRIDS / sizeof GRIDS[0]; g++) {
        size_t num_points = 1;
        for (unsigned i = 0; i < GRIDS[g].dimension; i++) {
            num_points *= GRIDS[g].counts[i];
        }
        const ps_sampler_request request =
            make_request(GRIDS[g].text, num_points, GRIDS[g].dimension);
        assert_one_per_stratum(&request, GRIDS[g].counts);
    }
}

static void regular_points_are_cell_centres(void **state) {
    (void)state;
    const ps_sampler_request request = make_request("regular", 15, 2);
    double *points = generate_points(&request, 0);
    for (unsigned j = 0; j < 15; j++) {
        assert_true(points[2 * j] == (j / 5 + 0.5) / 3);
        assert_true(points[2 * j + 1] == (j % 5 + 0.5) / 5);
    }
    free(points);
}

static void assert_latin(const char *text, size_t num_points, unsigned dimension) {
    const ps_sampler_request request = make_request(text, num_points, dimension);
    double *points = generate_points(&request, 2);
    unsigned char *is_taken = malloc(num_points);
    assert_non_null(is_taken);
    for (unsigned i = 0; i < dimension; i++) {
        memset(is_taken, 0, num_points);
        for (size_t j = 0; j < num_points; j++) {
            const double x = points[j * dimension + i];
            const size_t stratum = (size_t)floor(x * (double)num_points);
            assert_true(stratum < num_points && !is_taken[stratum]);
            is_taken[stratum] = 1;
        }
    }
    free(is_taken);
    free(points);
}

/* Correlated multi-jittered points are both: jittered points, and a Latin hypercube. */
static void correlated_points_have_both_strata(void **state) {
    static const struct {
        size_t num;
        uint64_t counts[PS_MAX_DIMENSION];
        const char *text;
    } cases[] = {{1, {1, 1}, "cmj"},
                 {12, {3, 4}, "cmj"},
                 {4096, {64, 64}, "cmj"},
                 {18, {9, 2}, "cmj:strata=9x2"}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const ps_sampler_request request = make_request(cases[i].text, cases[i].num, 2);
        assert_one_per_stratum(&request, cases[i].counts);
        assert_latin(cases[i].text, cases[i].num, 2);
    }
}

static void latin_hypercubes_have_one_point_per_stratum_and_axis(void **state) {
    (void)state;
    const size_t sizes[] = {1, 2, 3, 49, 64, 997, 100003};
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
        assert_latin("latin-hypercube", sizes[s], 2);
        assert_latin("latin-hypercube:offset=centred", sizes[s], 6);
    }
}

/* All 4! orders equally often, on both axes and jointly independent of the axis. */
static void permutations_are_unbiased(void **state) {
    (void)state;
    enum { N = 4, ORDERS = 24, M = 24000 };
    unsigned counts[2][ORDERS] = {{0}};
    const ps_sampler_request request = make_request("latin-hypercube:offset=centred", N, 2);
    for (uint64_t r = 0; r < M; r++) {
        double points[2 * N];
        generate_into(&request, r, points);
        for (unsigned i = 0; i < 2; i++) {
            unsigned rank = 0; /* factorial number of the order */
            for (unsigned j = 0; j < N; j++) {
                unsigned num_smaller = 0;
                for (unsigned k = j + 1; k < N; k++) {
                    num_smaller += points[2 * k + i] < points[2 * j + i];
                }
                rank = rank * (N - j) + num_smaller;
            }
            counts[i][rank]++;
        }
    }
    for (unsigned i = 0; i < 2; i++) {
        double chi_square = 0;
        for (unsigned order = 0; order < ORDERS; order++) {
            const double excess = counts[i][order] - (double)M / ORDERS;
            chi_square += excess * excess / ((double)M / ORDERS);
        }
        /* Mean 23, variance 46. */
        assert_true(fabs(chi_square - (ORDERS - 1)) < 4 * sqrt(2.0 * (ORDERS - 1)));
    }
}

/* ---- edges ------------------------------------------------------------------------------------
 */

static void assert_inside(double i, double offset, double m) {
    const double x = ps_stratum_point(i, offset, m);
    assert_true(fma(x, m, -i) >= 0);    /* x >= i/m in exact arithmetic */
    assert_true(fma(x, m, -i - 1) < 0); /* x < (i + 1)/m in exact arithmetic */
    assert_true(floor(x * m) == i);     /* and as computed */
    assert_true(fabs(x - (i + offset) / m) <= 0x1p-51);
}

static void rounding_never_leaves_the_stratum(void **state) {
    (void)state;
    const double offsets[] = {0, 0x1p-53, 0x1p-40, 0.5, 1 - 0x1p-30, 1 - 0x1p-52, 1 - 0x1p-53};
    const double counts[] = {1, 2, 3, 7, 49, 1000, 1009, 1048583, 0x1p32, 0x1p40 - 1, 0x1p40};
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, 0);
    for (size_t c = 0; c < sizeof counts / sizeof counts[0]; c++) {
        for (size_t o = 0; o < sizeof offsets / sizeof offsets[0]; o++) {
            assert_inside(0, offsets[o], counts[c]);
            assert_inside(counts[c] - 1, offsets[o], counts[c]);
            for (unsigned repeat = 0; repeat < 1000; repeat++) {
                const uint64_t i = ps_random_below(&random, (uint64_t)counts[c]);
                assert_inside((double)i, offsets[o], counts[c]);
            }
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(factorisation_has_the_smallest_aspect),
        cmocka_unit_test(nearest_admissible_numbers_are_named),
        cmocka_unit_test(powers_of_2_and_the_papers_3072_get_the_known_grids),
        cmocka_unit_test(every_stratum_holds_one_point),
        cmocka_unit_test(regular_points_are_cell_centres),
        cmocka_unit_test(latin_hypercubes_have_one_point_per_stratum_and_axis),
        cmocka_unit_test(correlated_points_have_both_strata),
        cmocka_unit_test(permutations_are_unbiased),
        cmocka_unit_test(rounding_never_leaves_the_stratum),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
