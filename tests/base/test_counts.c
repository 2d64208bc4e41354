/* Lists of numbers that people type. */
#include "harness.h"

#include "base/counts.h"

#include <stdio.h>
#include <string.h>

enum { ROOM = 64 };

static void lists_that_are_read(void **state) {
    (void)state;
    static const struct {
        const char *text, *numbers;
    } cases[] = {
        {"1024", "1024"},
        {"1e3", "1000"},
        {"64,128,256", "64 128 256"},
        {"256,64", "256 64"},
        {"16..256", "16 32 64 128 256"},
        {"16..255", "16 32 64 128"},
        {"7..7", "7"},
        {"7..13", "7"},
        {"3..24", "3 6 12 24"},
        {"1e2..4e2", "100 200 400"},
        {"16..64,100", "16 32 64 100"},
        {"5,16..32,100..300,1e3", "5 16 32 100 200 1000"},
        {"9223372036854775808..18446744073709551615", "9223372036854775808"},
        {"4611686018427387904..18446744073709551615", "4611686018427387904 9223372036854775808"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        uint64_t values[ROOM];
        char found[256] = "";
        ps_counts list = {.most = ROOM, .values = values};
        assert_ok(ps_counts_parse(&list, cases[i].text, "-n", 1, UINT64_MAX, error));
        for (size_t j = 0; j < list.num; j++) {
            const size_t length = strlen(found);
            snprintf(found + length, sizeof found - length, "%s%llu", j > 0 ? " " : "",
                     (unsigned long long)values[j]);
        }
        assert_string_equal(found, cases[i].numbers);
    }
}

static void lists_that_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *text, *sentence;
    } cases[] = {
        {"", "-n: \"\" is not a whole number"},
        {"0", "-n: 0 is not between 1 and 1000000"},
        {"0..4", "-n: 0 is not between 1 and 1000000"},
        {"16..1e7", "-n: 1e7 is not between 1 and 1000000"},
        {"16..8", "-n: \"16..8\": the first number is the larger one"},
        {"1e3..1e2", "-n: \"1e3..1e2\": the first number is the larger one"},
        {"..8", "-n: \"..8\": a range has two ends, as 16..256 has, which is 16,32,64,128,256"},
        {"8..", "-n: \"8..\": a range has two ends, as 16..256 has, which is 16,32,64,128,256"},
        {"..", "-n: \"..\": a range has two ends, as 16..256 has, which is 16,32,64,128,256"},
        {"8...16", "-n: \".16\" is not a whole number"},
        {"1..2..3", "-n: \"2..3\" is not a whole number"},
        {"1.5..3", "-n: \"1.5\" is not a whole number"},
        {"64,,128", "-n: \"64,,128\": a number is missing beside a comma"},
        {",64", "-n: \",64\": a number is missing beside a comma"},
        {"64,", "-n: \"64,\": a number is missing beside a comma"},
        {",", "-n: \",\": a number is missing beside a comma"},
        {"64, 128", "-n: \" 128\" is not a whole number"},
        {"64,128,64", "-n: 64 stands there twice"},
        {"16..64,32", "-n: 32 stands there twice"},
        {"64,6.4e1", "-n: 64 stands there twice"},
        {"1..64", "-n: \"1..64\" has more than 5 numbers"},
        {"5,6,7,8,9,10", "-n: \"5,6,7,8,9,10\" has more than 5 numbers"},
        {"1000000000000000000000000000000000000000000000000000000000000000000",
         "-n: \"1000000000000000000000000000000000000000000000000000000000000000000\" is not a "
         "whole number"},
        {"64,-3", "-n: -3 is not between 1 and 1000000"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        enum { FEW = 5 };
        uint64_t values[FEW];
        ps_counts list = {.most = FEW, .values = values};
        ps_error failure = {0};
        assert_int_equal(ps_counts_parse(&list, cases[i].text, "-n", 1, 1000000, &failure),
                         PSPEC_ERROR_INVALID_ARGUMENT);
        assert_string_equal(failure.message, cases[i].sentence);
    }
}

/* Items of a list that comes in pieces: what is refused in one of them is refused in all. */
static void texts_after_one_another(void **state) {
    (void)state;
    uint64_t values[ROOM];
    ps_counts list = {.most = ROOM, .values = values};
    ps_error failure = {0};
    assert_ok(ps_counts_parse(&list, "16..32", "points", 1, 1000, error));
    assert_ok(ps_counts_parse(&list, "100", "points", 1, 1000, error));
    assert_int_equal(list.num, 3);
    assert_int_equal(values[2], 100);
    assert_int_equal(ps_counts_parse(&list, "8..16", "points", 1, 1000, &failure),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_string_equal(failure.message, "points: 16 stands there twice");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lists_that_are_read),
        cmocka_unit_test(lists_that_are_refused),
        cmocka_unit_test(texts_after_one_another),
    };
    return cmocka_run_group_tests_name("counts", tests, NULL, NULL);
}
