/* Coordinates and cells of LANES points at a time. Device only. */
#ifndef PS_NUFFT_CELLS_H
#define PS_NUFFT_CELLS_H

#include "shared/real.h"

typedef PS_VECTOR(uint) uintv;
typedef PS_VECTOR(ulong) ulongv;
#define TO_UINTV(x) PS_JOIN(convert_, PS_VECTOR(uint))(x)
#define TO_ULONGV(x) PS_JOIN(convert_, PS_VECTOR(ulong))(x)
#define TO_WORDV(x) PS_JOIN(convert_, PS_VECTOR(WORD))(x)

/* Buffers are aligned as numbers, not always as vectors. */
typedef uintv unaligned_uintv __attribute__((aligned(sizeof(uint))));
typedef ulongv unaligned_ulongv __attribute__((aligned(sizeof(ulong))));

/* Where coordinates x, in units of 2^-64, fall on a fine grid of n cells. Of the `width` cells (2
 * .. n) that a window centred at n x covers, the first is floor(y), y = n x + 1 - width/2, and the
 * fraction f = y - floor(y) places the window: cell i of them is i + 1 - width/2 - f away from n x.
 * Integers throughout, so nothing is rounded but the fraction, to as many bits as a word has, and
 * nothing falls out of the grid. */
static inline uintv first_cells(const ulongv x, const uint n, const uint width, wordv *fraction) {
    const ulong half_cell = width % 2 != 0 ? (ulong)1 << 31 : 0;
    const ulongv low = (x & (ulongv)0xFFFFFFFF) * (ulongv)n;
    const ulongv high = (x >> (ulongv)32) * (ulongv)n + (low >> (ulongv)32) + (ulongv)half_cell;
    const uintv cell = TO_UINTV(high >> (ulongv)32) + (uintv)(1 - (width + 1) / 2);
#if PRECISION == 64
    *fraction = high << (ulongv)32 | (low & (ulongv)0xFFFFFFFF);
#else
    *fraction = TO_WORDV(high);
#endif
    return min(cell, cell + (uintv)n);
}

/* u = 2 f - 1 (nufft/window.h). */
static inline realv centred_fractions(const wordv fractions) {
#if PRECISION == 64
    const real unit = 1.0842021724855044e-19; /* 2^-63 */
#else
    const real unit = 4.656612873077393e-10f; /* 2^-31 */
#endif
    return TO_REALV(AS_SWORDV(fractions ^ (wordv)((word)1 << (PRECISION - 1)))) * (realv)unit;
}

/* Coordinate `axis` of LANES points [point][dimension], as few instructions as that takes. */
static inline ulongv load_coordinates(__global const ulong *from, const uint dimension,
                                      const uint axis) {
#if LANES > 1
    if (dimension <= 2) {
        const ulongv a = *(__global const unaligned_ulongv *)from;
        if (dimension == 1) {
            return a;
        }
        const ulongv b = *(__global const unaligned_ulongv *)(from + LANES);
        return axis == 0 ? (ulongv)(a.even, b.even) : (ulongv)(a.odd, b.odd);
    }
#endif
    ulong x[LANES];
#pragma unroll
    for (uint i = 0; i < LANES; i++) {
        x[i] = from[i * dimension + axis];
    }
    return LOADV(0, x);
}

/* The first `num` of them, the last one again for the rest. */
static inline ulongv load_some_coordinates(__global const ulong *from, const uint dimension,
                                           const uint axis, const uint num) {
    if (num >= LANES) {
        return load_coordinates(from, dimension, axis);
    }
    ulong x[LANES];
    for (uint i = 0; i < LANES; i++) {
        x[i] = from[min(i, num - 1) * dimension + axis];
    }
    return LOADV(0, x);
}

#endif
