/* Rings and shells against their definition. */
#include "harness.h"

#include "spectra/accumulate/accumulate_device.h"
#include "spectra/bins.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

static void check_ring(int64_t norm2) {
    const int64_t b = ps_ring_of_norm2(norm2);
    if (!(b >= 1 && b * b - b + 1 <= norm2 && norm2 <= b * b + b)) {
        fail_msg("|k|^2 = %lld is not in ring %lld", (long long)norm2, (long long)b);
    }
}

static void rings_of_small_norms(void **state) {
    (void)state;
    for (int64_t norm2 = 1; norm2 <= 1000000; norm2++) {
        check_ring(norm2);
    }
}

/* Both sides of the edges of large rings, up to beyond what a double holds exactly. */
static void rings_of_large_norms(void **state) {
    (void)state;
    const int64_t centres[] = {(int64_t)1 << 25, (int64_t)1 << 26, 94906265 /* sqrt 2^53 */,
                               (int64_t)1 << 28, (int64_t)3 << 28};
    for (size_t i = 0; i < sizeof centres / sizeof centres[0]; i++) {
        for (int64_t b = centres[i] - 1000; b <= centres[i] + 1000; b++) {
            assert_int_equal(ps_ring_of_norm2(b * b - b), b - 1);
            assert_int_equal(ps_ring_of_norm2(b * b - b + 1), b);
            assert_int_equal(ps_ring_of_norm2(b * b), b);
            assert_int_equal(ps_ring_of_norm2(b * b + b), b);
            assert_int_equal(ps_ring_of_norm2(b * b + b + 1), b + 1);
        }
    }
    for (int64_t norm2 = ((int64_t)1 << 50) - 100000; norm2 < ((int64_t)1 << 50) + 100000;
         norm2++) {
        check_ring(norm2);
    }
}

/* ---- bins of lattices -------------------------------------------------------------------- */

static const ps_bin_rule rings = {.kind = PS_BINS_ROUND};
static const ps_bin_rule shells = {.kind = PS_BINS_SHELLS};

/* Borders that are whole fractions: b P <= Q |k| < (b + 1) P, and b + 1/2 by rounding. */
static int64_t bin_by_definition(const ps_bin_rule *rule, int64_t norm2) {
    const int64_t p = rule->numerator;
    const int64_t q = rule->denominator;
    int64_t b = 0;
    if (rule->kind == PS_BINS_SHELLS) {
        return norm2;
    }
    if (rule->kind == PS_BINS_ROUND) {
        while (b * b + b < norm2) {
            b++;
        }
        return b;
    }
    while ((b + 1) * (b + 1) * p * p <= q * q * norm2) {
        b++;
    }
    return b;
}

/* A bin is reported when the box has all of it: all below the first |k|^2 that it lacks. */
static int64_t key_by_definition(const ps_frequencies *set, const ps_bin_rule *rule,
                                 const int32_t *k) {
    const int64_t norm2 = ps_frequency_norm2(k, set->dimension);
    const int64_t outside = (int64_t)(set->max_frequency + 1) * (set->max_frequency + 1);
    const ps_bin_rule *const by = rule->kind == PS_BINS_SHELLS ? &rings : rule;
    return bin_by_definition(by, norm2) >= bin_by_definition(by, outside)
               ? INT64_MAX
               : bin_by_definition(rule, norm2);
}

/* Every frequency once, in its bin, bins ascending and not empty, mean |k| right. */
static void check_members(const ps_bins *bins, const ps_frequencies *set, const ps_bin_rule *rule) {
    bool *is_seen = calloc(set->num + 1, sizeof *is_seen);
    assert_int_equal(bins->num_members, set->num);
    for (size_t b = 0; b < bins->num; b++) {
        const ps_bin *bin = &bins->bins[b];
        long double sum = 0;
        assert_true(bin->begin < bin->end);
        assert_int_equal(bin->begin, b == 0 ? 0 : bins->bins[b - 1].end);
        assert_true(b == 0 || bins->bins[b - 1].key < bin->key);
        for (size_t i = bin->begin; i < bin->end; i++) {
            const int32_t *k = set->vectors + bins->members[i] * set->dimension;
            assert_false(is_seen[bins->members[i]]);
            is_seen[bins->members[i]] = true;
            assert_true(i == bin->begin || bins->members[i - 1] < bins->members[i]);
            assert_int_equal(key_by_definition(set, rule, k), bin->key);
            sum += sqrtl((long double)ps_frequency_norm2(k, set->dimension));
        }
        const double mean = (double)(sum / (long double)(bin->end - bin->begin));
        assert_true(fabs(bin->mean_frequency / mean - 1) <=
                    (double)(bin->end - bin->begin) * DBL_EPSILON);
    }
    assert_int_equal(bins->num == 0 ? 0 : bins->bins[bins->num - 1].end, set->num);
    free(is_seen);
}

/* The lattice sum of a Gaussian, bin by bin, is that of one axis to the power d: DC is in no bin,
 * and every other k is in one, with its opposite. */
