/* Growing text, numbers that people type, edit distance. */
#include "harness.h"

#include "base/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void counts_that_are_read(void **state) {
    (void)state;
    const struct {
        const char *text;
        uint64_t value;
    } cases[] = {{"0", 0},
                 {"1024", 1024},
                 {"007", 7},
                 {"1e6", 1000000},
                 {"1E6", 1000000},
                 {"+5", 5},
                 {"4096.0", 4096},
                 {"2.5e1", 25},
                 {"9007199254740991", 9007199254740991},
                 {"9007199254740993", 9007199254740993}, /* no double */
                 {"18446744073709551615", UINT64_MAX}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        uint64_t value = 77;
        assert_ok(ps_parse_count(cases[i].text, "points", 0, UINT64_MAX, &value, error));
        assert_true(value == cases[i].value);
    }
}

static void counts_that_are_refused(void **state) {
    (void)state;
    const char *const texts[] = {"",     "-3",   "-1e3", "1.5",  "1e400", "18446744073709551616",
                                 "0x10", " 5",   "5 ",   "1e30", "abc",   "1,000",
                                 "nan",  "inf",  "5x",   "--5",  "1e",    "99999999999999999999999",
                                 "\t7",  "0x1p4"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        uint64_t value = 0;
        ps_error said = {0};
        const pspec_status status =
            ps_parse_count(texts[i], "points", 0, UINT64_MAX, &value, &said);
        if (status != PSPEC_ERROR_INVALID_ARGUMENT) {
            fail_msg("the count \"%s\" is read as %llu", texts[i], (unsigned long long)value);
        }
        assert_non_null(strstr(said.message, "points"));
        assert_non_null(strstr(said.message, texts[i]));
    }
}

