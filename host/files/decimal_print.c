/* Printing: the shortest digits that are read as the same double. It has a fast path, exact by 128
 * bits, for numbers that need no exponent; the C library does the rest. */
#include "files/decimal_bits.h"

#include <float.h>
#include <langinfo.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if HAVE_WIDE_INTEGERS
enum {
    DIGITS = 17,
    LEAST_POWER = -4,
    MOST_POWER = DIGITS - 1
}; /* where %.17g writes no exponent */

/* 10^k */
static wide power_of_ten(int k) {
    static const uint64_t power[] = {1,       10,       100,       1000,       10000,      100000,
                                     1000000, 10000000, 100000000, 1000000000, 10000000000};
    enum { MOST = 10 };
    wide product = power[k % MOST];
    for (; k >= MOST; k -= MOST) {
        product *= power[MOST];
    }
    return product;
}

/* A double in units of its 17th digit, and the numbers between its neighbours' midpoints, which are
 * read as this double. All are multiples of 2^-fraction. Exact: 53 bits times 10^20 < 2^67, and two
 * more for halves of half a unit in the last place, fit 128. */
typedef struct scaled {
    wide value, least, most;
    unsigned fraction;
} scaled;

static scaled scale(uint64_t mantissa, int exponent, int k) {
    const int up = exponent > 0 ? exponent : 0;
    const wide unit = power_of_ten(k) << up;
    const wide value = (wide)mantissa * unit * 4;
    const wide edge = (mantissa & 1) != 0; /* midpoints are read as the even neighbour */
    const bool is_power = mantissa == UINT64_C(1) << (MANTISSA_BITS - 1);
    return (scaled){.value = value,
                    .least = value - (is_power ? 1 : 2) * unit + edge,
                    .most = value + 2 * unit - edge,
                    .fraction = 2 + (unsigned)(up - exponent)};
}

/* The nearest integer that is a multiple of 10^zeros, in units of that; halves go to even. */
static uint64_t nearest(const scaled *number, uint64_t ten_power) {
    const wide unit = (wide)ten_power << number->fraction;
    const uint64_t below = (uint64_t)(number->value >> number->fraction) / ten_power;
    const wide rest = number->value - below * unit;
    return below + (2 * rest > unit || (2 * rest == unit && (below & 1) != 0));
}

/* The nearest of the shortest integers that are read as this number: with most zeros at the end. */
static uint64_t shortest(const scaled *number) {
    const wide ones = ((wide)1 << number->fraction) - 1;
    uint64_t least = (uint64_t)((number->least + ones) >> number->fraction);
    uint64_t most = (uint64_t)(number->most >> number->fraction);
    uint64_t ten_power = 1;
    while ((least + 9) / 10 <= most / 10) {
        least = (least + 9) / 10;
        most /= 10;
        ten_power *= 10;
    }
    if (least == most) {
        return least * ten_power;
    }
    const uint64_t found = nearest(number, ten_power);
    return (found < least ? least : found > most ? most : found) * ten_power;
}

/* The digits of |value| = d.ddd 10^power, with zeros up to 17, or false outside the range above. */
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
    const scaled number = scale(mantissa, exponent, MOST_POWER - *power);
    *digits = shortest(&number);
    if (*digits >= most) { /* rounded up to the next power of ten */
        *digits /= 10;
        ++*power;
    }
    return *digits >= most / 10 && *power <= MOST_POWER;
}

/* As "%.17g" of the digits: no exponent in this range, no zeros at the end. */
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

/* With the point of the locale; the fewest of 15 to 17 digits that are read as this number, which
 * with 15 means without the zeros at their end. Below DBL_MIN doubles have fewer digits. */
static int format_locale(char text[PS_DECIMAL_BYTES], double value) {
    enum { FEWEST = 15, MOST = 17 };
    int length = 0;
    for (int digits = fabs(value) < DBL_MIN ? 1 : FEWEST; digits <= MOST; digits++) {
        length = snprintf(text, PS_DECIMAL_BYTES, "%.*g", digits, value);
        if (strtod(text, NULL) == value) {
            break;
        }
    }
    return length;
}

size_t ps_decimal_format(char text[PS_DECIMAL_BYTES], double value) {
    const size_t fast = format_fast(text, value);
    if (fast > 0) {
        return fast;
    }
    const int length = format_locale(text, value);
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
