/* What reading and printing of doubles know of their bits. Private to host/files. */
#ifndef PS_FILES_DECIMAL_BITS_H
#define PS_FILES_DECIMAL_BITS_H

#include "files/decimal.h"

#if defined(__SIZEOF_INT128__)
#define HAVE_WIDE_INTEGERS 1
__extension__ typedef unsigned __int128 wide; /* -Wpedantic: not in ISO C, hence the #if */
#else
#define HAVE_WIDE_INTEGERS 0
#endif

enum { MANTISSA_BITS = 53, EXPONENT_BIAS = 1023 };

#endif
