/* Rules of bins: borders in whole numbers, words, limits. */
#include "harness.h"

#include "frequencies/bin_rule.h"

#include <stdio.h>
#include <string.h>

__extension__ typedef unsigned __int128 wide; /* not in ISO C */

/* (b P)^(2e) N^(2f) <= Q^(2e) n^e, in numbers that fit. */
static bool reaches(const ps_bin_rule *rule, int64_t bin, int64_t norm2) {
    const bool is_relative = rule->kind == PS_BINS_RELATIVE;
    wide border = is_relative ? (wide)rule->num_points * rule->num_points : 1;
    wide norm = 1;
    for (unsigned i = 0; i < (is_relative ? rule->dimension : 1); i++) {
        border *= (wide)bin * (wide)bin * rule->numerator * rule->numerator;
        norm *= (wide)norm2 * rule->denominator * rule->denominator;
    }
    return border <= norm;
}

static void check_norm(const ps_bin_rule *rule, int64_t norm2) {
    const int64_t bin = ps_bin_rule_find(rule, norm2);
    if (!reaches(rule, bin, norm2) || reaches(rule, bin + 1, norm2)) {
        fail_msg("|k|^2 = %lld is not in bin %lld of %s", (long long)norm2, (long long)bin,
                 ps_bin_rule_write(rule).text);
    }
}

static void bins_of_small_norms(void **state) {
    (void)state;
    static const ps_bin_rule rules[] = {
        {PS_BINS_WIDTH, 1, 1, 0, 0},      {PS_BINS_WIDTH, 1, 7, 0, 0},
        {PS_BINS_WIDTH, 22, 7, 0, 0},     {PS_BINS_WIDTH, 1000000, 999999, 0, 0},
        {PS_BINS_RELATIVE, 1, 8, 1, 3},   {PS_BINS_RELATIVE, 1, 8, 2, 1024},
        {PS_BINS_RELATIVE, 1, 1, 2, 2},   {PS_BINS_RELATIVE, 3, 4, 2, 50},
        {PS_BINS_RELATIVE, 1, 10, 3, 10}, {PS_BINS_RELATIVE, 1, 10, 3, 1000},
        {PS_BINS_RELATIVE, 1, 3, 4, 5}};
    for (size_t i = 0; i < sizeof rules / sizeof rules[0]; i++) {
        for (int64_t norm2 = 1; norm2 <= 20000; norm2++) {
            check_norm(&rules[i], norm2);
        }
    }
}

/* Both sides of borders that whole norms meet, and of others, where doubles cannot tell. */
static void borders_of_large_norms(void **state) {
    (void)state;
    static const ps_bin_rule rules[] = {{PS_BINS_WIDTH, 1, 1, 0, 0},
                                        {PS_BINS_WIDTH, 3, 1000, 0, 0},
                                        {PS_BINS_WIDTH, 999983, 1000, 0, 0}};
    for (size_t i = 0; i < sizeof rules / sizeof rules[0]; i++) {
        for (int64_t k = ((int64_t)1 << 28) - 500; k < (int64_t)1 << 28; k++) {
            for (int64_t off = -1; off <= 1; off++) {
                check_norm(&rules[i], 6 * k * k + off);
                check_norm(&rules[i], k * k + off);
            }
        }
    }
}

/* Where N^(1/d) is a whole number, relative widths are widths. */
static void roots_that_are_whole(void **state) {
    (void)state;
    const struct {
        unsigned dimension;
        uint64_t num_points, root;
    } cases[] = {{1, 17, 17},  {2, 1024, 32},   {2, 10000000000, 100000}, {3, 1000000, 100},
                 {4, 4096, 8}, {5, 100000, 10}, {6, 64000000, 20},        {6, 729, 3}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        for (uint32_t p = 1; p <= 5; p += 2) {
            ps_bin_rule width = {PS_BINS_WIDTH, p * (uint32_t)cases[i].root, 64, 0, 0};
            ps_bin_rule relative = {PS_BINS_RELATIVE, p, 64, 0, 0};
            ps_bin_rule_resolve(&relative, cases[i].dimension, cases[i].num_points);
            ps_bin_rule_resolve(&width, cases[i].dimension, cases[i].num_points);
            assert_int_equal(width.num_points, 0);
            for (int64_t norm2 = 1; norm2 < (int64_t)1 << 50; norm2 += 1 + norm2 / 300) {
                const int64_t bin = ps_bin_rule_find(&width, norm2);
                assert_int_equal(ps_bin_rule_find(&relative, norm2), bin);
                assert_int_equal(ps_bin_rule_low(&relative, bin), ps_bin_rule_low(&width, bin));
            }
            for (int64_t k = 1; k < 3000; k++) { /* borders themselves */
                const int64_t norm2 = k * k * 64 * 64;
                assert_int_equal(ps_bin_rule_find(&relative, norm2),
                                 ps_bin_rule_find(&width, norm2));
            }
        }
    }
}

