/* The number types of a kernel, for OpenCL C 1.2 and for C11.
 *
 * PRECISION 32 or 64 chooses float or double; LANES (OpenCL only) how many numbers travel together:
 * the native vector width on CPUs, a few on GPUs, where it means work per work-item. In C every
 * type is a scalar, so that shared headers can be tested on the host, one precision per source
 * file.
 *
 *   real, realv    a number, a vector of LANES numbers
 *   word, wordv    unsigned integers of the same width: fractions of a turn
 *   swordv         the same, signed
 */
#ifndef PS_SHARED_REAL_H
#define PS_SHARED_REAL_H

#ifndef PRECISION
#define PRECISION 32
#endif
#ifndef LANES
#define LANES 4
#endif

#ifdef __OPENCL_C_VERSION__

#pragma OPENCL FP_CONTRACT OFF /* only the fused operations that are written as fma() */
#if PRECISION == 64
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#define REAL double
#define WORD ulong
#define SWORD long
#else
#define REAL float
#define WORD uint
#define SWORD int
#endif

#define PS_JOIN_(a, b) a##b
#define PS_JOIN(a, b) PS_JOIN_(a, b)
#if LANES == 1
#define PS_VECTOR(type) type
#define LOADV(index, pointer) ((pointer)[index])
#define STOREV(value, index, pointer) ((pointer)[index] = (value))
#else
#define PS_VECTOR(type) PS_JOIN(type, LANES)
#define LOADV(index, pointer) PS_JOIN(vload, LANES)(index, pointer)
#define STOREV(value, index, pointer) PS_JOIN(vstore, LANES)(value, index, pointer)
#endif

typedef REAL real;
typedef WORD word;
typedef PS_VECTOR(REAL) realv;
typedef PS_VECTOR(WORD) wordv;
typedef PS_VECTOR(SWORD) swordv;
#define TO_REALV(x) PS_JOIN(convert_, PS_VECTOR(REAL))(x)
#define TO_SWORDV(x) PS_JOIN(convert_, PS_VECTOR(SWORD))(x) /* towards zero */
#define AS_SWORDV(x) PS_JOIN(as_, PS_VECTOR(SWORD))(x)
#define AS_WORDV(x) PS_JOIN(as_, PS_VECTOR(WORD))(x)
#define BITS_OF(x) AS_WORDV(x) /* of a number */
#define REAL_OF(bits) PS_JOIN(as_, PS_VECTOR(REAL))(bits)
/* Flips the sign of x where the top bit of the word is set; the other bits must be clear. */
#define FLIP_SIGN(x, bit) REAL_OF(BITS_OF(x) ^ (bit))

#else /* C11 */

#include <math.h>
#include <stdint.h>
#include <string.h>

#if PRECISION == 64
typedef double real;
typedef uint64_t word;
typedef int64_t sword;
#define fma(a, b, c) (fma)((a), (b), (c))
#else
typedef float real;
typedef uint32_t word;
typedef int32_t sword;
#define fma(a, b, c) fmaf((a), (b), (c))
#endif
typedef real realv;
typedef word wordv;
typedef sword swordv;
#define TO_REALV(x) ((real)(x))
#define TO_SWORDV(x) ((sword)(x))
#define AS_SWORDV(x) ((sword)(x))
#define AS_WORDV(x) ((word)(x))

static inline word BITS_OF(real x) {
    word bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline real REAL_OF(word bits) {
    real x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static inline real FLIP_SIGN(real x, word bit) {
    return REAL_OF(BITS_OF(x) ^ bit);
}

#endif

#endif
