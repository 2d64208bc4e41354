/* Philox and the stream layout. Known answers: kat_vectors of Random123 (Salmon et al., SC 2011).
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "math/random/random.h"

/* Statistical checks fail by chance once in 16000 at 4 standard deviations; seeds are fixed. */
static const double SIGMAS = 4;

typedef struct known_answer {
    uint32_t counter[4], key[2], out[4];
} known_answer;

static const known_answer KNOWN_ANSWERS[] = {
    {{0, 0, 0, 0}, {0, 0}, {0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}},
    {{0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff},
     {0xffffffff, 0xffffffff},
     {0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}},
    {{0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, /* digits of pi */
     {0xa4093822, 0x299f31d0},
     {0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}},
};

static void philox_gives_the_known_answers(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof KNOWN_ANSWERS / sizeof KNOWN_ANSWERS[0]; i++) {
        uint32_t out[4];
        ps_philox_4x32_10(KNOWN_ANSWERS[i].counter, KNOWN_ANSWERS[i].key, out);
        assert_memory_equal(out, KNOWN_ANSWERS[i].out, sizeof out);
    }
}

static void streams_follow_the_documented_layout(void **state) {
    (void)state;
    const uint64_t seed = 0x1122334455667788u;
    const uint64_t realization = 0x99aabbccddeeff01u;
    const uint32_t key[2] = {0x55667788u, 0x11223344u};
    const uint32_t counter[4] = {2, 3u << 16, 0xddeeff01u, 0x99aabbccu};
    uint32_t expected[4];
    uint32_t block[4];
    ps_philox_4x32_10(counter, key, expected);
    ps_random random = ps_random_init(seed, PS_STREAM_SHIFT, realization);
    for (unsigned i = 0; i < 8; i++) {
        ps_random_u32(&random); /* blocks 0 and 1 */
    }
    ps_random_block(&random, 2, block);
    assert_memory_equal(block, expected, sizeof expected);
    for (unsigned i = 0; i < 4; i++) {
        assert_int_equal(ps_random_u32(&random), expected[i]);
    }
}

/* FNV-1a of "foobar" is 0x85944171f73967e8, that of nothing 0xcbf29ce484222325 (Fowler, Noll and
 * Vo's own vectors). */
static void seeds_of_texts_are_of_their_hashes(void **state) {
    (void)state;
    ps_random of_word = ps_random_init(9, PS_STREAM_TRIALS, UINT64_C(0x85944171f73967e8));
    ps_random of_nothing = ps_random_init(9, PS_STREAM_TRIALS, UINT64_C(0xcbf29ce484222325));
    assert_true(ps_random_seed_of(9, PS_STREAM_TRIALS, "foobar") == ps_random_u64(&of_word));
    assert_true(ps_random_seed_of(9, PS_STREAM_TRIALS, "") == ps_random_u64(&of_nothing));
    assert_true(ps_random_seed_of(9, PS_STREAM_SHIFT, "foobar") !=
                ps_random_seed_of(9, PS_STREAM_TRIALS, "foobar"));
}

static void block_index_has_48_bits(void **state) {
    (void)state;
    const uint32_t key[2] = {7, 0};
    const uint32_t counter[4] = {0, (1u << 16) | 0xabcd, 5, 0};
    uint32_t expected[4];
    uint32_t block[4];
    ps_philox_4x32_10(counter, key, expected);
    ps_random random = ps_random_init(7, PS_STREAM_PERMUTATION, 5);
    ps_random_block(&random, (uint64_t)0xabcd << 32, block);
    assert_memory_equal(block, expected, sizeof expected);
    random.counter[0] = UINT32_MAX; /* the next block is the last before the carry */
    random.counter[1] = (1u << 16) | 0xabcc;
    for (unsigned i = 0; i < 4; i++) {
        ps_random_u32(&random);
    }
    assert_int_equal(ps_random_u32(&random), expected[0]);
}

static void words_join_low_half_first(void **state) {
    (void)state;
    ps_random words = ps_random_init(3, PS_STREAM_COORDINATES, 0);
    ps_random joined = words;
    ps_random uniform = words;
    const uint64_t low = ps_random_u32(&words);
    const uint64_t expected = low | (uint64_t)ps_random_u32(&words) << 32;
    assert_true(ps_random_u64(&joined) == expected);
    assert_true(ps_random_uniform(&uniform) == (double)(expected >> 11) * 0x1p-53);
}

/* From every position within a block, for every length around the size of a chunk. */
static void fill_equals_one_at_a_time(void **state) {
    (void)state;
    enum { MOST = 70 };
    for (unsigned num_used = 0; num_used < 9; num_used++) {
        for (size_t count = 0; count <= MOST; count++) {
            double filled[MOST] = {0};
            ps_random one = ps_random_init(11, PS_STREAM_COORDINATES, 13);
            one.counter[0] = UINT32_MAX - 6; /* so that the carry falls among the lanes */
            for (unsigned i = 0; i < num_used; i++) {
                ps_random_u32(&one);
            }
            ps_random many = one;
            ps_random_fill_uniform(&many, filled, count);
            for (size_t i = 0; i < count; i++) {
                assert_true(filled[i] == ps_random_uniform(&one));
            }
            assert_int_equal(ps_random_u32(&many), ps_random_u32(&one));
        }
    }
}

static double chi_square(const unsigned *counts, unsigned num_bins, double expected) {
    double sum = 0;
    for (unsigned i = 0; i < num_bins; i++) {
        sum += (counts[i] - expected) * (counts[i] - expected) / expected;
    }
    return sum;
}

