/* The sums of torus/product.cl by matrix units (torus/units.h), for devices that have them. Their
 * last digits are others than those of torus/product.cl, and depend neither on TILES nor on what is
 * beside a realization in a batch.
 *
 * A work-group of UNIT_ITEMS makes the factors of a block of TILES left times TILES right
 * tiles in local memory, as torus/product_shared.cl does, CHUNK points at a time. Each of its
 * warps has ROWS times COLUMNS unit tiles, whose sums go into second sums after UNIT_RUN points.
 *
 * Launch and arguments: of torus/product_shared.cl, with groups of UNIT_ITEMS, and
 *
 *   sums     the second sums are in [high], zeros in [low]
 *   runs     local, [step of the chunk][unit tile] of left tiles, then of right ones
 */
#include "shared/real.h"
#include "torus/factors.h"
#include "torus/layout.h"
#include "torus/product.h"
#include "torus/units.h"

#ifndef TILES
#define TILES BLOCK_TILES
#endif
#define ROWS UNIT_ROWS(PRECISION)
#define COLUMNS UNIT_COLUMNS
#define CHUNK UNIT_CHUNK
#define STEPS (CHUNK / STEP_POINTS)
#define LEFT_UNITS (TILES * LANES / UNIT_LEFT) /* unit tiles of a side of the block */
#define RIGHT_UNITS (TILES * LANES / UNIT_RIGHT)
#define ITEMS UNIT_ITEMS(PRECISION, TILES)
#define GAP (UNIT_GAP / sizeof(unit_word))
#define LEFT_STEP (LEFT_UNITS * LEFT_WORDS + GAP)
#define RIGHT_STEP (RIGHT_UNITS * RIGHT_WORDS + GAP)
typedef PS_JOIN(REAL, 2) real2;
#if WORD_POINTS == 2
#define WORD_OF(v, lane) ((real2)(v[0].lane, v[1].lane))
#else
#define WORD_OF(v, lane) v[0].lane
#endif

/* Calls put(to, first + number, j, cosines, sines) for the frequencies of a tile. */
#define PUT(put, to, first)                                                                        \
    do {                                                                                           \
        put(to, (first), j, WORD_OF(cosine, x), WORD_OF(sine, x));                                 \
        put(to, (first) + 1, j, WORD_OF(cosine, y), WORD_OF(sine, y));                             \
        put(to, (first) + 2, j, WORD_OF(cosine, z), WORD_OF(sine, z));                             \
        put(to, (first) + 3, j, WORD_OF(cosine, w), WORD_OF(sine, w));                             \
    } while (0)

/* Factors of the num points from first on, and zeros up to a whole chunk, of tiles first_tile .. of
 * one side, as make_factors has them. */
static inline void make_side(__local unit_word *to, const factors *from, const uint first_tile,
                             const uint end_tile, const ulong first, const uint num,
                             const int first_axis, const int last_axis, const int is_left) {
#pragma unroll 1
    for (uint i = get_local_id(0); i < CHUNK / WORD_POINTS * TILES; i += ITEMS) {
        const uint own = i / (CHUNK / WORD_POINTS);
        const uint point = i % (CHUNK / WORD_POINTS) * WORD_POINTS; /* of the chunk */
        const uint step = point / STEP_POINTS, j = point % STEP_POINTS;
        realv cosine[WORD_POINTS], sine[WORD_POINTS];
#pragma unroll
        for (uint p = 0; p < WORD_POINTS; p++) {
            make_factors(from, first_tile + own, end_tile, first + min(point + p, num - 1),
                         first_axis, last_axis, is_left, &cosine[p], &sine[p]);
            const realv there = (realv)(point + p < num ? 1 : 0);
            cosine[p] *= there;
            sine[p] *= there;
        }
        if (is_left) {
            __local unit_word *const tile =
                to + step * LEFT_STEP + own * LANES / UNIT_LEFT * LEFT_WORDS;
            PUT(put_left, tile, own * LANES % UNIT_LEFT);
        } else {
            __local unit_word *const tile = to + step * RIGHT_STEP + own * RIGHT_WORDS;
            PUT(put_right, tile, 0);
        }
    }
}

