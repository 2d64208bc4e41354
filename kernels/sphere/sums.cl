/* Coefficients c_lm = sum_j w_j Y_lm(u_j), m >= 0: nearly all the work of sphere_direct.
 *
 * A work-group owns ORDERS orders of one realization, and goes through its points in chunks, of
 * which each of its JOBS items has some vectors. For an order it makes w cos(m phi), w sin(m phi)
 * and sin^m(theta) of the points of a chunk, then walks up the degrees, DEGREES at a time: their
 * sums are in registers while the points, LANES side by side, pass by with the state of their
 * recurrences.
 *
 * Launch: (tiles of orders, realizations) in work-groups of JOBS items: one on CPUs, 64 on GPUs,
 * where two vectors an item and block of degrees take 416 instructions, sums over the group some
 * 110.
 *
 *   numbers        of sphere/sums.h; their names are used here
 *   values, turns  of sphere/prepare.cl
 *   weights        one per point, 0 for padding
 *   offsets        first vector of each realization, one more than realizations
 *   table          blocks, see sphere/legendre.h
 *   first_blocks   of each order in the table
 *   sums           [realization][order][re, im, re low, im low][stride], orders first_order .. of them; the low
 *                  parts only with has_low. Entries below degree m are 0 back to a multiple of SUM_ALIGNMENT; up to
 *                  DEGREES - 1 behind max_degree are overwritten
 *
 * sin^m(theta) underflows. Points where it does carry an exponent: the true state is 2^(SCALE_BITS
 * scale) times what is there. With scale 0 all is as usual; at -1 what it adds is scaled down,
 * which underflows at worst where nothing is lost; below, it adds nothing. The state takes a scale
 * up when it reaches SCALED_HIGH.
 */
#include "shared/real.h"
#include "shared/lanes.h"
#include "shared/pair.h"
#include "shared/turn.h"
#include "sphere/lane_sums.h"
#include "sphere/layout.h"
#include "shared/group_sums.h" /* with JOBS of the layout */
#include "sphere/legendre.h"
#include "sphere/order.h"
#include "sphere/sums.h"

/* Kernels of the same program (docs/developer/decisions.md). */
#include "sphere/power.cl"

#define VECTORS (CHUNK / LANES)
#define SUMS (2 * DEGREES)
#define SUM_ALIGNMENT 16

/* ---- a block of degrees ---------------------------------------------------------------------- */

/* One degree: written out for the same reason as in sphere/lane_sums.h. */
#define WALK(i)                                                                                    \
    if ((i) % step == first) {                                                                     \
        sums[i] = fma(c[(i) % 2], *p, sums[i]);                                                    \
        sums[DEGREES + (i)] = fma(s[(i) % 2], *p, sums[DEGREES + (i)]);                            \
    }                                                                                              \
    legendre_step(p, e, t, block, (i) + 1);

/* Adds the degrees first, first + step, .. of a block up, and takes the state to the next block. */
INLINE void walk(const chunk *at, const size_t v, TABLE *block, const realv factor,
                 const int is_weighed, realv *sums, realv *p, realv *e, const int first,
                 const int step) {
    const realv t = get_value(at, ARRAY_T, v);
    realv c[2], s[2];
    c[0] = load_local(at->memory + LOCAL_COSINE, v);
    s[0] = load_local(at->memory + LOCAL_SINE, v);
    c[1] = load_local(at->memory + LOCAL_SIDE_COSINE, v);
    s[1] = load_local(at->memory + LOCAL_SIDE_SINE, v);
    if (is_weighed) {
        c[0] *= factor;
        s[0] *= factor;
        c[1] *= factor;
        s[1] *= factor;
    }
    *p = load_local(at->memory + LOCAL_P, v);
    *e = load_local(at->memory + LOCAL_E, v);
    WALK(0)
    WALK(1)
    WALK(2)
    WALK(3)
    WALK(4)
    WALK(5)
    WALK(6)
    WALK(7)
    legendre_enter(p, e, block);
}

/* Points with an exponent. */
INLINE void walk_scaled(const chunk *at, const size_t v, TABLE *block, realv *sums, const int first,
                        const int step) {
    swordv scale = load_scale(at->scales + CHUNK, v);
    const realv below = scale == (swordv)-1 ? (realv)SCALED_DOWN : (realv)0;
    const realv factor = scale == (swordv)0 ? (realv)1 : below;
    realv p, e;
    walk(at, v, block, factor, 1, sums, &p, &e, first, step);
    /* With scale 0 a state never gets there. */
    const realv down = fabs(p) >= (realv)SCALED_HIGH ? (realv)SCALED_DOWN : (realv)1;
    scale = fabs(p) >= (realv)SCALED_HIGH ? scale + (swordv)1 : scale;
    store_local(at->memory + LOCAL_P, v, p * down);
    store_local(at->memory + LOCAL_E, v, e * down);
    store_scale(at->scales + CHUNK, v, scale);
    at->is_scaled[v] = any_negative(scale);
}

