/* What a transform along axis 0 of real numbers leaves, turned so that lanes are frequencies.
 * Device only.
 *
 * Lanes of the transform are 2 LANES neighbouring columns, half of them in real parts, half in
 * imaginary parts: with Z = A + i B, A(k) = (Z(k) + conj Z(-k)) / 2 and B(k) = (Z(k) - conj Z(-k))
 * / 2i.
 */
#ifndef PS_NUFFT_TRANSFORM_HALVES_H
#define PS_NUFFT_TRANSFORM_HALVES_H

#include "nufft/transform/finish.h"
#include "shared/transpose.h"

/* Frequencies k .. k + LANES - 1 of 2 LANES columns, twice each: [column][re, im][LANES], beyond K
 * anything. Times half the root of their gain if there are gains, and 0 beyond K. Four turns one
 * after the other: of all at once the vectors would not fit into registers. */
static inline void turn_halves(FFT_SPACE const real *cells, const size_t apart,
                               const transform_axis axis, const uint k, __global real *rows) {
    size_t here[LANES], there[LANES];
    real factor[LANES];
#pragma unroll
    for (uint i = 0; i < LANES; i++) {
        const uint at = min(k + i, axis.K);
        here[i] = axis.position[at] * apart;
        there[i] = axis.position[at == 0 ? 0 : axis.n - at] * apart;
        factor[i] = axis.gains == 0   ? 1
                    : k + i <= axis.K ? (real)0.5 * sqrt(axis.gains[at])
                                      : (real)0;
    }
#pragma unroll
    for (uint part = 0; part < 4; part++) {
        realv v[LANES];
#pragma unroll
        for (uint i = 0; i < LANES; i++) {
            const realv z = FFT_LOAD(cells + here[i], part == 1 || part == 2);
            const realv other = FFT_LOAD(cells + there[i], part == 1 || part == 2);
            v[i] = part == 3 ? other - z : part == 1 ? z - other : z + other;
            v[i] = axis.gains == 0 ? v[i] : v[i] * (realv)factor[i];
        }
        transpose(v);
#pragma unroll
        for (uint i = 0; i < LANES; i++) {
            store_global(rows, (part / 2 * LANES + i) * 2 + part % 2, v[i]);
        }
    }
}

#endif