static void check_lattice_sum(const ps_bins *bins, const ps_frequencies *set) {
    const double rate = 0.1;
    double axis = 1;
    double sum = 1;
    for (int32_t k = 1; k <= set->max_frequency; k++) {
        axis += 2 * exp(-rate * k * k);
    }
    for (size_t i = 0; i < bins->num_members; i++) {
        const int32_t *const k = set->vectors + bins->members[i] * set->dimension;
        sum += 2 * exp(-rate * (double)ps_frequency_norm2(k, set->dimension));
    }
    const double relative = sum / pow(axis, set->dimension) - 1;
    assert_true(fabs(relative) < 1e-12);
}

static void check_bins(unsigned dimension, int32_t max_frequency, bool is_ball,
                       const ps_bin_rule *rule) {
    ps_frequencies set = {0};
    ps_bins bins = {0};
    assert_ok(ps_frequencies_grid(&set, dimension, max_frequency, is_ball, rule, 0, error));
    assert_ok(ps_frequencies_enumerate(&set, error));
    assert_ok(ps_bins_create(&bins, &set, error));
    check_members(&bins, &set, rule);
    const bool has_corners = bins.bins[bins.num - 1].key == INT64_MAX;
    assert_int_equal(bins.num_reported, bins.num - (has_corners ? 1 : 0));
    assert_true(!is_ball || !has_corners);
    if (!is_ball) {
        check_lattice_sum(&bins, &set);
    }
    if (rule->kind == PS_BINS_ROUND) { /* all rings 1..K are there */
        assert_int_equal(bins.num_reported, max_frequency);
        assert_int_equal(bins.bins[max_frequency - 1].key, max_frequency);
    }
    ps_bins_free(&bins);
    ps_frequencies_free(&set);
}

static void bins_of_lattices(void **state) {
    (void)state;
    static const int32_t frequencies[] = {50, 20, 9, 4, 2, 2};
    static const ps_bin_rule rules[] = {{.kind = PS_BINS_ROUND},      {.kind = PS_BINS_SHELLS},
                                        {PS_BINS_WIDTH, 1, 1, 0, 0},  {PS_BINS_WIDTH, 2, 1, 0, 0},
                                        {PS_BINS_WIDTH, 1, 3, 0, 0},  {PS_BINS_WIDTH, 7, 5, 0, 0},
                                        {PS_BINS_WIDTH, 13, 9, 0, 0}, {PS_BINS_WIDTH, 1, 64, 0, 0}};
    for (unsigned dimension = 1; dimension <= PS_MAX_DIMENSION; dimension++) {
        for (int32_t k = 1; k <= frequencies[dimension - 1]; k++) {
            for (size_t i = 0; i < sizeof rules / sizeof rules[0]; i++) {
                check_bins(dimension, k, false, &rules[i]);
                check_bins(dimension, k, true, &rules[i]);
            }
        }
    }
}

/* Keys of two and three digits of the sort in bins.c, with corners behind all of them. */
static void shells_of_large_keys(void **state) {
    (void)state;
    check_bins(2, 120, false, &shells);
    check_bins(2, 120, true, &shells);
    check_bins(1, 8300, false, &shells);
}

/* Numbers of lattice points that anyone can look up: r_2(25) = 12, r_2(65) = 16, r_3(9) = 30; rings
 * 1, 2, 3 of the plane have 8, 12 and 16 points by rounding, and 8, 16 and 20 by floor (Gauss's
 * circles of radius 1, 2, 3, 4 have 5, 13, 29 and 49, of which 4, 4, 4 and 4 lie on the last). */
static void known_counts(void **state) {
    (void)state;
    static const ps_bin_rule whole = {PS_BINS_WIDTH, 1, 1, 0, 0};
    const struct {
        unsigned dimension;
        const ps_bin_rule *rule;
        int64_t key;
        size_t count;
    } cases[] = {{2, &shells, 25, 12}, {2, &shells, 65, 16}, {3, &shells, 9, 30},
                 {1, &shells, 36, 2},  {2, &rings, 1, 8},    {2, &rings, 2, 12},
                 {2, &rings, 3, 16},   {4, &shells, 2, 24},  {2, &whole, 1, 8},
                 {2, &whole, 2, 16},   {2, &whole, 3, 20}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        ps_frequencies set = {0};
        ps_bins bins = {0};
        size_t count = 0;
        assert_ok(ps_frequencies_grid(&set, cases[i].dimension, 9, true, cases[i].rule, 0, error));
        assert_ok(ps_frequencies_enumerate(&set, error));
        assert_ok(ps_bins_create(&bins, &set, error));
        for (size_t b = 0; b < bins.num; b++) {
            if (bins.bins[b].key == cases[i].key) {
                count = 2 * (bins.bins[b].end - bins.bins[b].begin);
            }
        }
        assert_int_equal(count, cases[i].count);
        ps_bins_free(&bins);
        ps_frequencies_free(&set);
    }
}

