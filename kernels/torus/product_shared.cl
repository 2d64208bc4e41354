/* The sums of torus/product.cl, by work-groups that share the tables: for devices with local memory
 * of their own, where every work-item keeps its sums in registers.
 *
 * A block is BLOCK_TILES left times BLOCK_TILES right tiles of one realization. A job is STRIP left
 * frequencies times a right tile; a work-group takes as many jobs of a block at a time as it has
 * work-items. The points of a run come into local memory, one run after the other. Every sum adds
 * the same numbers in the same order as in torus/product.cl, so results are equal to the bit.
 *
 * Launch: (work-items of one group, blocks, realizations).
 *
 *   numbers, table, offsets, sums, scales, power
 *            of torus/product.cl; every sum is begun anew when is_first is set, and powers are
 *            written when is_last is set
 *   blocks   [block]: first left tile, first right tile
 *   pairs    [block][left in block][right in block]: the pair, or NO_PAIR
 *   runs     local, [RUN][cos, sin][ROW] of left tiles, then of right tiles
 */
#ifndef LANES
#define LANES 4 /* whole strips */
#endif
#include "shared/real.h"
#include "shared/lanes.h"
#include "shared/pair.h"
#include "torus/layout.h"
#include "torus/powers.h"
#include "torus/product.h"

#define STRIP PRODUCT_STRIP
#define STRIPS (LANES / STRIP)
typedef PS_JOIN(REAL, 2) strip_real;
#define JOBS (BLOCK_TILES * STRIPS * BLOCK_TILES)

/* Vectors of a side, and one more: work-items that write neighbouring rows use other banks. */
#define ROW (BLOCK_TILES + 1)

/* Points first .. first + num - 1 of tiles first_tile .. of one side; zeros of those behind
 * end_tile. */
static inline void load_side(__local realv *to, __global const realv *table, const uint first_tile,
                             const uint end_tile, const ulong table_points, const ulong first,
                             const uint num) {
    for (uint i = get_local_id(0); i < BLOCK_TILES * 2 * RUN; i += get_local_size(0)) {
        const uint tile = first_tile + i / (2 * RUN), row = i % (2 * RUN);
        if (row < 2 * num) {
            to[row * ROW + i / (2 * RUN)] =
                tile < end_tile ? table[(tile * table_points + first) * 2 + row] : (realv)0;
        }
    }
}

/* Adds a run of num points. left: of the strip; right: of the tile. */
static inline void add_run(realv high[STRIP][4], realv low[STRIP][4],
                           __local const strip_real *left, __local const realv *right,
                           const uint num) {
    realv sum[STRIP][4];
#pragma unroll
    for (int i = 0; i < STRIP; i++) {
        sum[i][0] = sum[i][1] = sum[i][2] = sum[i][3] = (realv)0;
    }
    for (uint j = 0; j < num; j++) {
        const realv right_cos = right[0], right_sin = right[ROW];
        const strip_real left_cos = left[0], left_sin = left[ROW * STRIPS];
        const realv cosines[STRIP] = {(realv)left_cos.x, (realv)left_cos.y};
        const realv sines[STRIP] = {(realv)left_sin.x, (realv)left_sin.y};
#pragma unroll
        for (int i = 0; i < STRIP; i++) {
            sum[i][0] = fma(cosines[i], right_cos, sum[i][0]);
            sum[i][1] = fma(sines[i], right_cos, sum[i][1]);
            sum[i][2] = fma(cosines[i], right_sin, sum[i][2]);
            sum[i][3] = fma(sines[i], right_sin, sum[i][3]);
        }
        left += 2 * ROW * STRIPS;
        right += 2 * ROW;
    }
#pragma unroll
    for (int i = 0; i < STRIP * 4; i++) {
        pair_add(&high[i / 4][i % 4], &low[i / 4][i % 4], sum[i / 4][i % 4]);
    }
}

__kernel void
torus_product_shared(const product_numbers numbers, __global const realv *restrict table,
                     __global const ulong *restrict offsets, __global const uint2 *restrict blocks,
                     __global const uint *restrict pairs, __global real *restrict sums,
                     __global const real *restrict scales, __global real *restrict power,
                     __local realv *runs) {
    const size_t block = get_global_id(1), realization = get_global_id(2);
    const ulong count = offsets[realization + 1] - offsets[realization];
    const uint num_left_tiles = (uint)numbers.num_left_tiles, num_tiles = (uint)numbers.num_tiles;
    const uint first_left = blocks[block].x, first_right = num_left_tiles + blocks[block].y;
    __global const realv *own_table = table + realization * num_tiles * numbers.table_points * 2;
    __local realv *const right_runs = runs + 2 * RUN * ROW;

    for (uint first_job = 0; first_job < JOBS; first_job += (uint)get_local_size(0)) {
        const uint job = min(first_job + (uint)get_local_id(0), (uint)JOBS - 1);
        const uint right = job % BLOCK_TILES, strip = job / BLOCK_TILES;
        const uint pair = pairs[(block * BLOCK_TILES + strip / STRIPS) * BLOCK_TILES + right];
        const bool is_own = pair != NO_PAIR && first_job + get_local_id(0) < JOBS;
        const bool is_new = numbers.is_first || !is_own;
        const size_t left = pair * (size_t)LANES + strip % STRIPS * STRIP; /* of all pairs */
        __global real *own_sums =
            sums + (realization * numbers.num_pairs * LANES + left) * 8 * LANES;
        realv high[STRIP][4], low[STRIP][4];
#pragma unroll
        for (int i = 0; i < STRIP * 4; i++) {
            high[i / 4][i % 4] = is_new ? (realv)0 : load_global(own_sums, 2 * i);
            low[i / 4][i % 4] = is_new ? (realv)0 : load_global(own_sums, 2 * i + 1);
        }
        for (ulong run = 0; run < count; run += RUN) {
            const uint num = (uint)min((ulong)RUN, count - run);
            barrier(CLK_LOCAL_MEM_FENCE);
            load_side(runs, own_table, first_left, num_left_tiles, numbers.table_points, run, num);
            load_side(right_runs, own_table, first_right, num_tiles, numbers.table_points, run,
                      num);
            barrier(CLK_LOCAL_MEM_FENCE);
            add_run(high, low, (__local const strip_real *)runs + strip, right_runs + right, num);
        }
        if (!is_own) {
            continue;
        }
#pragma unroll
        for (int i = 0; i < STRIP * 4; i++) {
            store_global(own_sums, 2 * i, high[i / 4][i % 4]);
            store_global(own_sums, 2 * i + 1, low[i / 4][i % 4]);
        }
        for (int i = 0; i < STRIP && numbers.is_last; i++) {
            const size_t row = numbers.first_row + realization;
            store_powers(own_sums + i * 8 * LANES, (realv)scales[row],
                         power + row * numbers.stride + (left + i) * 2 * LANES);
        }
    }
}
