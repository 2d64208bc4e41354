/* From pole to pole: two tiles of LANES orders in one transform, to values on rings. Device only.
 *
 * Lambda_lm(theta) has the parity of m when theta goes on behind the pole. So only that part of the grid counts:
 * even tiles (orders m, m + 2, ...) are continued evenly, odd ones (m + 1, m + 3, ...) oddly. The sum of both is
 * transformed, and taken apart again by parity afterwards.
 *
 * Rings theta = 2 pi i / rings; the northern quarter of them is kept, since Lambda_lm has the parity of l + m under
 * north <-> south: sums (for even l + m) and differences (odd) of a ring and its mirror image.
 */
#ifndef PS_SPHERE_ORDERS_RINGS_H
#define PS_SPHERE_ORDERS_RINGS_H

#include "sphere/orders_grid.h"

/* Cells `pole + i` and `pole - i` of a tile continued behind both poles, i = 0 .. n / 2; sign is its parity. */
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

/* The sum of two tiles, twice what it is, which gains know. n is even. */
static inline void load_meridians(__local real *data, __global const real *even,
                                  __global const real *odd, const uint pole, const uint n) {
    for (uint i = get_local_id(0); i <= n / 2; i += get_local_size(0)) {
        const complexv a = continued(even, pole, n, i, 1);
        const complexv b = continued(odd, pole, n, i, -1);
        store_complex(data, i, complex_add(a, b));
        if (i > 0 && i < n / 2) {
            store_complex(data, n - i, complex_subtract(a, b));
        }
    }
}

/* Frequencies |k| <= L of n in the places of a transform of length `rings`, times their gains [L + 1]. */
static inline void copy_spectrum(__local real *to, const uint rings, __local const real *from,
                                 __global const uint *position, const uint n, const uint L,
                                 __global const real *gains) {
    for (uint k = get_local_id(0); k <= L; k += get_local_size(0)) {
        const complexv north = load_complex(from, position[k]);
        const complexv south = load_complex(from, position[k == 0 ? 0 : n - k]);
        const realv gain = (realv)gains[k];
        store_complex(to, k, (complexv){north.re * gain, north.im * gain});
        store_complex(to, k == 0 ? 0 : rings - k, (complexv){south.re * gain, south.im * gain});
    }
    for (uint k = L + 1 + get_local_id(0); k < rings - L; k += get_local_size(0)) {
        store_complex(to, k, (complexv){(realv)0, (realv)0});
    }
}

/* Where the values of a ring stand after the transform, and of its mirror image: theta, -theta. */
typedef struct ring_place {
    uint north, north_behind, south, south_behind;
    real weight; /* how often the ring counts, half of it where it is its own mirror image */
} ring_place;

static inline ring_place place_of_ring(__global const uint *position, const uint rings,
                                       const uint i) {
    const uint mirror = rings / 2 - i;
    return (ring_place){position[i], position[i == 0 ? 0 : rings - i], position[mirror],
                        position[rings / 2 + i], i == 0 || mirror == i ? 1 : 2};
}

/* Of one tile; sign -1: odd. The transform goes backwards, so the odd part changes its sign. */
static inline complexv value_on_ring(__local const real *data, const uint at, const uint behind,
                                     const real sign) {
    const complexv a = load_complex(data, at), b = load_complex(data, behind);
    return (complexv){fma((realv)sign, a.re, b.re), fma((realv)sign, a.im, b.im)};
}

/* LANES / 2 rings from `first` on of one tile: to[order][parity][ring][re, im], orders `apart` numbers apart; `num`
 * of the orders are there. */
static inline __attribute__((always_inline)) void
write_some_rings(__local const real *data, __global const uint *position, const uint rings,
                 const uint num_rings, const uint first, const real sign, __global real *to,
                 const size_t apart, const size_t parity_apart, const uint num) {
    realv sums[LANES], differences[LANES];
#pragma unroll
    for (int i = 0; i < LANES / 2; i++) {
        const bool is_there = first + i < num_rings;
        const ring_place place = place_of_ring(position, rings, is_there ? first + i : 0);
        const complexv north = value_on_ring(data, place.north, place.north_behind, sign);
        const complexv south = value_on_ring(data, place.south, place.south_behind, sign);
        const realv weight = (realv)(is_there ? place.weight : 0);
        sums[2 * i] = (north.re + south.re) * weight;
        sums[2 * i + 1] = (north.im + south.im) * weight;
        differences[2 * i] = (north.re - south.re) * weight;
        differences[2 * i + 1] = (north.im - south.im) * weight;
    }
    transpose(sums);
    transpose(differences);
#pragma unroll
    for (uint i = 0; i < LANES; i++) {
        if (i < num) {
            store_global(to + i * apart + 2 * first, 0, sums[i]);
            store_global(to + i * apart + parity_apart + 2 * first, 0, differences[i]);
        }
    }
}

#endif
