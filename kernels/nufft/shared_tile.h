/* The last tile of realizations that one work-group does one after the other, where few of its
 * lanes are asked for (one of 16, if K is a multiple of 16): several realizations in a row, side by
 * side. Nothing depends on what stands in other lanes. Device only.
 */
#ifndef PS_NUFFT_SHARED_TILE_H
#define PS_NUFFT_SHARED_TILE_H

#include "nufft/transform/finish.h"

/* lanes: of a realization; first_lane: of this one; k: frequency of its first lane */
typedef struct shared_tile {
    __global real *row; /* [columns][re, im][LANES] */
    uint lanes, first_lane, k;
} shared_tile;

static inline void put_lanes(__global real *to, const realv x) {
    union {
        realv together;
        real x[LANES];
    } of = {x};
#pragma unroll
    for (uint i = 0; i < LANES; i++) {
        to[i * 2 * LANES] = of.x[i];
    }
}

/* Collects, for 2 LANES columns that were transformed at `cells`, what turn_halves() of
 * nufft/transform/halves.h makes of these lanes. */
static inline void collect_columns(const shared_tile to, const uint column,
                                   FFT_SPACE const real *cells, const size_t apart,
                                   const transform_axis axis) {
    for (uint lane = 0; lane < to.lanes; lane++) {
        const uint k = to.k + lane;
        const complexv z = load_complex(cells + axis.position[k] * apart, 0);
        const complexv other =
            load_complex(cells + axis.position[k == 0 ? 0 : axis.n - k] * apart, 0);
        __global real *at = to.row + column * 2 * LANES + to.first_lane + lane;
        put_lanes(at, z.re + other.re);
        put_lanes(at + LANES, z.im - other.im);
        put_lanes(at + 2 * LANES * LANES, z.im + other.im);
        put_lanes(at + 2 * LANES * LANES + LANES, other.re - z.re);
    }
}

/* Powers of the lanes from first_lane on, where they have a gain, to the first lanes of power.
 * Loads go on into what follows: there is a vector of room behind the row. */
static inline void write_lanes(const shared_tile from, const transform_axis axis, const real scale,
                               __global const real *gains, __global real *power) {
    for (uint i = get_local_id(0); i < 2 * axis.K + 1; i += get_local_size(0)) {
        const complexv z = kept_frequency(from.row + from.first_lane, axis, i);
        const realv gain = load_global(gains, i);
        const realv value = fma(z.re, z.re, z.im * z.im) * (gain * (realv)scale);
        store_global(power, i, gain == (realv)0 ? (realv)0 : value);
    }
}

#endif
