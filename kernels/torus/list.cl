/* Torus sums over a list of frequencies, and the tables of cosines and sines for separable grids.
 *
 * One work-item owns a tile (LANES frequencies; two tiles without a table) of one realization and
 * one chunk of its points: it walks through the points, forms w cos(2 pi k.x) and w sin(2 pi k.x),
 * adds them up and, when STORE_TABLE is set, also writes them down for torus/product.cl.
 *
 * Launch: (tiles, half as many without a table; chunks; realizations), the first rounded up at
 * will; no local memory.
 *
 *   points       [..][DIMENSION] fixed point, realization r at offsets[r] .. offsets[r + 1]
 *   weights      one per point
 *   offsets      first point of each realization, one more than realizations
 *   frequencies  [DIMENSION][num_tiles * LANES], two's complement words
 *   sums         [row][chunk][tile][cos high, cos low, sin high, sin low][LANES], rows first_row ..
 *   table        [realization][tile][point of the realization][cos, sin][LANES], table_points apart;
 *                never touched without STORE_TABLE
 *
 * In the table only the first weighted_tiles carry the weights (one factor of a product must, the
 * other must not); the sums always do. Numerical note: runs of LIST_RUN points in working
 * precision, pairs above.
 */
#include "shared/real.h"
#include "shared/lanes.h"
#include "shared/pair.h"
#include "shared/turn.h"
#include "torus/layout.h"
#include "torus/phase.h"

/* Kernels of the same program (docs/developer/decisions.md). */
#include "torus/fold.cl"
#include "torus/power.cl"

#ifndef STORE_TABLE
#define STORE_TABLE 0
#endif

/* Tiles of one work-item. Sums alone take two, which share the work on the coordinates of a point;
 * a table is written by one, since its two factors look at different axes. */
#define SIDE_BY_SIDE (STORE_TABLE ? 1 : 2)

/* Adds the points begin .. end - 1 up over the axes given, constants in every call, so that loops
 * unroll. (No restrict here: Oclgrind does not know what inlining makes of it.) */
static inline void add_points(__global const ulong *points, __global const real *weights,
                              const wordv k[][DIMENSION], const realv k_real[][DIMENSION],
                              const ulong begin, const ulong end, const int first_axis,
                              const int last_axis, const int is_weighted, __global real *row,
                              realv sums[][4]) {
    for (ulong run = begin; run < end; run += LIST_RUN) {
        const ulong run_end = min(run + LIST_RUN, end);
        realv cos_sum[SIDE_BY_SIDE], sin_sum[SIDE_BY_SIDE];
#pragma unroll
        for (int i = 0; i < SIDE_BY_SIDE; i++) {
            cos_sum[i] = sin_sum[i] = (realv)0;
        }
        for (ulong j = run; j < run_end; j++) {
            const realv weight = (realv)weights[j];
#pragma unroll
            for (int i = 0; i < SIDE_BY_SIDE; i++) {
                realv cosine, sine;
                turn_cosine_sine(
                    phase_of_point(k[i], k_real[i], points + j * DIMENSION, first_axis, last_axis),
                    &cosine, &sine);
                cos_sum[i] = fma(weight, cosine, cos_sum[i]);
                sin_sum[i] = fma(weight, sine, sin_sum[i]);
                if (STORE_TABLE) {
                    store_global(row, 0, is_weighted ? weight * cosine : cosine);
                    store_global(row, 1, is_weighted ? weight * sine : sine);
                    row += 2 * LANES;
                }
            }
        }
#pragma unroll
        for (int i = 0; i < SIDE_BY_SIDE; i++) {
            pair_add(&sums[i][0], &sums[i][1], cos_sum[i]);
            pair_add(&sums[i][2], &sums[i][3], sin_sum[i]);
        }
    }
}

__kernel void torus_list(__global const ulong *restrict points,
                         __global const real *restrict weights,
                         __global const ulong *restrict offsets,
                         __global const word *restrict frequencies, __global real *restrict sums,
                         const ulong first_row, const ulong num_tiles, const ulong chunk_points,
                         __global real *restrict table, const ulong table_points,
                         const ulong weighted_tiles) {
    const size_t tile = get_global_id(0) * SIDE_BY_SIDE;
    const size_t chunk = get_global_id(1), num_chunks = get_global_size(1);
    const size_t realization = get_global_id(2);
    if (tile >= num_tiles) {
        return;
    }
    const ulong first = offsets[realization];
    const ulong last = offsets[realization + 1];
    const ulong begin = min(first + chunk * chunk_points, last);
    const ulong end = min(begin + chunk_points, last);

    wordv k[SIDE_BY_SIDE][DIMENSION];
    realv k_real[SIDE_BY_SIDE][DIMENSION];
    realv pairs[SIDE_BY_SIDE][4];
    for (int i = 0; i < SIDE_BY_SIDE; i++) {
        const size_t at = min(tile + i, (size_t)num_tiles - 1); /* the last one twice, if odd */
        for (int axis = 0; axis < DIMENSION; axis++) {
            k[i][axis] = LOADV(axis * num_tiles + at, frequencies);
            k_real[i][axis] = TO_REALV(AS_SWORDV(k[i][axis]));
        }
        pairs[i][0] = pairs[i][1] = pairs[i][2] = pairs[i][3] = (realv)0;
    }
    __global real *row =
        table + ((realization * num_tiles + tile) * table_points + (begin - first)) * 2 * LANES;
    if (!STORE_TABLE) {
        add_points(points, weights, k, k_real, begin, end, 0, DIMENSION, 1, row, pairs);
    } else if (tile < weighted_tiles) {
        add_points(points, weights, k, k_real, begin, end, 0, LEFT_AXES, 1, row, pairs);
    } else {
        add_points(points, weights, k, k_real, begin, end, RIGHT_BEGIN, DIMENSION, 0, row, pairs);
    }
    __global real *out =
        sums + (((first_row + realization) * num_chunks + chunk) * num_tiles + tile) * 4 * LANES;
    for (size_t i = 0; i < SIDE_BY_SIDE && tile + i < num_tiles; i++) {
        for (int part = 0; part < 4; part++) {
            store_global(out, 4 * i + part, pairs[i][part]);
        }
    }
}
