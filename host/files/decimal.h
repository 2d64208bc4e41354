/* Decimal text and doubles, exact both ways and fast: point files are mostly digits.
 *
 * Reading gives the double that strtod gives, bit for bit; writing gives the shortest digits that
 * are read as the same double, so that a number survives a round trip. The decimal point is '.' in
 * every locale. Hexadecimal numbers, "inf" and "nan", which strtod reads, are not numbers here.
 */
#ifndef PS_FILES_DECIMAL_H
#define PS_FILES_DECIMAL_H

#include <stddef.h>

enum {
    PS_DECIMAL_PADDING =
        16,               /* readable bytes that must follow any text given to ps_decimal_parse */
    PS_DECIMAL_BYTES = 32 /* room for ps_decimal_format */
};

/* Reads a number that starts at text: [+-] digits [. digits] [e [+-] digits], where e may be d, as
 * Fortran writes it, and either be large. Returns the first character after it, or NULL when no
 * number starts here. Too large numbers give an infinity. At least PS_DECIMAL_PADDING bytes after
 * the number must be readable; their value is free. */
const char *ps_decimal_parse(const char *text, double *value);

/* Writes the shortest digits that are read as value, in the form of "%.17g" (an exponent below 1e-4
 * and from 1e17 on), with a NUL; returns the length. The shortest of doubles with an exponent that
 * are a power of two may have a digit more. */
size_t ps_decimal_format(char text[PS_DECIMAL_BYTES], double value);

#endif