/* The sums of a block over the points of a chunk: SUMS numbers. */
INLINE void add_block(const chunk *at, TABLE *block, const int first, const int step,
                      real *totals) {
    realv sums[SUMS] = {(realv)0};
    for (size_t v = get_local_id(0); v < at->num_vectors; v += JOBS) {
        if (at->is_scaled[v]) {
            walk_scaled(at, v, block, sums, first, step);
        } else {
            realv p, e;
            walk(at, v, block, (realv)1, 0, sums, &p, &e, first, step);
            store_local(at->memory + LOCAL_P, v, p);
            store_local(at->memory + LOCAL_E, v, e);
        }
    }
    sum_lanes(sums, totals);
}

/* ---- what a chunk adds to an order ----------------------------------------------------------- */

/* One sum begins, or another chunk is added to it, as in shared/pair.h. */
INLINE void put_total(__global real *to, __global real *low, const real x, const int has_low,
                      const int is_first) {
    if (is_first) {
        *to = x;
        if (has_low) {
            *low = 0;
        }
        return;
    }
    const real old = *to;
    const real sum = old + x;
    const real x_part = sum - old;
    *low += (old - (sum - x_part)) + (x - x_part);
    *to = sum;
}

/* Sum i of a block into the rows of an order of a realization: re, im and their low parts. */
INLINE void put_sum(__global real *row, const ulong stride, TABLE *block, const uint i,
                    const real total, const int has_low, const int is_first) {
    __global real *to = row + i / DEGREES * stride + i % DEGREES;
    put_total(to, to + 2 * stride, total * block[BLOCK_RATIO + i % DEGREES], has_low, is_first);
}

#if JOBS == 1
INLINE void put_block(const chunk *at, __global real *row, const ulong stride, TABLE *block,
                      const real *totals, const int has_low, const int is_first) {
    (void)at;
    for (uint i = 0; i < SUMS; i++) {
        put_sum(row, stride, block, i, totals[i], has_low, is_first);
    }
}
#else
/* Sums of all items of the group, who all call it. */
INLINE void put_block(const chunk *at, __global real *row, const ulong stride, TABLE *block,
                      const real *totals, const int has_low, const int is_first) {
    const uint i = get_local_id(0);
    const real total = group_sum(at->of_items, at->of_parts, totals, SUMS);
    if (i < SUMS) {
        put_sum(row, stride, block, i, total, has_low, is_first);
    }
}
#endif

INLINE void clear_below(__global real *row, const ulong stride, const uint m, const int has_low) {
    for (int part = 0; part < (has_low ? 4 : 2); part++) {
        for (uint l = m / SUM_ALIGNMENT * SUM_ALIGNMENT; l < m; l++) {
            row[part * stride + l] = 0;
        }
    }
}

INLINE void add_order(const chunk *at, TABLE *block, __global real *row, const ulong stride,
                      const uint m, const uint max_degree, const int has_low, const int is_first) {
    real totals[SUMS];
    for (uint l = m; l <= max_degree; l += DEGREES) {
#if ONLY_EVEN
        if (m % 2 == 0) {
            add_block(at, block, 0, 2, totals);
        } else {
            add_block(at, block, 1, 2, totals);
        }
#else
        add_block(at, block, 0, 1, totals);
#endif
        put_block(at, row + l, stride, block, totals, has_low, is_first);
        block += BLOCK_REALS;
    }
}

__kernel __attribute__((reqd_work_group_size(JOBS, 1, 1))) void
sphere_sums(const sums_numbers numbers, __global const real *restrict values,
            __global const ulong *restrict turns, __global const real *restrict weights,
            __global const ulong *restrict offsets, __global const real *restrict table,
            __global const uint *restrict first_blocks, __global real *restrict sums) {
    const uint num_orders = numbers.num_orders, max_degree = numbers.max_degree;
    const uint has_low = numbers.has_low;
    const ulong stride = numbers.stride;
    __local real memory[LOCAL_REALS];
    __local SWORD scales[2 * CHUNK];
    __local uint is_scaled[VECTORS];
    __local real of_items[JOBS == 1 ? 1 : SUMS * (JOBS + 1)];
    __local real of_parts[JOBS];
    const uint first = get_group_id(0) * ORDERS;
    const uint last = min(first + ORDERS, num_orders);
    const size_t realization = get_group_id(1);
    const ulong begin = offsets[realization], end = offsets[realization + 1];
    for (ulong from = begin; from < end || from == begin; from += VECTORS) {
        chunk at;
        at.values = values + from * LANES;
        at.turns = turns + from * LANES;
        at.weights = weights + from * LANES;
        at.memory = memory;
        at.scales = scales;
        at.is_scaled = is_scaled;
        at.of_items = of_items;
        at.of_parts = of_parts;
        at.capacity = numbers.capacity;
        at.num_vectors = min(end - from, (ulong)VECTORS);
        const int begins = numbers.is_first && from == begin;
        for (uint order = first; order < last; order++) {
            const uint m = numbers.first_order + order;
            __global real *row = sums + (realization * num_orders + order) * 4 * stride;
            for (size_t v = get_local_id(0); v < at.num_vectors; v += JOBS) {
                begin_order(&at, v, m, order == first);
            }
            if (begins && get_local_id(0) == 0) {
                clear_below(row, stride, m, has_low);
            }
            add_order(&at, table + (ulong)first_blocks[order] * BLOCK_REALS, row, stride, m,
                      max_degree, has_low, begins);
        }
    }
}
