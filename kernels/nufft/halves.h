/* What a transform along axis 0 of real numbers leaves, turned so that lanes are frequencies. Device only.
 *
 * Lanes of the transform are 2 LANES neighbouring columns, half of them in real parts, half in imaginary
 * parts: with Z = A + i B, A(k) = (Z(k) + conj Z(-k)) / 2 and B(k) = (Z(k) - conj Z(-k)) / 2i.
 */
#ifndef PS_NUFFT_HALVES_H
#define PS_NUFFT_HALVES_H

#include "nufft/finish.h"
#include "shared/transpose.h"

/* Frequencies k .. k + LANES - 1 of 2 LANES columns: [column][re, im][LANES], times the root of their gain if there
 * are gains; beyond K there are none. */
static inline void turn_halves(__local const real *cells, const transform_axis axis, const uint k,
                               __global real *rows) {
    realv a_re[LANES], a_im[LANES], b_re[LANES], b_im[LANES];
#pragma unroll
    for (int i = 0; i < LANES; i++) {
        const uint at = min(k + i, axis.K);
        const complexv z = load_complex(cells, axis.position[at]);
        const complexv other = load_complex(cells, axis.position[at == 0 ? 0 : axis.n - at]);
        const real gain = axis.gains == 0 ? 1 : sqrt(axis.gains[at]);
        const realv factor = (realv)(k + i <= axis.K ? gain * (real)0.5 : 0);
        a_re[i] = (z.re + other.re) * factor;
        a_im[i] = (z.im - other.im) * factor;
        b_re[i] = (z.im + other.im) * factor;
        b_im[i] = (other.re - z.re) * factor;
    }
    transpose(a_re);
    transpose(a_im);
    transpose(b_re);
    transpose(b_im);
#pragma unroll
    for (int i = 0; i < LANES; i++) {
        store_global_complex(rows, i, (complexv){a_re[i], a_im[i]});
        store_global_complex(rows, LANES + i, (complexv){b_re[i], b_im[i]});
    }
}

#endif
