/* Reading has a fast path in 64 and 128 bit integers for the numbers that point files hold, and
 * leaves the rest, and every doubtful rounding, to the C library. */
#include "files/decimal_bits.h"

#include <langinfo.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#if defined(__SSE2__)
#include <emmintrin.h>
#endif

/* Kept out of line, so that the fast path saves no registers for it. */
#if defined(__GNUC__)
#define PS_RARE __attribute__((noinline, cold))
#else
#define PS_RARE
#endif

enum {
    MAX_DIGITS = 19,       /* decimal digits that always fit 64 bits */
    MAX_EXPONENT = 100000, /* clamp: far outside the doubles, far inside int */
    LOWER_CASE = 0x20      /* the bit of letters that are not large */
};

/* What the scan of a number found: (-1)^negative * digits * 10^exponent. */
typedef struct scanned_number {
    uint64_t digits;
    long exponent;
    bool is_negative;
    bool is_inexact; /* more digits than 64 bits hold */
} scanned_number;

static bool is_digit(char c) {
    return (unsigned char)(c - '0') <= 9;
}

/* ---- scanning ---- */

#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
static const uint64_t HIGH_HALVES = 0xF0F0F0F0F0F0F0F0U;
static const uint64_t ZEROS = 0x3030303030303030U; /* "00000000" */

/* Eight characters: not 0 in every byte that is no digit, as far as the first of them. Adding 6
 * carries a low half above 9 into the high half of its byte. */
static uint64_t find_others(uint64_t v) {
    return ((v ^ ZEROS) & HIGH_HALVES) | (((v + 0x0606060606060606U) ^ ZEROS) & HIGH_HALVES);
}

/* The number that eight digits make: sums of neighbours halve the count thrice. */
static uint64_t join_eight(uint64_t v) {
    const uint64_t mask = 0x000000FF000000FFU;
    const uint64_t weights_even = 100 + (UINT64_C(1000000) << 32);
    const uint64_t weights_odd = 1 + (UINT64_C(10000) << 32);
    v -= ZEROS;
    v = v * 10 + (v >> 8); /* pairs, in every other byte */
    return ((v & mask) * weights_even + ((v >> 16) & mask) * weights_odd) >> 32;
}

#if defined(__SSE2__)
/* Sixteen digits at once: 0 when one of the characters is none, else the number in *number. */
static bool join_sixteen(const char *text, uint64_t *number) {
    const __m128i digits =
        _mm_sub_epi8(_mm_loadu_si128((const __m128i *)(const void *)text), _mm_set1_epi8('0'));
    const __m128i are_digits = _mm_cmpeq_epi8(_mm_min_epu8(digits, _mm_set1_epi8(9)), digits);
    if (_mm_movemask_epi8(are_digits) != 0xFFFF) {
        return false;
    }
    const __m128i tens =
        _mm_mullo_epi16(_mm_and_si128(digits, _mm_set1_epi16(0xFF)), _mm_set1_epi16(10));
    const __m128i two = _mm_add_epi16(tens, _mm_srli_epi16(digits, 8));
    const __m128i four = _mm_madd_epi16(two, _mm_set1_epi32(100 + (1 << 16)));
    const __m128i packed = _mm_packs_epi32(four, four);
    const __m128i eight = _mm_madd_epi16(packed, _mm_set1_epi32(10000 + (1 << 16)));
    const uint64_t pair = (uint64_t)_mm_cvtsi128_si64(eight); /* the first eight in the low half */
    *number = (pair & UINT32_MAX) * 100000000 + (pair >> 32);
    return true;
}
#endif

/* Appends the digits at text to *digits, which wraps around when they are too many. Eight at a
 * time, the last ones behind zeros in front: how many there are decides no branch, which would be
 * guessed wrong for every other number. */
static const char *scan_digits(const char *text, uint64_t *digits) {
    static const uint32_t power[] = {1, 10, 100, 1000, 10000, 100000, 1000000, 10000000};
    enum { BYTES = 8, BITS = 8 };
    uint64_t v = 0;
    uint64_t others = 0;
#if defined(__SSE2__)
    uint64_t sixteen = 0;
    if (join_sixteen(text, &sixteen)) {
        *digits = *digits * 10000000000000000 + sixteen;
        for (text += 2 * BYTES; is_digit(*text); text++) { /* mostly one: the branch is guessed */
            *digits = *digits * 10 + (uint64_t)(*text - '0');
        }
        return text;
    }
#endif
    memcpy(&v, text, BYTES);
    while ((others = find_others(v)) == 0) {
        *digits = *digits * 100000000 + join_eight(v);
        text += BYTES;
        memcpy(&v, text, BYTES);
    }
    const unsigned count = (unsigned)__builtin_ctzll(others) / BITS;
    const unsigned missing = (BYTES - count) * BITS; /* 8 to 64 bits, shifted in two steps */
    const uint64_t last = (v << (missing - BITS) << BITS) | (ZEROS >> (BITS * count));
    *digits = *digits * power[count] + join_eight(last);
    return text + count;
}
#else
static const char *scan_digits(const char *text, uint64_t *digits) {
    while (is_digit(*text)) {
        *digits = *digits * 10 + (uint64_t)(*text++ - '0');
    }
    return text;
}
#endif

