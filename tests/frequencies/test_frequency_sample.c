/* Random subsets of rings and shells: what is in them, how often, and what they depend on. */
#include "harness.h"

#include "frequencies/frequency_sample.h"
#include "math/random/subset.h"
#include "spectra/bins.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- subsets of numbers ------------------------------------------------------------------ */

/* Chi-square has mean n and variance 2 n: five standard deviations come by chance never. */
static void check_chi_square(const size_t *counts, size_t num, double expected) {
    double sum = 0;
    for (size_t i = 0; i < num; i++) {
        const double difference = (double)counts[i] - expected;
        sum += difference * difference / expected;
    }
    const double freedom = (double)num - 1;
    if (fabs(sum - freedom) > 5 * sqrt(2 * freedom)) {
        fail_msg("chi-square is %g with %g degrees of freedom", sum, freedom);
    }
}

/* All C(7, 3) = 35 subsets come equally often. */
static void subsets_are_uniform(void **state) {
    (void)state;
    enum { POPULATION = 7, COUNT = 3, NUM_SUBSETS = 35, TRIES = 35000 };
    size_t by_bits[1 << POPULATION] = {0};
    size_t counts[NUM_SUBSETS];
    size_t num = 0;
    for (uint64_t seed = 0; seed < TRIES; seed++) {
        uint64_t subset[COUNT];
        unsigned bits = 0;
        ps_random random = ps_random_init(seed, PS_STREAM_FREQUENCIES, 0);
        assert_ok(ps_random_subset(subset, COUNT, POPULATION, &random, error));
        for (size_t i = 0; i < COUNT; i++) {
            assert_true(subset[i] < POPULATION && (i == 0 || subset[i - 1] < subset[i]));
            bits |= 1u << subset[i];
        }
        by_bits[bits]++;
    }
    for (size_t i = 0; i < 1 << POPULATION; i++) {
        if (by_bits[i] > 0) {
            assert_true(num < NUM_SUBSETS);
            counts[num++] = by_bits[i];
        }
    }
    assert_int_equal(num, NUM_SUBSETS);
    check_chi_square(counts, NUM_SUBSETS, (double)TRIES / NUM_SUBSETS);
}

static void subsets_of_any_size(void **state) {
    (void)state;
    const uint64_t populations[] = {1, 2, 100, 1000, UINT64_C(1) << 40, UINT64_MAX - 1};
    uint64_t subset[1000];
    for (size_t p = 0; p < sizeof populations / sizeof populations[0]; p++) {
        const size_t most = populations[p] < 1000 ? (size_t)populations[p] : 1000;
        for (size_t count = 1; count <= most; count += count < 4          ? 1
                                                       : most - count > 0 ? most - count
                                                                          : 1) {
            ps_random random = ps_random_init(3, PS_STREAM_FREQUENCIES, p);
            assert_ok(ps_random_subset(subset, count, populations[p], &random, error));
            for (size_t i = 0; i < count; i++) {
                assert_true(subset[i] < populations[p] && (i == 0 || subset[i - 1] < subset[i]));
            }
        }
    }
}

/* ---- subsets of rings -------------------------------------------------------------------- */

static const ps_bin_rule rings = {.kind = PS_BINS_ROUND};
static const ps_bin_rule shells = {.kind = PS_BINS_SHELLS};

static ps_frequencies draw(unsigned dimension, int32_t k, const ps_bin_rule *rule,
                           uint64_t per_ring, uint64_t seed) {
    ps_frequencies set = {0};
    const ps_frequency_sample sample = {dimension, k, *rule, per_ring, seed};
    assert_ok(ps_frequencies_sample(&set, &sample, error));
    return set;
}

static ps_bins bins_of(const ps_frequencies *set) {
    ps_bins bins = {0};
    assert_ok(ps_bins_create(&bins, set, error));
    return bins;
}

