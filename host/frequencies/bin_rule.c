#include "frequencies/bin_rule.h"

#include "math/divisor.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- words ------------------------------------------------------------------------------- */

/* Digits alone, from 1 to PS_MOST_BIN_WIDTH; *end is behind them. */
static bool take_number(const char *text, const char **end, uint32_t *out) {
    const size_t most_digits = 7;
    const size_t length = strspn(text, "0123456789");
    const unsigned long value =
        length > 0 && length <= most_digits ? strtoul(text, NULL, 10) : 0; /* no overflow */
    *end = text + length;
    *out = (uint32_t)value;
    return value >= 1 && value <= PS_MOST_BIN_WIDTH;
}

static bool take_fraction(const char *text, ps_bin_rule *out) {
    const char *end = NULL;
    uint32_t numerator = 0;
    uint32_t denominator = 1;
    if (!take_number(text, &end, &numerator) ||
        (*end == '/' && !take_number(end + 1, &end, &denominator)) || *end != '\0') {
        return false;
    }
    const uint32_t divisor = (uint32_t)ps_common_divisor(numerator, denominator);
    out->numerator = numerator / divisor;
    out->denominator = denominator / divisor;
    return true;
}

static bool take_width(const char *text, const char *word, ps_bin_kind kind, ps_bin_rule *out) {
    const size_t length = strlen(word);
    *out = (ps_bin_rule){.kind = kind};
    return strncmp(text, word, length) == 0 && take_fraction(text + length, out);
}

pspec_status ps_bin_rule_parse(ps_bin_rule *out, const char *shown, const char *text,
                               ps_error *error) {
    if (strcmp(text, "round") == 0) {
        *out = (ps_bin_rule){.kind = PS_BINS_ROUND};
    } else if (strcmp(text, "shells") == 0) {
        *out = (ps_bin_rule){.kind = PS_BINS_SHELLS};
    } else if (strcmp(text, "floor") == 0) {
        *out = (ps_bin_rule){.kind = PS_BINS_WIDTH, .numerator = 1, .denominator = 1};
    } else if (!take_width(text, "width=", PS_BINS_WIDTH, out) &&
               !take_width(text, "relative=", PS_BINS_RELATIVE, out)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: \"%s\" is none of %s, P and Q being whole numbers from 1 to %d", shown,
                       text, PS_BIN_RULES, PS_MOST_BIN_WIDTH);
    }
    return PSPEC_OK;
}

ps_bin_rule_text ps_bin_rule_write(const ps_bin_rule *rule) {
    ps_bin_rule_text out;
    if (rule->kind == PS_BINS_ROUND || rule->kind == PS_BINS_SHELLS) {
        snprintf(out.text, sizeof out.text, "%s", rule->kind == PS_BINS_ROUND ? "round" : "shells");
    } else if (rule->kind == PS_BINS_WIDTH && rule->numerator == 1 && rule->denominator == 1) {
        snprintf(out.text, sizeof out.text, "floor");
    } else {
        snprintf(out.text, sizeof out.text, "%s=%u/%u",
                 rule->kind == PS_BINS_WIDTH ? "width" : "relative", (unsigned)rule->numerator,
                 (unsigned)rule->denominator);
    }
    return out;
}

bool ps_bin_rule_is_same(const ps_bin_rule *a, const ps_bin_rule *b) {
    return a->kind == b->kind && a->numerator == b->numerator && a->denominator == b->denominator &&
           a->dimension == b->dimension && a->num_points == b->num_points;
}

const char *ps_bin_rule_noun(const ps_bin_rule *rule) {
    return rule->kind == PS_BINS_SHELLS ? "shell" : "ring";
}

void ps_bin_rule_resolve(ps_bin_rule *rule, unsigned dimension, uint64_t num_points) {
    if (rule->kind == PS_BINS_RELATIVE) {
        rule->dimension = dimension;
        rule->num_points = num_points;
    }
}

/* ---- exact products ---------------------------------------------------------------------- */

/* Whole numbers up to 2^768: (b P)^12 N^2 with b P <= 2^51 and N <= 2^64 takes 740 bits, and Q^12
 * n^6 with Q <= 2^20 and n <= 2^59 takes 594. Words of 32 bits, the lowest first. */
enum { WORDS = 24, WORD_BITS = 32 };
typedef struct product {
    uint32_t words[WORDS];
} product;

static void multiply_word(product *a, uint32_t factor) {
    uint64_t carry = 0;
    for (int i = 0; i < WORDS; i++) {
        carry += (uint64_t)a->words[i] * factor;
        a->words[i] = (uint32_t)carry;
        carry >>= WORD_BITS;
    }
}