/* Chi-square with n degrees of freedom: mean n, variance 2n. */
static void assert_uniform(const unsigned *counts, unsigned num_bins, double expected) {
    const double degrees = num_bins - 1;
    assert_true(fabs(chi_square(counts, num_bins, expected) - degrees) <
                SIGMAS * sqrt(2 * degrees));
}

static void uniforms_fill_the_unit_square_evenly(void **state) {
    (void)state;
    enum { SIDE = 32, COUNT = 1 << 18 };
    unsigned counts[SIDE * SIDE] = {0};
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, 0);
    for (unsigned i = 0; i < COUNT; i++) {
        const double x = ps_random_uniform(&random);
        const double y = ps_random_uniform(&random);
        assert_true(x >= 0 && x < 1 && y >= 0 && y < 1);
        counts[(unsigned)(x * SIDE) * SIDE + (unsigned)(y * SIDE)]++;
    }
    assert_uniform(counts, SIDE * SIDE, (double)COUNT / (SIDE * SIDE));
}

/* Correlation of 12 (x - 1/2) (y - 1/2), which has mean 0 and variance 1 for independent x and y.
 */
static double correlation(ps_random a, ps_random b, unsigned count) {
    double sum = 0;
    for (unsigned i = 0; i < count; i++) {
        sum += 12 * (ps_random_uniform(&a) - 0.5) * (ps_random_uniform(&b) - 0.5);
    }
    return sum / sqrt(count);
}

static void streams_seeds_and_realizations_are_uncorrelated(void **state) {
    (void)state;
    enum { COUNT = 100000 };
    const ps_random base = ps_random_init(1, PS_STREAM_COORDINATES, 0);
    assert_true(fabs(correlation(base, ps_random_init(2, PS_STREAM_COORDINATES, 0), COUNT)) <
                SIGMAS);
    assert_true(fabs(correlation(base, ps_random_init(1, PS_STREAM_SCRAMBLE, 0), COUNT)) < SIGMAS);
    assert_true(fabs(correlation(base, ps_random_init(1, PS_STREAM_COORDINATES, 1), COUNT)) <
                SIGMAS);
    const ps_random next = ps_random_init(1, PS_STREAM_COORDINATES, (uint64_t)1 << 32);
    assert_true(fabs(correlation(base, next, COUNT)) < SIGMAS);
}

static void every_bit_is_balanced(void **state) {
    (void)state;
    enum { COUNT = 1 << 16, BITS = 64 };
    unsigned ones[BITS] = {0};
    ps_random random = ps_random_init(5, PS_STREAM_SCRAMBLE, 0);
    for (unsigned i = 0; i < COUNT; i++) {
        const uint64_t word = ps_random_u64(&random);
        for (unsigned b = 0; b < BITS; b++) {
            ones[b] += (unsigned)(word >> b & 1);
        }
    }
    for (unsigned b = 0; b < BITS; b++) {
        assert_true(fabs(ones[b] - COUNT / 2.0) < SIGMAS * sqrt(COUNT) / 2);
    }
}

static void below_is_unbiased_for_small_bounds(void **state) {
    (void)state;
    enum { LARGEST = 13, COUNT = 60060 };
    ps_random random = ps_random_init(9, PS_STREAM_PERMUTATION, 0);
    for (unsigned bound = 2; bound <= LARGEST; bound++) {
        unsigned counts[LARGEST] = {0};
        for (unsigned i = 0; i < COUNT; i++) {
            const uint64_t value = ps_random_below(&random, bound);
            assert_true(value < bound);
            counts[value]++;
        }
        assert_uniform(counts, bound, (double)COUNT / bound);
    }
    assert_int_equal(ps_random_below(&random, 1), 0);
}

/* At 3/4 of the range a remainder without rejection would favour the first third 2 : 1. */
static void below_is_unbiased_for_large_bounds(void **state) {
    (void)state;
    enum { COUNT = 30000, THIRDS = 3 };
    const uint64_t bounds[] = {(uint64_t)3 << 30, (uint64_t)3 << 62, ((uint64_t)3 << 32) + 3};
    ps_random random = ps_random_init(10, PS_STREAM_PERMUTATION, 0);
    for (size_t i_bound = 0; i_bound < sizeof bounds / sizeof bounds[0]; i_bound++) {
        unsigned counts[THIRDS] = {0};
        for (unsigned i = 0; i < COUNT; i++) {
            const uint64_t value = ps_random_below(&random, bounds[i_bound]);
            assert_true(value < bounds[i_bound]);
            counts[value / (bounds[i_bound] / THIRDS)]++;
        }
        assert_uniform(counts, THIRDS, (double)COUNT / THIRDS);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(philox_gives_the_known_answers),
        cmocka_unit_test(streams_follow_the_documented_layout),
        cmocka_unit_test(seeds_of_texts_are_of_their_hashes),
        cmocka_unit_test(block_index_has_48_bits),
        cmocka_unit_test(words_join_low_half_first),
        cmocka_unit_test(fill_equals_one_at_a_time),
        cmocka_unit_test(uniforms_fill_the_unit_square_evenly),
        cmocka_unit_test(streams_seeds_and_realizations_are_uncorrelated),
        cmocka_unit_test(every_bit_is_balanced),
        cmocka_unit_test(below_is_unbiased_for_small_bounds),
        cmocka_unit_test(below_is_unbiased_for_large_bounds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
