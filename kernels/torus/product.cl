/* Separable torus sums: a grid of frequencies as a product of two tables.
 *
 * With L = w (cos, sin)(2 pi l.x) and R = (cos, sin)(2 pi r.x), the four real sums of products
 *     cc, sc, cs, ss = sum_j L_{cos|sin} R_{cos|sin}
 * give S(l + r) = (cc - ss) - i (sc + cs) and S(l - r) = (cc + ss) - i (sc - cs): 4 fused
 * operations per point for two frequencies and their conjugates.
 *
 * One work-item owns one pair of tiles (LANES left times LANES right frequencies) of one
 * realization, and works through it in strips of STRIP left frequencies: 4 STRIP accumulators, one
 * vector of LANES right frequencies each. Runs are the outer loop, so that the strips of a run find
 * both tables in the first-level cache.
 *
 * Launch: (tile pairs, realizations), pairs rounded up at will; no local memory.
 *
 *   numbers  torus/product.h
 *   table    of torus/list.cl: left tiles (with weights), then right tiles (without)
 *   offsets  first point of each realization
 *   pairs    [pair]: left tile, right tile (pairs that nobody needs are not launched)
 *   sums     [realization][pair][left in tile][cc, sc, cs, ss][high, low][LANES], begun anew when
 *            is_first is set, else continued
 *   power    [row][stride], written when is_last is set: row first_row + realization gets
 *            scales[row] |S|^2 in the slots [pair][left in tile][l + r, l - r][LANES]
 */
#include "shared/real.h"
#include "shared/lanes.h"
#include "shared/pair.h"
#include "torus/layout.h"
#include "torus/powers.h"
#include "torus/product.h"

/* Kernels of the same program (docs/developer/decisions.md). */
#include "torus/list.cl"

/* With two operands, 4 STRIP accumulators are to fit into registers: 32 of them where vectors have
 * 512 bits, else 16 (half the time on AVX2, at N = 256 and K = 64). Results are equal to the bit.
 */
#ifndef STRIP
#if PRECISION * LANES > 256
#define STRIP 4
#else
#define STRIP 2
#endif
#endif
#if STRIP > LANES
#undef STRIP
#define STRIP LANES
#endif

__kernel void torus_product(const product_numbers numbers, __global const real *restrict table,
                            __global const ulong *restrict offsets,
                            __global const uint2 *restrict pairs, __global real *restrict sums,
                            __global const real *restrict scales, __global real *restrict power) {
    const ulong num_pairs = numbers.num_pairs, num_tiles = numbers.num_tiles;
    const ulong num_left_tiles = numbers.num_left_tiles, table_points = numbers.table_points;
    const uint is_first = numbers.is_first;
    const size_t pair = get_global_id(0);
    const size_t realization = get_global_id(1);
    if (pair >= num_pairs) {
        return;
    }
    const ulong count = offsets[realization + 1] - offsets[realization];
    const uint2 tiles = pairs[pair];
    __global const real *left_tile =
        table + (realization * num_tiles + tiles.x) * table_points * 2 * LANES;
    __global const real *right_tile =
        table + (realization * num_tiles + num_left_tiles + tiles.y) * table_points * 2 * LANES;
    __global real *tile_sums = sums + (realization * num_pairs + pair) * LANES * 8 * LANES;

    if (is_first && count == 0) { /* a pattern without points: the loop below never starts */
        for (int i = 0; i < LANES * 8; i++) {
            store_global(tile_sums, i, (realv)0);
        }
    }
    for (ulong run = 0; run < count; run += RUN) {
        const bool is_new = is_first && run == 0;
        const ulong run_end = min(run + RUN, count);
        for (int strip = 0; strip < LANES; strip += STRIP) {
            realv sum[STRIP][4];
#pragma unroll
            for (int i = 0; i < STRIP; i++) {
                sum[i][0] = sum[i][1] = sum[i][2] = sum[i][3] = (realv)0;
            }
            for (ulong j = run; j < run_end; j++) {
                const realv right_cos = load_global(right_tile, 2 * j);
                const realv right_sin = load_global(right_tile, 2 * j + 1);
                __global const real *row = left_tile + j * 2 * LANES + strip;
#pragma unroll
                for (int i = 0; i < STRIP; i++) {
                    const realv left_cos = (realv)row[i];
                    const realv left_sin = (realv)row[LANES + i];
                    sum[i][0] = fma(left_cos, right_cos, sum[i][0]);
                    sum[i][1] = fma(left_sin, right_cos, sum[i][1]);
                    sum[i][2] = fma(left_cos, right_sin, sum[i][2]);
                    sum[i][3] = fma(left_sin, right_sin, sum[i][3]);
                }
            }
#pragma unroll
            for (int i = 0; i < STRIP * 4; i++) {
                __global real *out = tile_sums + (strip * 4 + i) * 2 * LANES;
                realv high = is_new ? (realv)0 : load_global(out, 0);
                realv low = is_new ? (realv)0 : load_global(out, 1);
                pair_add(&high, &low, sum[i / 4][i % 4]);
                store_global(out, 0, high);
                store_global(out, 1, low);
            }
        }
    }
    if (numbers.is_last) {
        const size_t row = numbers.first_row + realization;
        __global real *out = power + row * numbers.stride + pair * LANES * 2 * LANES;
        for (int left = 0; left < LANES; left++) {
            realv sum[4], low[4];
#pragma unroll
            for (int i = 0; i < 4; i++) {
                sum[i] = load_global(tile_sums, (left * 4 + i) * 2);
                low[i] = load_global(tile_sums, (left * 4 + i) * 2 + 1);
            }
            store_powers(sum, low, (realv)scales[row], out + left * 2 * LANES);
        }
    }
}