/* The rings of the whole ball: sizes and means must be theirs, and small rings complete. */
static void check_against_ball(unsigned dimension, int32_t k, const ps_bin_rule *rule,
                               uint64_t per_ring) {
    ps_frequencies ball = {0};
    assert_ok(ps_frequencies_grid(&ball, dimension, k, true, rule, 0, error));
    assert_ok(ps_frequencies_enumerate(&ball, error));
    ps_frequencies set = draw(dimension, k, rule, per_ring, 7);
    assert_true(set.rings != NULL && set.max_frequency == k && set.per_ring == per_ring);
    assert_int_equal(ps_frequencies_population(&set), ball.num);
    ps_bins bins = bins_of(&set);
    ps_bins all = bins_of(&ball);
    assert_int_equal(bins.num, all.num);
    assert_int_equal(bins.num_reported, all.num);
    for (size_t b = 0; b < all.num; b++) {
        const ps_bin *bin = &bins.bins[b];
        const uint64_t size = all.bins[b].end - all.bins[b].begin;
        assert_int_equal(bin->key, all.bins[b].key);
        assert_int_equal(bin->num_frequencies, size);
        assert_int_equal(all.bins[b].num_frequencies, size);
        assert_true(fabs(bin->mean_frequency / all.bins[b].mean_frequency - 1) < 1e-13);
        assert_int_equal(bin->end - bin->begin, size < per_ring ? size : per_ring);
        for (size_t i = bin->begin; i < bin->end; i++) { /* ring by ring, in order, none twice */
            const int32_t *const v = set.vectors + i * dimension;
            assert_int_equal(bins.members[i], i);
            assert_true(ps_frequency_is_in_half_lattice(v, dimension));
            unsigned axis = 0;
            while (i > bin->begin && v[axis] == v[(int)axis - (int)dimension]) {
                axis++;
                assert_true(axis < dimension);
            }
            assert_true(i == bin->begin || v[axis] > v[(int)axis - (int)dimension]);
        }
    }
    ps_bins_free(&bins);
    ps_bins_free(&all);
    ps_frequencies_free(&set);
    ps_frequencies_free(&ball);
}

static void rings_and_shells_of_every_dimension(void **state) {
    (void)state;
    static const int32_t most[] = {0, 20, 9, 5, 4, 3};
    static const ps_bin_rule widths[] = {{PS_BINS_WIDTH, 1, 1, 0, 0},
                                         {PS_BINS_WIDTH, 3, 2, 0, 0},
                                         {PS_BINS_WIDTH, 5, 8, 0, 0},
                                         {PS_BINS_RELATIVE, 2, 3, 0, 0}};
    for (unsigned dimension = 2; dimension <= PS_MAX_DIMENSION; dimension++) {
        for (uint64_t per_ring = 2; per_ring <= 8; per_ring += 3) {
            check_against_ball(dimension, most[dimension - 1], &rings, per_ring);
            check_against_ball(dimension, most[dimension - 1], &shells, per_ring > 4 ? 3 : 2);
            for (size_t i = 0; i < sizeof widths / sizeof widths[0]; i++) {
                ps_bin_rule rule = widths[i];
                ps_bin_rule_resolve(&rule, dimension, 3);
                check_against_ball(dimension, most[dimension - 1], &rule, 2);
            }
        }
    }
}

static bool is_prefix(const ps_frequencies *a, const ps_frequencies *b) {
    return a->num <= b->num &&
           memcmp(a->vectors, b->vectors, a->num * a->dimension * sizeof(int32_t)) == 0;
}

/* The same seed gives the same subset, also when K grows; another one another. */
static void subsets_depend_on_the_seed_alone(void **state) {
    (void)state;
    ps_frequencies small = draw(4, 6, &rings, 20, 1);
    ps_frequencies again = draw(4, 6, &rings, 20, 1);
    ps_frequencies large = draw(4, 9, &rings, 20, 1);
    ps_frequencies other = draw(4, 6, &rings, 20, 2);
    assert_true(small.num == again.num && is_prefix(&small, &again));
    assert_true(small.num < large.num && is_prefix(&small, &large));
    assert_int_equal(small.num, other.num);
    assert_false(is_prefix(&small, &other));
    ps_frequencies_free(&small);
    ps_frequencies_free(&again);
    ps_frequencies_free(&large);
    ps_frequencies_free(&other);
}

/* Published numbers depend on what is drawn: it never changes. */
static void what_is_drawn_is_fixed(void **state) {
    (void)state;
    static const int32_t expected[] = {1, -11, 30, 24, 1, 15, 33, 17};
    ps_frequencies set = draw(4, 40, &rings, 2, 1);
    const int32_t *const last = set.vectors + (set.num - 2) * 4;
    assert_memory_equal(last, expected, sizeof expected);
    ps_frequencies_free(&set);
}