static void bins_begin_where_they_should(void **state) {
    (void)state;
    static const ps_bin_rule rules[] = {
        {.kind = PS_BINS_ROUND},       {.kind = PS_BINS_SHELLS},
        {PS_BINS_WIDTH, 1, 1, 0, 0},   {PS_BINS_WIDTH, 1, 9, 0, 0},
        {PS_BINS_WIDTH, 17, 3, 0, 0},  {PS_BINS_RELATIVE, 1, 8, 2, 300},
        {PS_BINS_RELATIVE, 1, 5, 3, 7}};
    for (size_t i = 0; i < sizeof rules / sizeof rules[0]; i++) {
        int64_t last = ps_bin_rule_find(&rules[i], 1);
        for (int64_t norm2 = 2; norm2 <= 3000; norm2++) {
            const int64_t bin = ps_bin_rule_find(&rules[i], norm2);
            for (int64_t b = last + 1; b <= bin; b++) { /* those between are empty */
                assert_int_equal(ps_bin_rule_low(&rules[i], b), norm2);
            }
            last = bin;
        }
    }
}

/* In the plane: no bin up to the largest norm has a frequency outside the box, and the next one
 * has. */
static void complete_bins(void **state) {
    (void)state;
    static const ps_bin_rule rules[] = {
        {.kind = PS_BINS_ROUND},      {PS_BINS_WIDTH, 1, 1, 0, 0},
        {PS_BINS_WIDTH, 2, 7, 0, 0},  {PS_BINS_WIDTH, 5, 2, 0, 0},
        {PS_BINS_WIDTH, 40, 1, 0, 0}, {PS_BINS_RELATIVE, 1, 8, 2, 300}};
    for (size_t i = 0; i < sizeof rules / sizeof rules[0]; i++) {
        for (int32_t k = 1; k <= 60; k++) {
            const int64_t largest = ps_bin_rule_largest(&rules[i], k);
            const int64_t outside = (int64_t)(k + 1) * (k + 1);
            assert_true(largest >= 0 && largest < outside);
            if (largest > 0) {
                assert_true(ps_bin_rule_find(&rules[i], largest) <
                            ps_bin_rule_find(&rules[i], outside));
            }
            assert_int_equal(ps_bin_rule_find(&rules[i], largest + 1),
                             ps_bin_rule_find(&rules[i], outside));
        }
    }
    const ps_bin_rule shells = {.kind = PS_BINS_SHELLS};
    assert_int_equal(ps_bin_rule_largest(&shells, 10), 110);
    assert_int_equal(ps_bin_rule_largest(&rules[0], 10), 110);
    assert_int_equal(ps_bin_rule_largest(&rules[1], 10), 120);
    assert_int_equal(ps_bin_rule_largest(&rules[4], 10), 0);
}

static void words(void **state) {
    (void)state;
    static const char *const good[][2] = {{"round", "round"},
                                          {"floor", "floor"},
                                          {"shells", "shells"},
                                          {"width=1/1", "floor"},
                                          {"width=1", "floor"},
                                          {"width=3", "width=3/1"},
                                          {"width=4/6", "width=2/3"},
                                          {"relative=1/1", "relative=1/1"},
                                          {"relative=0001000/1000000", "relative=1/1000"}};
    static const char *const bad[] = {"",
                                      "Round",
                                      "rings",
                                      "width",
                                      "width=",
                                      "width=0",
                                      "width=1/0",
                                      "width=0/1",
                                      "width=-1/2",
                                      "width=1/2/",
                                      "width=1//2",
                                      "width=1.5",
                                      "width= 1/2",
                                      "width=1/2 ",
                                      "relative",
                                      "relative=",
                                      "relative=x/2",
                                      "floor=1/2",
                                      "shells=2",
                                      "width=1e3/2",
                                      "width=+1",
                                      "roundx",
                                      "width=1000001",
                                      "width=1/1000001",
                                      "width=99999999999999999999"};
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        ps_bin_rule rule;
        ps_bin_rule again;
        assert_ok(ps_bin_rule_parse(&rule, "--bins", good[i][0], error));
        assert_string_equal(ps_bin_rule_write(&rule).text, good[i][1]);
        assert_ok(ps_bin_rule_parse(&again, "--bins", good[i][1], error));
        assert_true(ps_bin_rule_is_same(&rule, &again));
    }
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        ps_bin_rule rule;
        ps_error said = {0};
        assert_int_equal(ps_bin_rule_parse(&rule, "--bins", bad[i], &said),
                         PSPEC_ERROR_INVALID_ARGUMENT);
        assert_non_null(strstr(said.message, PS_BIN_RULES));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bins_of_small_norms),  cmocka_unit_test(borders_of_large_norms),
        cmocka_unit_test(roots_that_are_whole), cmocka_unit_test(bins_begin_where_they_should),
        cmocka_unit_test(complete_bins),        cmocka_unit_test(words),
    };
    return cmocka_run_group_tests_name("bin_rule", tests, NULL, NULL);
}