static void limits_of_counts(void **state) {
    (void)state;
    uint64_t value = 0;
    ps_error said = {0};
    assert_ok(ps_parse_count("3", "dimension", 3, 6, &value, error));
    assert_ok(ps_parse_count("6e0", "dimension", 3, 6, &value, error));
    assert_int_equal(ps_parse_count("7", "dimension", 3, 6, &value, &said),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_string_equal(said.message, "dimension: 7 is not between 3 and 6");
    assert_int_equal(ps_parse_count("2", "dimension", 3, 6, &value, &said),
                     PSPEC_ERROR_INVALID_ARGUMENT);
}

static void numbers_that_are_read(void **state) {
    (void)state;
    const struct {
        const char *text;
        double value;
    } cases[] = {{"0", 0},         {"-3", -3},    {"1.5", 1.5},    {"1e-6", 1e-6},
                 {".5", 0.5},      {"5.", 5},     {"+2.25", 2.25}, {"0.1", 0.1},
                 {"1e308", 1e308}, {"1e-400", 0}, {"-0", 0}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        double value = 77;
        assert_ok(ps_parse_number(cases[i].text, "x", -INFINITY, INFINITY, &value, error));
        assert_true(value == cases[i].value);
    }
}

static void numbers_that_are_refused(void **state) {
    (void)state;
    const char *const texts[] = {"",     "1e400", "-1e400", "nan", "inf",  "-infinity",
                                 "1.5x", "1,5",   " 5",     "5 ",  "0x10", "."};
    double value = 0;
    ps_error said = {0};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        if (ps_parse_number(texts[i], "tolerance", -INFINITY, INFINITY, &value, &said) !=
            PSPEC_ERROR_INVALID_ARGUMENT) {
            fail_msg("the number \"%s\" is read as %g", texts[i], value);
        }
        assert_non_null(strstr(said.message, "tolerance"));
    }
    assert_int_equal(ps_parse_number("2", "share", 0, 1, &value, &said),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_string_equal(said.message, "share: 2 is not between 0 and 1");
    assert_ok(ps_parse_number("1", "share", 0, 1, &value, error));
}

/* ---- distance ---------------------------------------------------------------------------- */

static void known_distances(void **state) {
    (void)state;
    assert_int_equal(ps_text_distance("", ""), 0);
    assert_int_equal(ps_text_distance("", "abc"), 3);
    assert_int_equal(ps_text_distance("kitten", "sitting"), 3);
    assert_int_equal(ps_text_distance("flaw", "lawn"), 2);
    assert_int_equal(ps_text_distance("torus_direct", "torus-direct"), 1);
    assert_int_equal(ps_text_distance("ab", "ba"), 2);
}

/* A metric: symmetric, 0 for equal texts only, triangle inequality. */
static void distance_is_a_metric(void **state) {
    (void)state;
    uint64_t seed = 9;
    for (int i = 0; i < 2000; i++) {
        char texts[3][9];
        for (size_t t = 0; t < 3; t++) {
            const size_t length = (size_t)(8 * test_uniform(&seed));
            for (size_t c = 0; c < length; c++) {
                texts[t][c] = (char)('a' + (int)(3 * test_uniform(&seed)));
            }
            texts[t][length] = '\0';
        }
        const size_t ab = ps_text_distance(texts[0], texts[1]);
        const size_t bc = ps_text_distance(texts[1], texts[2]);
        assert_int_equal(ab, ps_text_distance(texts[1], texts[0]));
        assert_true((ab == 0) == (strcmp(texts[0], texts[1]) == 0));
        assert_true(ps_text_distance(texts[0], texts[2]) <= ab + bc);
    }
}

/* Longer texts than any name do no harm. */
static void distance_of_long_texts(void **state) {
    (void)state;
    char longest[65];
    char longer[300];
    memset(longest, 'x', sizeof longest - 1);
    memset(longer, 'x', sizeof longer - 1);
    longest[64] = longer[299] = '\0';
    assert_int_equal(ps_text_distance(longest, ""), 64);
    assert_int_equal(ps_text_distance(longest, longest), 0);
    assert_true(ps_text_distance(longer, "name") >= 4);
    assert_true(ps_text_distance("name", longer) >= 4);
}

/* ---- growth ------------------------------------------------------------------------------ */

static void text_grows(void **state) {
    (void)state;
    enum { APPENDS = 20000 };
    ps_text text = {0};
    char number[16];
    assert_string_equal(ps_text_string(&text), "");
    for (int i = 0; i < APPENDS; i++) {
        ps_text_append(&text, "%05d,", i);
    }
    assert_false(text.failed);
    assert_int_equal(text.length, 6 * APPENDS);
    assert_int_equal(strlen(ps_text_string(&text)), text.length);
    for (int i = 0; i < APPENDS; i++) {
        snprintf(number, sizeof number, "%05d,", i);
        assert_memory_equal(text.data + 6 * i, number, 6);
    }
    ps_text_free(&text);
    assert_string_equal(ps_text_string(&text), "");
}

static void text_takes_any_bytes(void **state) {
    (void)state;
    ps_text text = {0};
    ps_text_append_bytes(&text, "a\0b", 3);
    ps_text_append_bytes(&text, "", 0);
    ps_text_append(&text, "%s", "");
    assert_int_equal(text.length, 3);
    assert_memory_equal(text.data, "a\0b", 4);
    ps_text_free(&text);
    char *longer = malloc(100001);
    assert_non_null(longer);
    memset(longer, 'y', 100000);
    longer[100000] = '\0';
    ps_text_append(&text, "<%s>", longer);
    assert_int_equal(text.length, 100002);
    assert_true(text.data[100001] == '>');
    free(longer);
    ps_text_free(&text);
}

static void characters_of_utf8(void **state) {
    static const struct {
        const char *text;
        size_t length;
    } cases[] = {{"", 0},
                 {"a", 1},
                 {"~", 1},
                 {"\n", 0},
                 {"\x7f", 0},
                 {"\xc2\x80", 0}, /* a control character */
                 {"\xc2\xa0", 2},
                 {"\xc3", 0},
                 {"\xc3(", 0},
                 {"\xc0\x80", 0},
                 {"\xe0\x80\xaf", 0}, /* not the shortest form */
                 {"\xe2\x88\x9e", 3},
                 {"\xed\xa0\x80", 0}, /* a half of a pair */
                 {"\xef\xbf\xbd", 3},
                 {"\xef\xbf\xbf", 0},
                 {"\xf0\x9f\x8e\xb2", 4},
                 {"\xf4\x90\x80\x80", 0}, /* beyond the last */
                 {"\xff", 0}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_int_equal(ps_text_character(cases[i].text), cases[i].length);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(characters_of_utf8),      cmocka_unit_test(counts_that_are_read),
        cmocka_unit_test(counts_that_are_refused), cmocka_unit_test(limits_of_counts),
        cmocka_unit_test(numbers_that_are_read),   cmocka_unit_test(numbers_that_are_refused),
        cmocka_unit_test(known_distances),         cmocka_unit_test(distance_is_a_metric),
        cmocka_unit_test(distance_of_long_texts),  cmocka_unit_test(text_grows),
        cmocka_unit_test(text_takes_any_bytes),
    };
    return cmocka_run_group_tests_name("text", tests, NULL, NULL);
}
