/* The sums of torus/product.cl without a table, by work-groups that share cosines and sines: for
 * devices with local memory of their own, where every work-item keeps its sums in registers.
 *
 * A block is BLOCK_TILES left times BLOCK_TILES right tiles of one realization. A job is STRIP left
 * frequencies times a right tile; a work-group takes as many jobs of a block at a time as it has
 * work-items. For the points of a run, one run after the other, the group makes the cosines and
 * sines of all frequencies of the block in local memory, by the operations of torus/list.cl; every
 * sum adds the same numbers in the same order as in torus/product.cl. So results are equal to the
 * bit. A job reads vectors that lie side by side, or one that its neighbours read, too.
 *
 * Launch: (work-items of one group, blocks, realizations).
 *
 *   numbers      torus/product.h; every sum is begun anew when is_first is set, powers are written
 *                when is_last is set, sums unless it is, or if keeps_sums is
 *   points, weights, offsets, frequencies
 *                of torus/list.cl: left tiles, with the weights, then right tiles
 *   blocks       [block]: first left tile, first right tile
 *   pairs        [block][left in block][right in block]: the pair, or NO_PAIR
 *   sums, scales, power
 *                of torus/product.cl
 *   runs         local, [RUN][cos, sin][BLOCK_TILES] vectors of left tiles, then of right tiles
 */
#include "shared/real.h"
#include "shared/lanes.h"
#include "shared/pair.h"
#include "torus/factors.h"
#include "torus/layout.h"
#include "torus/powers.h"
#include "torus/product.h"

/* In whole tokens, for it is part of the name of a type. */
#if PRECISION == 32
#define STRIP 4
#else
#define STRIP 2
#endif
#define STRIPS (LANES / STRIP)
typedef PS_JOIN(REAL, STRIP) strip_real;
#if STRIP == 4
#define STRIP_OF(v)                                                                                \
    { (realv) v.x, (realv)v.y, (realv)v.z, (realv)v.w }
#else
#define STRIP_OF(v)                                                                                \
    { (realv) v.x, (realv)v.y }
#endif
#define JOBS (BLOCK_TILES * STRIPS * BLOCK_TILES)

/* Cosines and sines of the num points from first on, of tiles first_tile .. of one side, over its
 * axes, which are constants in every call; zeros of tiles from end_tile on. */
static inline void make_side(__local realv *to, const factors *from, const uint first_tile,
                             const uint end_tile, const ulong first, const uint num,
                             const int first_axis, const int last_axis, const int is_weighted) {
    for (uint i = get_local_id(0); i < BLOCK_TILES * num; i += get_local_size(0)) {
        const uint own = i % BLOCK_TILES, j = i / BLOCK_TILES;
        __local realv *const at = to + 2 * j * BLOCK_TILES + own;
        realv cosine, sine;
        make_factors(from, first_tile + own, end_tile, first + j, first_axis, last_axis,
                     is_weighted, &cosine, &sine);
        at[0] = cosine;
        at[BLOCK_TILES] = sine;
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
        const realv right_cos = right[0], right_sin = right[BLOCK_TILES];
        const strip_real left_cos = left[0], left_sin = left[BLOCK_TILES * STRIPS];
        const realv cosines[STRIP] = STRIP_OF(left_cos);
        const realv sines[STRIP] = STRIP_OF(left_sin);
#pragma unroll
        for (int i = 0; i < STRIP; i++) {
            sum[i][0] = fma(cosines[i], right_cos, sum[i][0]);
            sum[i][1] = fma(sines[i], right_cos, sum[i][1]);
            sum[i][2] = fma(cosines[i], right_sin, sum[i][2]);
            sum[i][3] = fma(sines[i], right_sin, sum[i][3]);
        }
        left += 2 * BLOCK_TILES * STRIPS;
        right += 2 * BLOCK_TILES;
    }
#pragma unroll
    for (int i = 0; i < STRIP * 4; i++) {
        pair_add(&high[i / 4][i % 4], &low[i / 4][i % 4], sum[i / 4][i % 4]);
    }
}

__kernel void
torus_product_shared(const product_numbers numbers, __global const ulong *restrict points,
                     __global const real *restrict weights, __global const ulong *restrict offsets,
                     __global const word *restrict frequencies,
                     __global const uint2 *restrict blocks, __global const uint *restrict pairs,
                     __global real *restrict sums, __global const real *restrict scales,
                     __global real *restrict power, __local realv *runs) {
    const size_t block = get_global_id(1), realization = get_global_id(2);
    const ulong end = offsets[realization + 1];
    const uint num_left_tiles = (uint)numbers.num_left_tiles, num_tiles = (uint)numbers.num_tiles;
    const uint first_left = blocks[block].x, first_right = num_left_tiles + blocks[block].y;
    const factors from = {points, weights, frequencies, num_tiles};
    __local realv *const right_runs = runs + 2 * RUN * BLOCK_TILES;

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
        for (ulong run = offsets[realization]; run < end; run += RUN) {
            const uint num = (uint)min((ulong)RUN, end - run);
            barrier(CLK_LOCAL_MEM_FENCE);
            make_side(runs, &from, first_left, num_left_tiles, run, num, 0, LEFT_AXES, 1);
            make_side(right_runs, &from, first_right, num_tiles, run, num, RIGHT_BEGIN, DIMENSION,
                      0);
            barrier(CLK_LOCAL_MEM_FENCE);
            add_run(high, low, (__local const strip_real *)runs + strip, right_runs + right, num);
        }
        if (!is_own) {
            continue;
        }
        if (!numbers.is_last || numbers.keeps_sums) {
#pragma unroll
            for (int i = 0; i < STRIP * 4; i++) {
                store_global(own_sums, 2 * i, high[i / 4][i % 4]);
                store_global(own_sums, 2 * i + 1, low[i / 4][i % 4]);
            }
        }
#pragma unroll
        for (int i = 0; i < STRIP; i++) {
            const size_t row = numbers.first_row + realization;
            if (numbers.is_last) {
                store_powers(high[i], low[i], (realv)scales[row],
                             power + row * numbers.stride + (left + i) * 2 * LANES);
            }
        }
    }
}