/* Every frequency of a ring is drawn equally often. */
static void frequencies_are_uniform(void **state) {
    (void)state;
    enum { DIMENSION = 4, RING = 3, PER_RING = 20, TRIES = 3000, SIDE = 2 * RING + 1 };
    size_t by_place[SIDE * SIDE * SIDE * SIDE] = {0};
    size_t num = 0;
    uint64_t size = 0;
    for (uint64_t seed = 0; seed < TRIES; seed++) {
        ps_frequencies set = draw(DIMENSION, RING, &rings, PER_RING, seed);
        size = set.rings[RING - 1].num_frequencies;
        for (size_t i = set.num - PER_RING; i < set.num; i++) {
            size_t place = 0;
            for (unsigned axis = 0; axis < DIMENSION; axis++) {
                place = place * SIDE + (size_t)(set.vectors[i * DIMENSION + axis] + RING);
            }
            by_place[place]++;
        }
        ps_frequencies_free(&set);
    }
    for (size_t i = 0; i < sizeof by_place / sizeof by_place[0]; i++) {
        if (by_place[i] > 0) { /* in place: num never overtakes i */
            const size_t count = by_place[i];
            by_place[num++] = count;
        }
    }
    assert_int_equal(num, size);
    check_chi_square(by_place, num, (double)TRIES * PER_RING / (double)size);
}

static void complete_rings_are_the_ball(void **state) {
    (void)state;
    ps_frequencies set = draw(3, 4, &rings, 1000, 1);
    assert_true(set.kind == PS_FREQUENCIES_BALL && set.rings == NULL && set.per_ring == 0);
    ps_frequencies_free(&set);
    set = draw(1, 1000000, &rings, 2, 1); /* a ring of the line has one frequency */
    assert_true(set.kind == PS_FREQUENCIES_BALL);
    ps_frequencies_free(&set);
}

static void hopeless_requests(void **state) {
    (void)state;
    const struct {
        ps_frequency_sample sample;
        const char *part;
    } cases[] = {{{4, 10, {.kind = PS_BINS_ROUND}, 0, 1}, "at least 2"},
                 {{4, 10, {.kind = PS_BINS_ROUND}, 1, 1}, "at least 2"},
                 {{0, 10, {.kind = PS_BINS_ROUND}, 9, 1}, "dimension 0"},
                 {{7, 10, {.kind = PS_BINS_ROUND}, 9, 1}, "dimension 7"},
                 {{4, 0, {.kind = PS_BINS_ROUND}, 9, 1}, "max frequency 0"},
                 {{1, 0, {.kind = PS_BINS_ROUND}, 9, 1}, "max frequency 0"},
                 {{4, -1, {.kind = PS_BINS_ROUND}, 9, 1}, "max frequency -1"},
                 {{4, 2001, {.kind = PS_BINS_ROUND}, 9, 1}, "between 1 and 2000"},
                 {{6, 1236, {.kind = PS_BINS_ROUND}, 9, 1}, "more than can be counted"},
                 {{3, 4, {PS_BINS_WIDTH, 6, 1, 0, 0}, 9, 1}, "none of them is complete"},
                 {{5, 300, {PS_BINS_WIDTH, 1, 1, 0, 0}, 100000000, 1}, "which can be indexed"},
                 {{5, 300, {.kind = PS_BINS_SHELLS}, 1000000, 1}, "which can be indexed"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        ps_frequencies set;
        ps_error message = {0};
        assert_int_equal(ps_frequencies_sample(&set, &cases[i].sample, &message),
                         PSPEC_ERROR_INVALID_ARGUMENT);
        if (strstr(message.message, cases[i].part) == NULL) {
            fail_msg("\"%s\" is not in \"%s\"", cases[i].part, message.message);
        }
        ps_frequencies_free(&set);
    }
}

/* A list that was drawn from rings fits no other bins. */
static void bins_must_be_those_that_were_drawn_from(void **state) {
    (void)state;
    ps_frequencies set = draw(3, 6, &rings, 4, 1);
    ps_bins bins = {0};
    ps_error message = {0};
    set.bins = shells;
    assert_int_equal(ps_bins_create(&bins, &set, &message), PSPEC_ERROR_INPUT);
    assert_null(bins.bins);
    ps_frequencies_free(&set);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(subsets_are_uniform),
        cmocka_unit_test(subsets_of_any_size),
        cmocka_unit_test(rings_and_shells_of_every_dimension),
        cmocka_unit_test(subsets_depend_on_the_seed_alone),
        cmocka_unit_test(what_is_drawn_is_fixed),
        cmocka_unit_test(frequencies_are_uniform),
        cmocka_unit_test(complete_rings_are_the_ball),
        cmocka_unit_test(hopeless_requests),
        cmocka_unit_test(bins_must_be_those_that_were_drawn_from),
    };
    return cmocka_run_group_tests_name("frequency_sample", tests, NULL, NULL);
}
