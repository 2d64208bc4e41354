/* Torus sums over a list of frequencies, and the tables of cosines and sines for separable grids.
 *
 * One work-item owns one tile (LANES frequencies) of one realization and one chunk of its points:
 * it walks through the points, forms w cos(2 pi k.x) and w sin(2 pi k.x), adds them up and, when
 * STORE_TABLE is set, also writes them down for torus/product.cl.
 *
 * Launch: (tiles, chunks, realizations), tiles rounded up at will; no local memory.
 *
 *   points       [..][DIMENSION] fixed point, realization r at offsets[r] .. offsets[r + 1]
 *   weights      one per point
 *   offsets      first point of each realization, one more than realizations
 *   frequencies  [DIMENSION][num_tiles * LANES], two's complement words
 *   sums         [realization][chunk][tile][cos high, cos low, sin high, sin low][LANES]
 *   table        [realization][tile][point of the realization][cos, sin][LANES], table_points apart
 *
 * In the table only the first weighted_tiles carry the weights (one factor of a product must, the
 * other must not); the sums always do. Numerical note: runs of LIST_RUN points in working
 * precision, pairs above.
 */
#include "shared/real.h"
#include "shared/pair.h"
#include "shared/turn.h"
#include "torus/layout.h"
#include "torus/phase.h"

#ifndef STORE_TABLE
#define STORE_TABLE 0
#endif

__kernel void
torus_list(__global const ulong *restrict points, __global const real *restrict weights,
           __global const ulong *restrict offsets, __global const word *restrict frequencies,
           __global real *restrict sums, const ulong num_tiles, const ulong chunk_points
#if STORE_TABLE
           ,
           __global real *restrict table, const ulong table_points, const ulong weighted_tiles
#endif
) {
    const size_t tile = get_global_id(0);
    const size_t chunk = get_global_id(1), num_chunks = get_global_size(1);
    const size_t realization = get_global_id(2);
    if (tile >= num_tiles) {
        return;
    }
    const ulong first = offsets[realization];
    const ulong last = offsets[realization + 1];
    const ulong begin = min(first + chunk * chunk_points, last);
    const ulong end = min(begin + chunk_points, last);

    wordv k[DIMENSION];
    realv k_real[DIMENSION];
    for (int axis = 0; axis < DIMENSION; axis++) {
        k[axis] = LOADV(axis * num_tiles + tile, frequencies);
        k_real[axis] = TO_REALV(AS_SWORDV(k[axis]));
    }
    realv cos_high = 0, cos_low = 0, sin_high = 0, sin_low = 0;
#if STORE_TABLE
    __global real *row =
        table + ((realization * num_tiles + tile) * table_points + (begin - first)) * 2 * LANES;
#endif
    for (ulong run = begin; run < end; run += LIST_RUN) {
        const ulong run_end = min(run + LIST_RUN, end);
        realv cos_sum = 0, sin_sum = 0;
        for (ulong j = run; j < run_end; j++) {
            realv cosine, sine;
            turn_cosine_sine(phase_of_point(k, k_real, points + j * DIMENSION), &cosine, &sine);
            const realv weight = (realv)weights[j];
            cos_sum = fma(weight, cosine, cos_sum);
            sin_sum = fma(weight, sine, sin_sum);
#if STORE_TABLE
            const realv factor = tile < weighted_tiles ? weight : (realv)1;
            STOREV(factor * cosine, 0, row);
            STOREV(factor * sine, 1, row);
            row += 2 * LANES;
#endif
        }
        pair_add(&cos_high, &cos_low, cos_sum);
        pair_add(&sin_high, &sin_low, sin_sum);
    }
    __global real *out = sums + ((realization * num_chunks + chunk) * num_tiles + tile) * 4 * LANES;
    STOREV(cos_high, 0, out);
    STOREV(cos_low, 1, out);
    STOREV(sin_high, 2, out);
    STOREV(sin_low, 3, out);
}
