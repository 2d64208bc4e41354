/* Decimal text against the C library, over many random tokens of all shapes that files hold. */
#include "files/decimal.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { TOKEN_BYTES = 512 };

static uint64_t next_random(uint64_t *state) { /* xorshift, Marsaglia 2003 */
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return *state;
}

static double next_unit(uint64_t *state) {
    return (double)(next_random(state) >> 11) * 0x1p-53;
}

/* The same end and the same bits as strtod. */
static void check_token(const char *token) {
    char padded[TOKEN_BYTES + PS_DECIMAL_PADDING];
    memset(padded, '7', sizeof padded); /* what follows must not matter */
    const size_t length = strlen(token);
    memcpy(padded, token, length);
    padded[length] = '\n';
    double value = 0;
    const char *const end = ps_decimal_parse(padded, &value);
    char *stop = NULL;
    const double expected = strtod(token, &stop);
    if (end != padded + (stop - token) || memcmp(&value, &expected, sizeof value) != 0) {
        fail_msg("\"%s\": %.17g, strtod says %.17g", token, value, expected);
    }
}

static void random_token(char *token, uint64_t *state) {
    enum { NUM_SHAPES = 8 };
    const double unit = next_unit(state);
    uint64_t bits = next_random(state);
    double any = 1;
    switch (next_random(state) % NUM_SHAPES) {
    case 0:
        snprintf(token, TOKEN_BYTES, "%.17g", unit);
        break;
    case 1:
        snprintf(token, TOKEN_BYTES, "%.*f", (int)(bits % 24), unit);
        break;
    case 2:
        snprintf(token, TOKEN_BYTES, "%+.*e", (int)(bits % 19), unit * 1e-3);
        break;
    case 3:
        snprintf(token, TOKEN_BYTES, "-0.%llu", (unsigned long long)bits);
        break;
    case 4:
        snprintf(token, TOKEN_BYTES, "%llu.%lluE-%d", (unsigned long long)(bits >> (bits % 64)),
                 (unsigned long long)(bits >> (bits % 61)), (int)(bits % 340));
        break;
    case 5: /* next to the middle of two doubles, where rounding is hardest */
        snprintf(token, TOKEN_BYTES, "%.*Lg", 16 + (int)(bits % 6),
                 ((long double)unit + (long double)nextafter(unit, 1)) / 2);
        break;
    case 6: /* any double there is */
        memcpy(&any, &bits, sizeof any);
        snprintf(token, TOKEN_BYTES, "%.*g", 1 + (int)(bits % 19), isfinite(any) ? any : 1);
        break;
    default:
        snprintf(token, TOKEN_BYTES, "%.*g", 1 + (int)(bits % 17), ldexp(unit, -(int)(bits % 60)));
    }
}

static void reads_like_strtod(void **state) {
    (void)state;
    uint64_t random = 88172645463325252U;
    char token[TOKEN_BYTES];
    for (int i = 0; i < 2000000; i++) {
        random_token(token, &random);
        check_token(token);
    }
}

static void reads_corner_cases(void **state) {
    (void)state;
    static const char *const tokens[] = {
        "0",
        "-0",
        "+0",
        "0.",
        ".0",
        "00000000000000000000000000001",
        "1e0",
        "1e",
        "1e+",
        "1ex",
        "1.5.5",
        "0.1e-5",
        "1e400",
        "-1e400",
        "1e-400",
        "1e99999999999999999999",
        "1e-99999999999999999999",
        "0e99999999999999999999",
        "4.9e-324",
        "2.4703282292062327e-324",
        "1.7976931348623157e308",
        "1.7976931348623159e308",
        "2.2250738585072011e-308",
        "9007199254740993",
        "9007199254740992.5",
        "18446744073709551615",
        "18446744073709551616",
        "0.500000000000000166533453693773481063544750213623046875",
        "0.50000000000000016653345369377348106354475021362304687500000000000000000000000001",
        "0.99999999999999994448884876874217297881841659545898437500",
        "0.99999999999999999999",
        "00000000000000000000000000000000000.1234567890123456789",
        "1234567812345678",
        "12345678.12345678",
        "1234567:",
        "1234567/",
        "12345678:",
        "1+2",
        "1 2",
        "1.00000000000000011102230246251565",
        "0.1234567812345678123456781234567812345678"};
    for (size_t i = 0; i < sizeof tokens / sizeof tokens[0]; i++) {
        check_token(tokens[i]);
    }
}

