/* How an order begins in sphere/sums.cl: w exp(i m phi) and sin^m(theta) of the points of a chunk.
 * Nothing of it in C11.
 */
#ifndef PS_SPHERE_ORDER_H
#define PS_SPHERE_ORDER_H

#include "shared/lanes.h"
#include "shared/turn.h"
#include "sphere/lane_sums.h"
#include "sphere/layout.h"
#include "sphere/legendre.h"
#include "sphere/scaled.h"

#ifdef __OPENCL_C_VERSION__

/* Local memory of a work-group: what the points of a chunk carry from degree to degree and from
 * order to order. */
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

/* The pointers of a work-group, whose items have the vectors that are their number modulo JOBS. */
typedef struct chunk {
    __global const real *values;
    __global const ulong *turns;
    __global const real *weights;
    __local real *memory;
    __local SWORD *scales; /* [2][CHUNK]: of sin^m(theta), of the state */
    __local uint *is_scaled;
    __local real *of_items, *of_parts; /* of put_block, with several items */
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
    const realv p = power.scale == (swordv)-1 ? power.high * (realv)SCALED_DOWN : power.high;
    swordv scale = power.scale == (swordv)-1 ? (swordv)0 : power.scale;
    scale = AS_SWORDV(p) == (swordv)0 ? (swordv)0 : scale;
    store_local(at->memory + LOCAL_P, v, p);
    store_local(at->memory + LOCAL_E, v, (realv)0);
    store_scale(at->scales + CHUNK, v, scale);
    at->is_scaled[v] = any_negative(scale);
}

#endif

#endif