/* A list is one bin that is not reported, in its own order. */
static void bins_of_lists(void **state) {
    (void)state;
    const int32_t vectors[] = {5, 5, 0, 1, -3, 4};
    int32_t *copy = malloc(sizeof vectors);
    ps_frequencies set = {0};
    ps_bins bins = {0};
    assert_non_null(copy);
    for (size_t i = 0; i < 6; i++) {
        copy[i] = vectors[i];
    }
    assert_ok(ps_frequencies_list(&set, 2, 3, copy, error));
    assert_ok(ps_bins_create(&bins, &set, error));
    assert_int_equal(bins.num, 1);
    assert_int_equal(bins.num_reported, 0);
    assert_int_equal(bins.bins[0].end - bins.bins[0].begin, 3);
    for (uint32_t i = 0; i < 3; i++) {
        assert_int_equal(bins.members[i], i);
    }
    ps_bins_free(&bins);
    ps_frequencies_free(&set);
}

/* ---- blocks of slots --------------------------------------------------------------------- */

/* Slots of a row with gaps, in an order far from that of frequencies. */
static void make_slots(uint32_t *slots, size_t num, size_t stride, size_t step) {
    for (size_t i = 0; i < num; i++) {
        slots[i] = (uint32_t)(i * step % stride);
    }
}

/* bin_of[slot] is 1 + the bin of the member there, 0 where there is none. */
static void find_bins(uint32_t *bin_of, const ps_bins *bins, const uint32_t *slots) {
    for (size_t b = 0; b < bins->num; b++) {
        for (size_t i = bins->bins[b].begin; i < bins->bins[b].end; i++) {
            bin_of[slots[bins->members[i]]] = (uint32_t)b + 1;
        }
    }
}

/* Every member is found once, in its block, in a piece of its bin; no piece is made twice. */
static void check_blocks(const ps_accumulate_blocks *blocks, uint32_t *bin_of, size_t stride) {
    bool *is_made = calloc(blocks->num_pieces, sizeof *is_made);
    size_t num_members = 0;
    for (size_t block = 0; block < blocks->num_blocks; block++) {
        for (uint32_t r = blocks->first_rings[block]; r < blocks->first_rings[block + 1]; r++) {
            const ps_block_ring *ring = &blocks->rings[r];
            assert_true(ring->first < ring->end && ring->piece < blocks->num_pieces);
            assert_false(is_made[ring->piece]);
            is_made[ring->piece] = true;
            for (uint32_t m = ring->first; m < ring->end; m++) {
                const size_t slot = block * PS_ACCUMULATE_BLOCK + blocks->members[m];
                assert_true(blocks->members[m] < PS_ACCUMULATE_BLOCK && slot < stride);
                assert_true(bin_of[slot] > 0);
                const uint32_t *pieces = blocks->bin_pieces[bin_of[slot] - 1];
                assert_true(pieces[0] <= ring->piece && ring->piece < pieces[1]);
                bin_of[slot] = 0;
                num_members++;
            }
        }
    }
    assert_int_equal(blocks->first_rings[blocks->num_blocks], blocks->num_pieces);
    assert_int_equal(num_members, blocks->num_members);
    free(is_made);
}

static void blocks_of_slots(void **state) {
    (void)state;
    const struct {
        unsigned dimension;
        int32_t max_frequency;
        size_t stride, step; /* no common divisor */
    } cases[] = {{2, 40, 3328, 1}, {2, 40, 9999, 1234}, {1, 1600, 2048, 1}, {3, 9, 4096, 77}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        ps_frequencies set = {0};
        ps_bins bins = {0};
        ps_accumulate_blocks blocks = {0};
        uint32_t *bin_of = calloc(cases[i].stride, sizeof *bin_of);
        assert_ok(
            ps_frequencies_lattice(&set, cases[i].dimension, cases[i].max_frequency, false, error));
        assert_ok(ps_frequencies_enumerate(&set, error));
        assert_ok(ps_bins_create(&bins, &set, error));
        uint32_t *slots = calloc(set.num, sizeof *slots);
        make_slots(slots, set.num, cases[i].stride, cases[i].step);
        find_bins(bin_of, &bins, slots);
        assert_ok(ps_accumulate_blocks_create(&blocks, &bins, slots, cases[i].stride, error));
        assert_int_equal(blocks.num_members, bins.num_members);
        check_blocks(&blocks, bin_of, cases[i].stride);
        ps_accumulate_blocks_free(&blocks);
        ps_bins_free(&bins);
        ps_frequencies_free(&set);
        free(slots);
        free(bin_of);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rings_of_small_norms), cmocka_unit_test(rings_of_large_norms),
        cmocka_unit_test(bins_of_lattices),     cmocka_unit_test(shells_of_large_keys),
        cmocka_unit_test(known_counts),         cmocka_unit_test(bins_of_lists),
        cmocka_unit_test(blocks_of_slots),
    };
    return cmocka_run_group_tests_name("bins", tests, NULL, NULL);
}
