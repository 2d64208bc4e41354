/* Coefficients c_lm = sum_j w_j Y_lm(u_j), m >= 0: nearly all the work of sphere_direct.
 *
 * One work-item owns ORDERS orders of one realization, and goes through its points in chunks. For an order it makes
 * w cos(m phi), w sin(m phi) and sin^m(theta) of the points of a chunk, then walks up the degrees, DEGREES at a time:
 * their sums are in registers while the points, LANES side by side, pass by with the state of their recurrences.
 *
 * Launch: (tiles of orders, realizations) in work-groups of one item, since local memory belongs to one.
 *
 *   values, turns  of sphere/prepare.cl
 *   weights        one per point, 0 for padding
 *   offsets        first vector of each realization, one more than realizations
 *   table          blocks, see sphere/legendre.h
 *   first_blocks   of each order in the table
 *   sums           [realization][order][re, im, re low, im low][stride], orders first_order .. of them; the low
 *                  parts only with has_low, which realizations of several chunks need. Entries below degree m are 0
 *                  back to a multiple of SUM_ALIGNMENT; up to DEGREES - 1 behind max_degree are overwritten
 *   is_first       sums begin anew; else they are added to
 *
 * sin^m(theta) underflows. Points where it does carry an exponent: the true state is 2^(SCALE_BITS scale) times what
 * is there. With scale 0 all is as usual; at -1 what it adds is scaled down, which underflows at worst where nothing is
 * lost; below, it adds nothing. The state takes a scale up when it reaches SCALED_HIGH.
 */
#include "shared/real.h"
#include "shared/lanes.h"
#include "shared/pair.h"
#include "shared/turn.h"
#include "sphere/lane_sums.h"
#include "sphere/layout.h"
#include "sphere/legendre.h"
#include "sphere/scaled.h"

#define VECTORS (CHUNK / LANES)
#define SUMS (2 * DEGREES)
#define SUM_ALIGNMENT 16

/* Local memory of a work-item: what the points of a chunk carry from degree to degree and from order to order. */
#define LOCAL_P 0
#define LOCAL_E (LOCAL_P + CHUNK)
#define LOCAL_COSINE (LOCAL_E + CHUNK) /* times the weight */
#define LOCAL_SINE (LOCAL_COSINE + CHUNK)
#define LOCAL_SIDE_COSINE (LOCAL_SINE + CHUNK) /* and times the side, for odd l - m */
#define LOCAL_SIDE_SINE (LOCAL_SIDE_COSINE + CHUNK)
#define LOCAL_HIGH (LOCAL_SIDE_SINE + CHUNK) /* sin^m(theta) */
#define LOCAL_REALS (LOCAL_HIGH + CHUNK)

typedef swordv unaligned_swordv __attribute__((aligned(sizeof(real))));
typedef PS_VECTOR(ulong) ulongv;

/* The pointers of a work-item. */
typedef struct chunk {
    __global const real *values;
    __global const ulong *turns;
    __global const real *weights;
    __local real *memory;
    __local SWORD *scales; /* [2][CHUNK]: of sin^m(theta), of the state */
    __local uint *is_scaled;
    ulong capacity;
    size_t num_vectors;
} chunk;

INLINE realv get_value(const chunk *at, const int array, const size_t v) {
    return load_global(at->values + array * at->capacity, v);
}

INLINE swordv load_scale(__local const SWORD *from, const size_t v) {
    return *(__local const unaligned_swordv *)(from + v * LANES);
}

INLINE void store_scale(__local SWORD *to, const size_t v, const swordv x) {
    *(__local unaligned_swordv *)(to + v * LANES) = x;
}

/* ---- an order begins ------------------------------------------------------------------------- */

/* The first order of a tile: exact phases, powers in pairs. */
INLINE void begin_exactly(const chunk *at, const size_t v, const uint m, realv *cosine, realv *sine,
                          scaled *power) {
    const realv weight = load_global(at->weights, v);
    ulongv turn;
#if LANES == 1
    turn = at->turns[v] * m;
#else
    turn = PS_JOIN(vload, LANES)(v, at->turns) * (ulongv)(ulong)m;
#endif
#if PRECISION == 64
    turn_cosine_sine(turn, cosine, sine);
#else
    turn_cosine_sine(PS_JOIN(convert_, PS_VECTOR(WORD))(turn >> (ulongv)32), cosine, sine);
#endif
    *cosine *= weight;
    *sine *= weight;
    scaled rho;
    scaled_make(&rho, get_value(at, ARRAY_RHO, v), get_value(at, ARRAY_RHO_REST, v));
    scaled_power(power, &rho, m);
}