/* The exponents of Fortran, which strtod does not know. */
static void reads_fortran(void **state) {
    (void)state;
    static const char *const tokens[][2] = {
        {"1.0D-01", "1.0e-01"},
        {"2.5d0", "2.5e0"},
        {"-0.123456789012345678D+02", "-0.123456789012345678e2"},
        {"1D300", "1e300"},
        {"1.7976931348623157d308", "1.7976931348623157e308"},
        {"4.9D-324", "4.9e-324"}};
    for (size_t i = 0; i < sizeof tokens / sizeof tokens[0]; i++) {
        char padded[TOKEN_BYTES] = "";
        double value = 0;
        strcpy(padded, tokens[i][0]);
        assert_ptr_equal(ps_decimal_parse(padded, &value), padded + strlen(tokens[i][0]));
        assert_true(value == strtod(tokens[i][1], NULL));
    }
    double value = 0;
    char padded[TOKEN_BYTES] = "1d";
    assert_ptr_equal(ps_decimal_parse(padded, &value), padded + 1);
}

static void refuses_what_is_no_number(void **state) {
    (void)state;
    static const char *const tokens[] = {"",    ".",    "-",   "+.",  "e5", "nan",
                                         "inf", "-inf", "abc", "- 1", ",1", "--1"};
    for (size_t i = 0; i < sizeof tokens / sizeof tokens[0]; i++) {
        char padded[64] = "";
        double value = 0;
        strcpy(padded, tokens[i]);
        assert_null(ps_decimal_parse(padded, &value));
    }
    double value = 1;
    const char hexadecimal[32] = "0x1p-3";
    assert_ptr_equal(ps_decimal_parse(hexadecimal, &value), hexadecimal + 1); /* the 0 only */
}

/* Digits from the first to the last that is not 0. */
static int significant_digits(const char *text) {
    int num = 0;
    int zeros = 0;
    for (; *text != '\0' && *text != 'e'; text++) {
        if (*text >= '1' && *text <= '9') {
            num += zeros + 1;
            zeros = 0;
        } else if (*text == '0' && num > 0) {
            zeros++;
        }
    }
    return num;
}

/* The fewest digits whose nearest text is read as value. */
static int fewest_digits(double value, char text[64]) {
    int num = 1;
    for (; num < 17; num++) {
        snprintf(text, 64, "%.*e", num - 1, value);
        if (strtod(text, NULL) == value) {
            return num;
        }
    }
    snprintf(text, 64, "%.16e", value);
    return num;
}

static bool is_power_of_two(double value) {
    int exponent = 0;
    return fabs(frexp(value, &exponent)) == 0.5;
}

/* It is read back, has an exponent where "%.17g" has one, and no text with fewer digits, or nearer
 * with as many, is read back. Below a power of two doubles are twice as dense, so that there a text
 * above it may be read back and be shorter, although it is not the nearest. */
static void check_written(double value) {
    char text[PS_DECIMAL_BYTES];
    char long_text[64];
    char fewest[64];
    const size_t length = ps_decimal_format(text, value);
    assert_int_equal(length, strlen(text));
    assert_true(strtod(text, NULL) == value && !signbit(strtod(text, NULL)) == !signbit(value));
    snprintf(long_text, sizeof long_text, "%.17g", value);
    assert_true((strchr(text, 'e') == NULL) == (strchr(long_text, 'e') == NULL));
    if (value == 0) {
        assert_string_equal(text, long_text);
        return;
    }
    const int num = fewest_digits(value, fewest);
    const int own = significant_digits(text);
    if (own > num || (own < significant_digits(fewest) && !is_power_of_two(value))) {
        fail_msg("%s has %d digits, %s has %d", text, own, fewest, num);
    }
    if (own == significant_digits(fewest) && strtold(text, NULL) != strtold(fewest, NULL)) {
        fail_msg("%s is not the nearest: %s", text, fewest);
    }
}

/* Values of all sizes, of few bits (which may lie half way between two texts), and beside powers of
 * ten and two. */
static void writes_shortest_digits(void **state) {
    (void)state;
    static const double values[] = {0,       -0.0,    1,         0.1,  1e300, -DBL_MIN,
                                    DBL_MAX, 1.0 / 3, 123456789, 5e-5, -0.5,  99999999999999999.0,
                                    5e-324,  3e-320};
    uint64_t random = 362436069;
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++) {
        check_written(values[i]);
    }
    for (int i = 0; i < 200000; i++) {
        const double unit = next_unit(&random);
        check_written(unit);
        check_written(-unit * pow(10, i % 30 - 9));
        check_written(ldexp(floor(unit * 4096), i % 80 - 60));
        check_written(floor(unit * 1e6) * pow(10, i % 12 - 8)); /* few decimals */
    }
    for (int power = -8; power < 22; power++) {
        const double ten = pow(10, power);
        const double two = ldexp(1, 2 * power);
        check_written(nextafter(ten, 0));
        check_written(ten);
        check_written(nextafter(ten, 2 * ten));
        check_written(nextafter(two, 0));
        check_written(two);
        check_written(nextafter(two, 2 * two));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_like_strtod),      cmocka_unit_test(reads_corner_cases),
        cmocka_unit_test(reads_fortran),          cmocka_unit_test(refuses_what_is_no_number),
        cmocka_unit_test(writes_shortest_digits),
    };
    return cmocka_run_group_tests_name("decimal", tests, NULL, NULL);
}