__kernel __attribute__((reqd_work_group_size(ITEMS, 1, 1))) void
torus_product_units(const product_numbers numbers, __global const ulong *restrict points,
                    __global const real *restrict weights, __global const ulong *restrict offsets,
                    __global const word *restrict frequencies,
                    __global const uint2 *restrict blocks, __global const uint *restrict pairs,
                    __global real *restrict sums, __global const real *restrict scales,
                    __global real *restrict power, __local unit_sums *runs) {
    const size_t block = get_global_id(1), realization = get_global_id(2);
    const ulong begin = offsets[realization], end = offsets[realization + 1];
    const uint num_left_tiles = (uint)numbers.num_left_tiles, num_tiles = (uint)numbers.num_tiles;
    const uint first_left = blocks[block].x, first_right = num_left_tiles + blocks[block].y;
    const factors from = {points, weights, frequencies, num_tiles};
    const uint lane = (uint)get_local_id(0) % WARP, warp = (uint)get_local_id(0) / WARP;
    const uint first_row = warp / (RIGHT_UNITS / COLUMNS) * ROWS; /* unit tiles of the warp */
    const uint first_column = warp % (RIGHT_UNITS / COLUMNS) * COLUMNS;
    __local unit_word *const left = (__local unit_word *)runs;
    __local unit_word *const right = left + STEPS * LEFT_STEP;
    unit_sums sum[ROWS * COLUMNS], total[ROWS * COLUMNS];

    /* Where the sums of unit tile i of the warp are: a left frequency of a pair, of all pairs. */
#define LEFT_OF(i) ((first_row + (i) / COLUMNS) * UNIT_LEFT + lane / 4)
#define PAIR_OF(i)                                                                                 \
    pairs[(block * TILES + LEFT_OF(i) / LANES) * TILES + first_column + (i) % COLUMNS]
#define PLACE_OF(i) ((size_t)PAIR_OF(i) * LANES + LEFT_OF(i) % LANES)
#define SUMS_OF(i)                                                                                 \
    (sums + (realization * numbers.num_pairs * LANES + PLACE_OF(i)) * 8 * LANES + lane % 4)
#pragma unroll
    for (uint i = 0; i < ROWS * COLUMNS; i++) {
        sum[i] = total[i] = (unit_sums)0;
        if (!numbers.is_first && PAIR_OF(i) != NO_PAIR) {
            __global const real *const own = SUMS_OF(i); /* cc, sc, cs, ss */
            total[i] = (unit_sums)(own[0], own[4 * LANES], own[2 * LANES], own[6 * LANES]);
        }
    }
    for (ulong run = begin; run < end; run += CHUNK) {
        const uint num = (uint)min((ulong)CHUNK, end - run);
        barrier(CLK_LOCAL_MEM_FENCE);
        make_side(left, &from, first_left, num_left_tiles, run, num, 0, LEFT_AXES, 1);
        make_side(right, &from, first_right, num_tiles, run, num, RIGHT_BEGIN, DIMENSION, 0);
        barrier(CLK_LOCAL_MEM_FENCE);
#pragma unroll 1
        for (uint step = 0; step < STEPS; step++) {
#pragma unroll
            for (uint i = 0; i < ROWS * COLUMNS; i++) {
                add_unit_tile(
                    &sum[i], left + step * LEFT_STEP + (first_row + i / COLUMNS) * LEFT_WORDS,
                    right + step * RIGHT_STEP + (first_column + i % COLUMNS) * RIGHT_WORDS, lane);
            }
        }
        if ((run - begin + CHUNK) % UNIT_RUN == 0 || run + CHUNK >= end) {
#pragma unroll
            for (uint i = 0; i < ROWS * COLUMNS; i++) {
                total[i] += sum[i];
                sum[i] = (unit_sums)0;
            }
        }
    }
    const real scale = scales[numbers.first_row + realization];
    __global real *const row = power + (numbers.first_row + realization) * numbers.stride;
#pragma unroll
    for (uint i = 0; i < ROWS * COLUMNS; i++) {
        const unit_sums s = total[i];
        if (PAIR_OF(i) == NO_PAIR) {
            continue;
        }
        if (!numbers.is_last || numbers.keeps_sums) {
            __global real *const own = SUMS_OF(i);
            own[0] = s.x;
            own[2 * LANES] = s.z;
            own[4 * LANES] = s.y;
            own[6 * LANES] = s.w;
            own[LANES] = own[3 * LANES] = own[5 * LANES] = own[7 * LANES] = 0;
        }
        if (numbers.is_last) {
            __global real *const out = row + PLACE_OF(i) * 2 * LANES + lane % 4;
            const real2 re = (real2)(s.x - s.w, s.x + s.w), im = (real2)(s.z + s.y, s.z - s.y);
            const real2 both = fma(re, re, im * im) * scale; /* l + r, l - r */
            out[0] = both.x;
            out[LANES] = both.y;
        }
    }
}
