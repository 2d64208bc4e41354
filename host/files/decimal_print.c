/* Printing has a fast path, exact by 128 bits, for numbers that need no exponent; the C library
 * does the rest. */
#include "files/decimal_bits.h"

#include <langinfo.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#if HAVE_WIDE_INTEGERS
enum {
    DIGITS = 17,
    LEAST_POWER = -4,
    MOST_POWER = DIGITS - 1
}; /* where %.17g writes no exponent */

/* round(mantissa 2^exponent 10^k), half to even. Exact: 53 bits times 10^20 < 2^67 fit 128. */
static uint64_t scale(uint64_t mantissa, int exponent, int k) {
    static const uint64_t power[] = {1,       10,       100,       1000,       10000,      100000,
                                     1000000, 10000000, 100000000, 1000000000, 10000000000};
    enum { MOST = 10 };
    wide product = (wide)mantissa * power[k % MOST];
    for (; k >= MOST; k -= MOST) {
        product *= power[MOST];
    }
    if (exponent >= 0) {
        return (uint64_t)(product << exponent);
    }
    const wide half = (wide)1 << (-exponent - 1);
    const wide rest = product & (2 * half - 1);
    const uint64_t whole = (uint64_t)(product >> -exponent);
    return whole + (rest > half || (rest == half && (whole & 1) != 0));
}

/* The 17 digits of |value| = d.ddd 10^power, or false outside the range above. */
static bool find_digits(double value, uint64_t *digits, int *power) {
    static const double bounds[] = {1e-4, 1e-3, 1e-2, 1e-1, 1e0,  1e1, 1e2,  1e3,
                                    1e4,  1e5,  1e6,  1e7,  1e8,  1e9, 1e10, 1e11,
                                    1e12, 1e13, 1e14, 1e15, 1e16, 1e17};
    const uint64_t most = UINT64_C(100000000000000000);
    uint64_t bits = 0;
    memcpy(&bits, &value, sizeof bits);
    bits &= UINT64_MAX >> 1;
    const double size = value < 0 ? -value : value;
    if (!(size >= bounds[0] && size < bounds[MOST_POWER - LEAST_POWER + 1])) {
        return false;
    }
    const uint64_t mantissa =
        (bits & ((UINT64_C(1) << (MANTISSA_BITS - 1)) - 1)) | UINT64_C(1) << (MANTISSA_BITS - 1);
    const int exponent = (int)(bits >> (MANTISSA_BITS - 1)) - EXPONENT_BIAS - (MANTISSA_BITS - 1);
    *power = LEAST_POWER;
    while (size >= bounds[*power - LEAST_POWER + 1]) {
        ++*power;
    }
    *digits = scale(mantissa, exponent, MOST_POWER - *power);
    if (*digits >= most) { /* rounded up to the next power of ten */
        *digits /= 10;
        ++*power;
    }
    return *digits >= most / 10 && *power <= MOST_POWER;
}

/* As "%.17g": no exponent in this range, no zeros at the end. */
static size_t write_digits(char *text, bool is_negative, uint64_t digits, int power) {
    enum { LOW_DIGITS = 8 }; /* 9 and 8 digits: 32 bits divide faster than 64 */
    char figures[DIGITS];
    int num = DIGITS;
    uint32_t low = (uint32_t)(digits % 100000000);
    uint32_t high = (uint32_t)(digits / 100000000);
    for (int i = DIGITS - 1; i >= DIGITS - LOW_DIGITS; i--, low /= 10) {
        figures[i] = (char)('0' + low % 10);
    }
    for (int i = DIGITS - LOW_DIGITS - 1; i >= 0; i--, high /= 10) {
        figures[i] = (char)('0' + high % 10);
    }
    while (num > 1 && figures[num - 1] == '0') {
        num--;
    }
    char *at = text;
    if (is_negative) {
        *at++ = '-';
    }
    if (power < 0) {
        *at++ = '0';
        *at++ = '.';
        for (int i = -1; i > power; i--) {
            *at++ = '0';
        }
    }
    const int before = power >= 0 ? power + 1 : 0; /* digits before the point */
    for (int i = 0; i < before; i++) {
        *at++ = i < num ? figures[i] : '0';
    }
    if (before > 0 && num > before) {
        *at++ = '.';
    }
    if (num > before) {
        memcpy(at, figures + before, (size_t)(num - before));
        at += num - before;
    }
    *at = '\0';
    return (size_t)(at - text);
}

static size_t format_fast(char *text, double value) {
    uint64_t digits = 0;
    int power = 0;
    return find_digits(value, &digits, &power) ? write_digits(text, value < 0, digits, power) : 0;
}
#else
static size_t format_fast(char *text, double value) {
    (void)text;
    (void)value;
    return 0;
}
#endif

size_t ps_decimal_format(char text[PS_DECIMAL_BYTES], double value) {
    const size_t fast = format_fast(text, value);
    if (fast > 0) {
        return fast;
    }
    const int length = snprintf(text, PS_DECIMAL_BYTES, "%.17g", value);
    const char *const point = nl_langinfo(RADIXCHAR);
    char *const found = strcmp(point, ".") != 0 ? strstr(text, point) : NULL;
    if (found == NULL) {
        return (size_t)length;
    }
    const size_t tail = strlen(found + strlen(point));
    *found = '.';
    memmove(found + 1, found + strlen(point), tail + 1);
    return (size_t)(found - text) + 1 + tail;
}