PS_RARE static const char *scan_exponent(const char *text, long *exponent) {
    const char *digit = text + 1;
    const bool is_negative = *digit == '-';
    digit += *digit == '-' || *digit == '+';
    if (!is_digit(*digit)) {
        return text; /* as strtod: the number ends before the 'e' */
    }
    long value = 0;
    for (; is_digit(*digit); digit++) {
        value = value < MAX_EXPONENT ? value * 10 + (*digit - '0') : value;
    }
    *exponent += is_negative ? -value : value;
    return digit;
}

/* Significant digits from first to end, the decimal point and leading zeros not counted. */
PS_RARE static bool has_too_many_digits(const char *first, const char *end) {
    while (first < end && (*first == '0' || *first == '.')) {
        first++;
    }
    const long num_bytes = end - first;
    const bool has_point = memchr(first, '.', (size_t)num_bytes) != NULL;
    return num_bytes - has_point > MAX_DIGITS;
}

static const char *scan_number(const char *text, scanned_number *number) {
    number->is_negative = *text == '-';
    text += *text == '-' || *text == '+';
    const char *const first = text;
    number->digits = 0;
    while (is_digit(*text)) { /* mostly one: the branch is guessed */
        number->digits = number->digits * 10 + (uint64_t)(*text++ - '0');
    }
    long num_digits = text - first;
    number->exponent = 0;
    if (*text == '.') {
        const char *const fraction = text + 1;
        text = scan_digits(fraction, &number->digits);
        number->exponent = -(text - fraction);
        num_digits += text - fraction;
    }
    if (num_digits == 0) {
        return NULL;
    }
    number->is_inexact = num_digits > MAX_DIGITS && has_too_many_digits(first, text);
    const char letter = (char)(*text | LOWER_CASE);
    return letter == 'e' || letter == 'd' ? scan_exponent(text, &number->exponent) : text;
}

/* ---- reading ---- */

#if HAVE_WIDE_INTEGERS
enum { NUM_RECIPROCALS = 32 };

/* floor(2^s / 10^k) with 2^63 <= ... < 2^64, that is s = 64 + floor(k log2(10)); k = 1..31.
 * Python: for k in range(1, 32): print(hex((1 << 63 + (10**k).bit_length()) // 10**k)) */
static const uint64_t reciprocal[NUM_RECIPROCALS] = {0, /* k = 0 is not a division */
                                                     0xCCCCCCCCCCCCCCCC,
                                                     0xA3D70A3D70A3D70A,
                                                     0x83126E978D4FDF3B,
                                                     0xD1B71758E219652B,
                                                     0xA7C5AC471B478423,
                                                     0x8637BD05AF6C69B5,
                                                     0xD6BF94D5E57A42BC,
                                                     0xABCC77118461CEFC,
                                                     0x89705F4136B4A597,
                                                     0xDBE6FECEBDEDD5BE,
                                                     0xAFEBFF0BCB24AAFE,
                                                     0x8CBCCC096F5088CB,
                                                     0xE12E13424BB40E13,
                                                     0xB424DC35095CD80F,
                                                     0x901D7CF73AB0ACD9,
                                                     0xE69594BEC44DE15B,
                                                     0xB877AA3236A4B449,
                                                     0x9392EE8E921D5D07,
                                                     0xEC1E4A7DB69561A5,
                                                     0xBCE5086492111AEA,
                                                     0x971DA05074DA7BEE,
                                                     0xF1C90080BAF72CB1,
                                                     0xC16D9A0095928A27,
                                                     0x9ABE14CD44753B52,
                                                     0xF79687AED3EEC551,
                                                     0xC612062576589DDA,
                                                     0x9E74D1B791E07E48,
                                                     0xFD87B5F28300CA0D,
                                                     0xCAD2F7F5359A3B3E,
                                                     0xA2425FF75E14FC31,
                                                     0x81CEB32C4B43FCF4};

