/* Decimal text against the C library: the same bits, and the same end of the number. */
#include "files/decimal.h"
#include "fuzz.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Length of [+-] digits [. digits] [e [+-] digits], or d for e, at text, 0: there is none. */
static size_t number_length(const char *text) {
    static const char digits[] = "0123456789";
    const size_t sign = strspn(text, "+-") > 0;
    const size_t whole = strspn(text + sign, digits);
    size_t length = sign + whole;
    if (text[length] == '.') {
        const size_t fraction = strspn(text + length + 1, digits);
        if (whole + fraction == 0) {
            return 0;
        }
        length += 1 + fraction;
    } else if (whole == 0) {
        return 0;
    }
    if (text[length] != '\0' && strchr("eEdD", text[length]) != NULL) {
        const size_t exponent_sign = text[length + 1] == '+' || text[length + 1] == '-';
        const size_t exponent = strspn(text + length + 1 + exponent_sign, digits);
        length += exponent > 0 ? 1 + exponent_sign + exponent : 0;
    }
    return length;
}

static void check_parse(fuzz_bytes input) {
    /* The number ends with the input; behind it there is what must be readable, and no more. */
    char *const text = calloc(input.size + PS_DECIMAL_PADDING, 1);
    char *const copy = fuzz_copy_text(input);
    if (text == NULL) {
        fuzz_fail("no memory");
    }
    memcpy(text, copy, input.size);
    double value = 0;
    const size_t length = number_length(copy);
    const char *const end = ps_decimal_parse(text, &value);
    if (end != (length > 0 ? text + length : NULL)) {
        fuzz_fail("\"%s\": the number has %zu characters, %td were read", copy, length,
                  end != NULL ? end - text : -1);
    }
    copy[length] = '\0';
    char *const letter = strpbrk(copy, "dD");
    if (letter != NULL) {
        *letter = 'e';
    }
    const double expected = strtod(copy, NULL);
    if (end != NULL && memcmp(&value, &expected, sizeof value) != 0) {
        fuzz_fail("\"%s\": %a instead of %a", copy, value, expected);
    }
    free(copy);
    free(text);
}

static void check_format(fuzz_bytes input) {
    double value = 0;
    double back = 0;
    char text[PS_DECIMAL_BYTES + PS_DECIMAL_PADDING] = "";
    memcpy(&value, input.data, sizeof value);
    const size_t length = ps_decimal_format(text, value);
    if (length != strlen(text)) {
        fuzz_fail("%a: \"%s\" of %zu characters", value, text, length);
    }
    if (isfinite(value) &&
        (ps_decimal_parse(text, &back) == NULL || memcmp(&back, &value, sizeof back) != 0)) {
        fuzz_fail("%s: %a became %a", text, value, back);
    }
}

void fuzz_decimal(const char *argument, fuzz_bytes input) {
    (void)argument;
    check_parse(input);
    if (input.size >= sizeof(double)) {
        check_format(input);
    }
}