/* By both halves of the factor, the product with the high one moved by a word. */
static void multiply(product *a, uint64_t factor) {
    product high = *a;
    uint64_t carry = 0;
    multiply_word(a, (uint32_t)factor);
    multiply_word(&high, (uint32_t)(factor >> WORD_BITS));
    for (int i = 1; i < WORDS; i++) {
        carry += (uint64_t)a->words[i] + high.words[i - 1];
        a->words[i] = (uint32_t)carry;
        carry >>= WORD_BITS;
    }
}

static bool is_at_most(const product *a, const product *b) {
    for (int i = WORDS; i-- > 0;) {
        if (a->words[i] != b->words[i]) {
            return a->words[i] < b->words[i];
        }
    }
    return true;
}

/* Is the border below bin b at most |k|? */
static bool reaches(const ps_bin_rule *rule, int64_t bin, int64_t norm2) {
    const bool is_relative = rule->kind == PS_BINS_RELATIVE;
    const unsigned exponent = is_relative ? rule->dimension : 1;
    product border = {{1}};
    product norm = {{1}};
    for (unsigned i = 0; i < exponent; i++) {
        for (int twice = 0; twice < 2; twice++) {
            multiply(&border, (uint64_t)bin);
            multiply(&border, rule->numerator);
            multiply(&norm, rule->denominator);
        }
        multiply(&norm, (uint64_t)norm2);
    }
    if (is_relative) {
        multiply(&border, rule->num_points);
        multiply(&border, rule->num_points);
    }
    return is_at_most(&border, &norm);
}

/* ---- bins -------------------------------------------------------------------------------- */

int64_t ps_ring_of_norm2(int64_t norm2) {
    /* b = rint(sqrt(norm2)) up to rounding of the square root, which the two lines after mend. */
    int64_t b = (int64_t)rint(sqrt((double)norm2));
    b -= norm2 < b * b - b + 1;
    b += norm2 > b * b + b;
    return b;
}

static double find_width(const ps_bin_rule *rule) {
    const double ratio = (double)rule->numerator / (double)rule->denominator;
    return rule->kind == PS_BINS_RELATIVE
               ? ratio * pow((double)rule->num_points, 1.0 / rule->dimension)
               : ratio;
}

/* Root, power and quotient are right to a few units of 2^-53: a quotient farther from a whole
 * number than that needs no exact products. */
static int64_t find_by_width(const ps_bin_rule *rule, int64_t norm2) {
    const double rounding = 1e-14;
    const double quotient = sqrt((double)norm2) / find_width(rule);
    int64_t bin = (int64_t)quotient;
    if (fabs(quotient - rint(quotient)) > rounding * (quotient + 1)) {
        return bin;
    }
    bin = (int64_t)rint(quotient);
    return reaches(rule, bin, norm2) ? bin : bin - 1;
}

int64_t ps_bin_rule_find(const ps_bin_rule *rule, int64_t norm2) {
    return rule->kind == PS_BINS_SHELLS  ? norm2
           : rule->kind == PS_BINS_ROUND ? ps_ring_of_norm2(norm2)
                                         : find_by_width(rule, norm2);
}

int64_t ps_bin_rule_find_length(const ps_bin_rule *rule, double length2) {
    const double rounding = 1e-12;
    const double steps = 0x1p20; /* of shells, within 1; up to K = 10^6 they are exact */
    const double half = 0.5;
    const double length = sqrt(length2) * (1 + rounding);
    return (int64_t)(rule->kind == PS_BINS_SHELLS  ? rint(length2 * steps)
                     : rule->kind == PS_BINS_ROUND ? length + half
                                                   : length / find_width(rule));
}

/* Bisection between 1 and what the width in double precision cannot miss. */
static int64_t find_low(const ps_bin_rule *rule, int64_t bin) {
    const double slack = 1e-9;
    const double border = (double)bin * find_width(rule);
    int64_t low = 1;
    int64_t high = (int64_t)(border * border * (1 + slack)) + 2;
    while (low < high) {
        const int64_t middle = low + (high - low) / 2;
        if (reaches(rule, bin, middle)) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

int64_t ps_bin_rule_low(const ps_bin_rule *rule, int64_t bin) {
    return rule->kind == PS_BINS_SHELLS  ? bin
           : rule->kind == PS_BINS_ROUND ? bin * bin - bin + 1
                                         : find_low(rule, bin);
}

int64_t ps_bin_rule_largest(const ps_bin_rule *rule, int32_t max_frequency) {
    static const ps_bin_rule rings = {.kind = PS_BINS_ROUND};
    const ps_bin_rule *const own = rule->kind == PS_BINS_SHELLS ? &rings : rule;
    const int64_t outside = (max_frequency + (int64_t)1) * (max_frequency + (int64_t)1);
    return ps_bin_rule_low(own, ps_bin_rule_find(own, outside)) - 1;
}
