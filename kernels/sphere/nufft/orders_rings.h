/* From pole to pole: two tiles of LANES orders in one transform, to values on rings. Device only.
 *
 * Lambda_lm(theta) has the parity of m when theta goes on behind the pole. So only that part of the
 * grid counts: even tiles (orders m, m + 2, ...) are continued evenly, odd ones (m + 1, m + 3, ...)
 * oddly. The sum of both is transformed, and taken apart again by parity afterwards.
 *
 * Rings theta = 2 pi i / rings; the northern quarter of them is kept, since Lambda_lm has the
 * parity of l + m under north <-> south: sums (for even l + m) and differences (odd) of a ring and
 * its mirror image.
 */
#ifndef PS_SPHERE_ORDERS_RINGS_H
#define PS_SPHERE_ORDERS_RINGS_H

#include "sphere/nufft/orders_grid.h"

/* Cells `pole + i` and `pole - i` of a tile continued behind both poles, i = 0 .. n / 2; sign is
 * its parity. */
static inline complexv continued(__global const real *tile, const uint pole, const uint n,
                                 const uint i, const real sign) {
    const uint south = n / 2 - i;
    complexv sum = load_global_complex(tile, pole + i);
    if (i <= pole) {
        const complexv behind = load_global_complex(tile, pole - i);
        sum.re = fma((realv)sign, behind.re, sum.re);
        sum.im = fma((realv)sign, behind.im, sum.im);
    }
    if (south <= pole) {
        const complexv behind = load_global_complex(tile, pole + n / 2 + south);
        sum.re = fma((realv)sign, behind.re, sum.re);
        sum.im = fma((realv)sign, behind.im, sum.im);
    }
    return sum;
}

/* The sum x of two tiles all around the circle, twice what it is, which gains know, on its way to a
 * transform of length n, which is two of half the length: x(i) + x(i + n/2) for even frequencies,
 * [0 .. n/2 - 1] of data, and (x(i) - x(i + n/2)) exp(-2 pi i i / n) for odd ones, behind them.
 * turns [n/2][cosine, sine]. With a, b the tiles of even and odd orders, x(i) = a(i) + b(i), x(n -
 * i) = a(i) - b(i). */
static inline void load_meridians(__global real *data, __global const real *even,
                                  __global const real *odd, const uint pole, const uint n,
                                  __global const real *turns) {
    const uint middle = n / 2;
    for (uint i = 0; i <= middle / 2; i++) {
        const uint j = middle - i;
        const complexv a = continued(even, pole, n, i, 1), far_a = continued(even, pole, n, j, 1);
        const complexv b = continued(odd, pole, n, i, -1), far_b = continued(odd, pole, n, j, -1);
        const complexv a_sum = complex_add(a, far_a), a_rest = complex_subtract(a, far_a);
        const complexv b_sum = complex_add(b, far_b), b_rest = complex_subtract(b, far_b);
        store_complex(data, i, complex_add(a_sum, b_rest));
        store_complex(data, middle + i,
                      complex_multiply(complex_add(b_sum, a_rest), turns[2 * i], turns[2 * i + 1]));
        if (i > 0 && j > i) {
            store_complex(data, j, complex_subtract(a_sum, b_rest));
            store_complex(
                data, middle + j,
                complex_multiply(complex_subtract(b_sum, a_rest), turns[2 * j], turns[2 * j + 1]));
        }
    }
}

/* Frequencies k of one parity, |k| <= L, of a transform of length `middle` to the places of one of
 * length `half_rings`, times their gains [L + 1]. k = 2 q + parity is number q of both, modulo
 * their lengths. */
static inline void copy_spectrum(__global real *to, const uint half_rings,
                                 __global const real *from, __global const uint *position,
                                 const uint middle, const uint L, const uint parity,
                                 __global const real *gains) {
    const uint num = (L - parity) / 2 + 1;
    for (uint q = 0; q < num; q++) {
        const uint back = q + parity; /* -k is number -back */
        const complexv north = load_complex(from, position[q]);
        const complexv south = load_complex(from, position[back == 0 ? 0 : middle - back]);
        const realv gain = (realv)gains[2 * q + parity];
        store_complex(to, q, (complexv){north.re * gain, north.im * gain});
        store_complex(to, back == 0 ? 0 : half_rings - back,
                      (complexv){south.re * gain, south.im * gain});
    }
    for (uint q = num; q + num + parity <= half_rings; q++) {
        store_complex(to, q, (complexv){(realv)0, (realv)0});
    }
}

/* Where values of rings go, [order][sum, difference][ring][re, im]. */
typedef struct ring_target {
    __global real *to; /* of order 0 */
    size_t order_apart, parity_apart;
    uint L;
} ring_target;

/* LANES / 2 rings of one tile from registers; num of the orders are there. */
static inline __attribute__((always_inline)) void write_tile(realv *rings, __global real *to,
                                                             const size_t apart, const uint num) {
    transpose(rings);
#pragma unroll
    for (uint i = 0; i < LANES; i++) {
        if (i < num) {
            store_global(to + i * apart, 0, rings[i]);
        }
    }
}

/* LANES / 2 rings from `first` on of both tiles. F, the transform of the frequencies of one parity,
 * gives f(i) = F(i) for even and exp(-2 pi i i / rings) F(i) for odd ones. The value at theta is
 * f(-i) + f(i) where orders are even and f(-i) - f(i) where they are odd; at pi - theta it is the
 * same for even frequencies and even orders or for odd ones and odd orders, and the opposite else.
 * So even frequencies make the sums of a ring and its mirror image for even orders and the
 * differences for odd ones, and the other way round. turns [num_rings][cosine, sine].
 *
 * A ring counts twice, once where it is its own mirror image, which gains do not know; they know
 * the two of a sum. */
static inline __attribute__((always_inline)) void
write_some_rings(__global const real *data, __global const uint *position, const uint half_rings,
                 const uint num_rings, const uint first, const uint parity,
                 __global const real *turns, const ring_target target, const uint first_order) {
    realv of_even[LANES], of_odd[LANES];
#pragma unroll
    for (int i = 0; i < LANES / 2; i++) {
        const uint ring = first + i < num_rings ? first + i : 0;
        const real is_there = first + i < num_rings ? 1 : 0;
        const real weight = ring == 0 || 2 * ring == half_rings ? is_there : 2 * is_there;
        const real cosine = parity == 0 ? 1 : turns[2 * ring];
        const real sine = parity == 0 ? 0 : turns[2 * ring + 1];
        const complexv f =
            complex_multiply(load_complex(data, position[ring]), cosine * weight, sine * weight);
        const complexv back =
            complex_multiply(load_complex(data, position[ring == 0 ? 0 : half_rings - ring]),
                             cosine * weight, -sine * weight);
        of_even[2 * i] = back.re + f.re;
        of_even[2 * i + 1] = back.im + f.im;
        of_odd[2 * i] = back.re - f.re;
        of_odd[2 * i + 1] = back.im - f.im;
    }
    const uint L = target.L;
    const size_t apart = 2 * target.order_apart;
    __global real *to = target.to + first_order * target.order_apart + 2 * first;
    write_tile(of_even, to + parity * target.parity_apart, apart, (L - first_order) / 2 + 1);
    write_tile(of_odd, to + target.order_apart + (1 - parity) * target.parity_apart, apart,
               first_order < L ? (L - first_order - 1) / 2 + 1 : 0);
}

#endif
