/* Powers |S|^2 from finished sums: the last pass of the torus engines.
 *
 * power is [row][stride]; every kernel fills its own range of slots of rows first_row .. on, one per
 * realization. scales[row] turns |S|^2 into the normalization asked for. The first extent of a launch
 * is rounded up at will.
 */
#include "shared/real.h"

/* Totals of torus/fold.cl. Launch: (tiles, realizations). Slots begin at first_slot. */
__kernel void torus_power_list(__global const real *restrict totals,
                               __global const real *restrict scales, __global real *restrict power,
                               const ulong num_tiles, const ulong first_row, const ulong first_slot,
                               const ulong stride) {
    const size_t tile = get_global_id(0);
    const size_t realization = get_global_id(1);
    if (tile >= num_tiles) {
        return;
    }
    __global const real *total = totals + (realization * num_tiles + tile) * 4 * LANES;
    const realv re = LOADV(0, total) + LOADV(1, total);
    const realv im = LOADV(2, total) + LOADV(3, total);
    const size_t row = first_row + realization;
    STOREV(fma(re, re, im * im) * (realv)scales[row], tile, power + row * stride + first_slot);
}

/* Sums of torus/product.cl. Launch: (tile pairs times LANES, realizations), one
 * work-item per left frequency of a pair.
 * Slots: [pair][left in tile][l + r, l - r][LANES]. */
__kernel void torus_power_product(__global const real *restrict sums,
                                  __global const real *restrict scales,
                                  __global real *restrict power, const ulong num_left,
                                  const ulong first_row, const ulong stride) {
    const size_t left = get_global_id(0); /* pair * LANES + left in tile */
    const size_t realization = get_global_id(1);
    if (left >= num_left) {
        return;
    }
    __global const real *sum = sums + (realization * num_left + left) * 8 * LANES;
    const realv scale = (realv)scales[first_row + realization];
    const realv cc = LOADV(0, sum), cc_low = LOADV(1, sum);
    const realv sc = LOADV(2, sum), sc_low = LOADV(3, sum);
    const realv cs = LOADV(4, sum), cs_low = LOADV(5, sum);
    const realv ss = LOADV(6, sum), ss_low = LOADV(7, sum);
    const realv plus_re = (cc - ss) + (cc_low - ss_low), plus_im = (sc + cs) + (sc_low + cs_low);
    const realv minus_re = (cc + ss) + (cc_low + ss_low), minus_im = (sc - cs) + (sc_low - cs_low);
    __global real *out = power + (first_row + realization) * stride + left * 2 * LANES;
    STOREV(fma(plus_re, plus_re, plus_im * plus_im) * scale, 0, out);
    STOREV(fma(minus_re, minus_re, minus_im * minus_im) * scale, 1, out);
}
