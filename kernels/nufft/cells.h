/* nufft/cell.h for LANES coordinates side by side. Device only. */
#ifndef PS_NUFFT_CELLS_H
#define PS_NUFFT_CELLS_H

#include "shared/real.h"

typedef PS_VECTOR(uint) uintv;
typedef PS_VECTOR(ulong) ulongv;
typedef PS_VECTOR(long) longv;
typedef uintv unaligned_uintv __attribute__((aligned(sizeof(uint))));
typedef ulongv unaligned_ulongv __attribute__((aligned(sizeof(ulong))));
#define TO_UINTV(x) PS_JOIN(convert_, PS_VECTOR(uint))(x)

/* first_cell() */
static inline ulongv first_cells(const ulongv x, const uint n, const uint width,
                                 ulongv *fractions) {
    const ulongv half_cell = (ulongv)(width % 2 != 0 ? (ulong)1 << 63 : 0);
    const ulongv cells = (ulongv)n;
    const ulongv bits = (ulongv)32;
    const ulongv low = x * cells + half_cell;
    const ulongv high =
        ((x >> bits) * cells + (((x & (ulongv)0xFFFFFFFF) * cells) >> bits)) >> bits;
    const ulongv carry = low < half_cell ? (ulongv)1 : (ulongv)0;
    const ulongv shifted = high + carry + (ulongv)(n + 1 - (width + 1) / 2);
    *fractions = low;
    return shifted >= cells ? shifted - cells : shifted;
}

/* centred() of nufft/window.h */
static inline realv all_centred(const ulongv fractions) {
    const real two_to_minus_63 = (real)1.0842021724855044e-19;
    const longv bits = PS_JOIN(as_, PS_VECTOR(long))(fractions ^ (ulongv)((ulong)1 << 63));
    return TO_REALV(bits) * (realv)two_to_minus_63;
}

#endif