/* Any other from the one before it. */
INLINE void begin_next(const chunk *at, const size_t v, realv *cosine, realv *sine, scaled *power) {
    const realv c = get_value(at, ARRAY_COSINE, v);
    const realv s = get_value(at, ARRAY_SINE, v);
    const realv old_cosine = load_local(at->memory + LOCAL_COSINE, v);
    const realv old_sine = load_local(at->memory + LOCAL_SINE, v);
    *cosine = fma(old_cosine, c, -(old_sine * s));
    *sine = fma(old_cosine, s, old_sine * c);
    power->high = load_local(at->memory + LOCAL_HIGH, v);
    power->scale = load_scale(at->scales, v);
    scaled_step(power, get_value(at, ARRAY_RHO, v), get_value(at, ARRAY_RHO_REST, v));
}

INLINE void begin_order(const chunk *at, const size_t v, const uint m, const int exactly) {
    realv cosine, sine;
    scaled power;
    if (exactly) {
        begin_exactly(at, v, m, &cosine, &sine, &power);
    } else {
        begin_next(at, v, &cosine, &sine, &power);
    }
    const realv side = get_value(at, ARRAY_SIDE, v);
    store_local(at->memory + LOCAL_COSINE, v, cosine);
    store_local(at->memory + LOCAL_SINE, v, sine);
    store_local(at->memory + LOCAL_SIDE_COSINE, v, cosine * side);
    store_local(at->memory + LOCAL_SIDE_SINE, v, sine * side);
    store_local(at->memory + LOCAL_HIGH, v, power.high);
    store_scale(at->scales, v, power.scale);

    /* A number of scale -1 is not too small for scale 0; a pole has nothing to scale. */
    const swordv is_near = power.scale == (swordv)-1 ? (swordv)1 : (swordv)0;
    const realv p = is_near == (swordv)1 ? power.high * (realv)SCALED_DOWN : power.high;
    swordv scale = power.scale + is_near;
    scale = AS_SWORDV(p) == (swordv)0 ? (swordv)0 : scale;
    store_local(at->memory + LOCAL_P, v, p);
    store_local(at->memory + LOCAL_E, v, (realv)0);
    store_scale(at->scales + CHUNK, v, scale);
    at->is_scaled[v] = any_negative(scale);
}

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
    const swordv rises = fabs(p) >= (realv)SCALED_HIGH ? (swordv)1 : (swordv)0;
    const swordv up = scale < (swordv)0 ? rises : (swordv)0;
    const realv down = up == (swordv)1 ? (realv)SCALED_DOWN : (realv)1;
    scale += up;
    store_local(at->memory + LOCAL_P, v, p * down);
    store_local(at->memory + LOCAL_E, v, e * down);
    store_scale(at->scales + CHUNK, v, scale);
    at->is_scaled[v] = any_negative(scale);
}

/* The sums of a block over the points of a chunk: SUMS numbers. */
INLINE void add_block(const chunk *at, TABLE *block, const int first, const int step,
                      real *totals) {
    realv sums[SUMS] = {(realv)0};
    for (size_t v = 0; v < at->num_vectors; v++) {
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

/* Rows of one order of one realization: re, im and their low parts. */
INLINE void put_block(__global real *row, const ulong stride, TABLE *block, const real *totals,
                      const int has_low, const int is_first) {
    for (int part = 0; part < 2; part++) {
        __global real *to = row + part * stride;
        for (int i = 0; i < DEGREES; i++) {
            real low = 0, high = totals[part * DEGREES + i] * block[BLOCK_RATIO + i];
            if (has_low && !is_first) {
                const real old = to[i];
                const real sum = old + high;
                const real part_of_sum = sum - old;
                low = to[2 * stride + i] + ((old - (sum - part_of_sum)) + (high - part_of_sum));
                high = sum;
            }
            to[i] = high;
            if (has_low) {
                to[2 * stride + i] = low;
            }
        }
    }
}

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
        put_block(row + l, stride, block, totals, has_low, is_first);
        block += BLOCK_REALS;
    }
}

__kernel __attribute__((reqd_work_group_size(1, 1, 1))) void
sphere_sums(__global const real *restrict values, __global const ulong *restrict turns,
            __global const real *restrict weights, __global const ulong *restrict offsets,
            __global const real *restrict table, __global const uint *restrict first_blocks,
            __global real *restrict sums, const uint first_order, const uint num_orders,
            const uint max_degree, const ulong stride, const ulong capacity, const uint has_low,
            const uint is_first) {
    __local real memory[LOCAL_REALS];
    __local SWORD scales[2 * CHUNK];
    __local uint is_scaled[VECTORS];
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
        at.capacity = capacity;
        at.num_vectors = min(end - from, (ulong)VECTORS);
        const int begins = is_first && from == begin;
        for (uint order = first; order < last; order++) {
            const uint m = first_order + order;
            __global real *row = sums + (realization * num_orders + order) * 4 * stride;
            for (size_t v = 0; v < at.num_vectors; v++) {
                begin_order(&at, v, m, order == first);
            }
            if (begins) {
                clear_below(row, stride, m, has_low);
            }
            add_order(&at, table + (ulong)first_blocks[order] * BLOCK_REALS, row, stride, m,
                      max_degree, has_low, begins);
        }
    }
}
