/* Phases of points mod 1 in fixed point, x in units of 2^-64: of a point for the lanes of a tile,
 * of LANES points for one k. Device only.
 *
 * exp(-2 pi i k x), k = 0 .. LANES - 1, takes cosines and sines of k = 1 .. LANES / 2 only, so that
 * a vector has room for those of two points; upper lanes are lower ones times exp(-2 pi i (LANES /
 * 2) x).
 */
#ifndef PS_NUFFT_PHASE_H
#define PS_NUFFT_PHASE_H

#include "nufft/cells.h"
#include "nufft/transform/butterfly.h"
#include "shared/turn.h"

__constant word lane_numbers[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

/* torus/phase.h has the reasons; off by at most 2 + 3 2^-24 k units of 2^-32 turns in single
 * precision, exact in double. */
static inline wordv phases_of_points(const uint k, const ulongv x) {
#if PRECISION == 64
    return x * (ulongv)k;
#else
    const float two_to_minus_32 = 2.3283064365386963e-10f;
    const realv low = TO_REALV(TO_WORDV(x)) * (realv)((float)k * two_to_minus_32);
    return TO_WORDV(x >> (ulongv)32) * (wordv)k + AS_WORDV(TO_SWORDV(low));
#endif
}

#if LANES == 1

static inline void lanes_of_two(const ulong x, const ulong next_x, complexv *lanes,
                                complexv *next_lanes) {
    (void)x;
    (void)next_x;
    *lanes = *next_lanes = (complexv){1, 0};
}

#else

/* The first number of each half, in all of it. */
#if LANES == 2
#define FIRST_OF_HALVES(v) (v)
#elif LANES == 4
#define FIRST_OF_HALVES(v) ((v).s0022)
#elif LANES == 8
#define FIRST_OF_HALVES(v) ((v).s00004444)
#elif LANES == 16
#define FIRST_OF_HALVES(v) ((v).s0000000088888888)
#endif

/* x as a word: in single precision off by half a unit, phases by less than 2^-29 turns. */
static inline word in_a_word(const ulong x) {
#if PRECISION == 64
    return x;
#else
    return (word)((x + 0x80000000) >> 32);
#endif
}

/* A half of the vectors for each of two points: k = LANES / 2, in the place of 0, where nothing
 * need be computed, and 1 .. LANES / 2 - 1. */
static inline void lanes_of_two(const ulong x, const ulong next_x, complexv *lanes,
                                complexv *next_lanes) {
    const wordv last = (wordv)(LANES / 2 - 1);
    const wordv number = LOADV(0, lane_numbers);
    wordv pair = (wordv)in_a_word(x);
    pair.hi = in_a_word(next_x);
    realv cosine, sine;
    turn_cosine_sine((((number - (wordv)1) & last) + (wordv)1) * pair, &cosine, &sine);
    const complexv low = {(number & last) == (wordv)0 ? (realv)1 : cosine,
                          (number & last) == (wordv)0 ? (realv)0 : -sine};
    const complexv high =
        complex_multiply_lanes(low, FIRST_OF_HALVES(cosine), -FIRST_OF_HALVES(sine));
    *lanes = (complexv){(realv)(low.re.lo, high.re.lo), (realv)(low.im.lo, high.im.lo)};
    *next_lanes = (complexv){(realv)(low.re.hi, high.re.hi), (realv)(low.im.hi, high.im.hi)};
}

#endif

#endif