/* digits / 10^k, correctly rounded, or false when the error of the reciprocal leaves that open.
 *
 * With w = digits 2^zeros in [2^63, 2^64) and reciprocal <= R < reciprocal + 1, the quotient
 * w R / 2^64 lies in [high, high + 2), high the upper half of w * reciprocal. Of the 63 or 64 bits
 * of high the last 10 or 11 do not fit a double: only when they are half of their range, or one
 * below, could the 2 change the rounding. That is once in some 700 numbers. */
static bool divide_by_power(uint64_t digits, unsigned k, double *value) {
    const int zeros = __builtin_clzll(digits);
    const uint64_t high = (uint64_t)(((wide)(digits << zeros) * reciprocal[k]) >> 64);
    /* no branch: it would be guessed wrong every other time */
    const int extra_bits = 63 - MANTISSA_BITS + (int)(high >> 63);
    const uint64_t half = UINT64_C(1) << (extra_bits - 1);
    const uint64_t low = high & (2 * half - 1);
    if (low == half || low == half - 1) {
        return false;
    }
    const uint64_t mantissa = (high >> extra_bits) + (low > half);
    const int log2_of_power = (int)((217706 * k) >> 16); /* floor(k log2(10)), right for k < 500 */
    const int exponent = extra_bits - zeros - log2_of_power;
    /* A mantissa that rounded up to 2^53 carries into the exponent, as it must. */
    const uint64_t bits =
        ((uint64_t)(exponent + EXPONENT_BIAS + MANTISSA_BITS - 1) << (MANTISSA_BITS - 1)) +
        (mantissa - (UINT64_C(1) << (MANTISSA_BITS - 1)));
    memcpy(value, &bits, sizeof *value);
    return true;
}

static bool compute_fast(const scanned_number *number, double *value) {
    if (number->is_inexact || number->exponent > 0 || number->exponent <= -NUM_RECIPROCALS) {
        return false;
    }
    if (number->exponent == 0 || number->digits == 0) {
        *value = (double)number->digits; /* IEEE rounds this correctly */
        return true;
    }
    return divide_by_power(number->digits, (unsigned)-number->exponent, value);
}
#else
static bool compute_fast(const scanned_number *number, double *value) {
    static const double power[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                   1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                   1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    const uint64_t exact = UINT64_C(1) << MANTISSA_BITS;
    if (number->is_inexact || number->digits > exact || number->exponent > 0 ||
        number->exponent < -22) {
        return false;
    }
    *value = (double)number->digits / power[-number->exponent]; /* both exact: rounded once */
    return true;
}
#endif

/* strtod for the token where the locale's decimal point is not '.'. */
static bool compute_in_locale(const char *text, size_t length, const char *point, double *value) {
    enum { LONGEST = 1000 }; /* no midpoint of two doubles has more significant digits than 767 */
    char copy[LONGEST + 8];
    const char *const dot = memchr(text, '.', length);
    if (length > LONGEST || strlen(point) >= sizeof copy - LONGEST) {
        return false;
    }
    const size_t before = dot != NULL ? (size_t)(dot - text) : length;
    const size_t after = dot != NULL ? length - before - 1 : 0;
    snprintf(copy, sizeof copy, "%.*s%s%.*s", (int)before, text, dot != NULL ? point : "",
             (int)after, text + length - after);
    char *const letter = strpbrk(copy, "dD");
    if (letter != NULL) {
        *letter = 'e';
    }
    char *stop = NULL;
    *value = strtod(copy, &stop);
    return *stop == '\0';
}

PS_RARE static bool compute_slow(const char *text, const char *end, double *value) {
    const char *const point = nl_langinfo(RADIXCHAR);
    const size_t length = (size_t)(end - text);
    const bool is_fortran = memchr(text, 'd', length) != NULL || memchr(text, 'D', length) != NULL;
    if (strcmp(point, ".") != 0 || is_fortran) {
        return compute_in_locale(text, length, point, value);
    }
    char *stop = NULL;
    *value = strtod(text, &stop);
    return stop == end;
}

const char *ps_decimal_parse(const char *text, double *value) {
    scanned_number number;
    const char *const end = scan_number(text, &number);
    if (end == NULL) {
        return NULL;
    }
    if (compute_fast(&number, value)) {
        *value = number.is_negative ? -*value : *value;
        return end;
    }
    return compute_slow(text, end, value) ? end : NULL;
}
