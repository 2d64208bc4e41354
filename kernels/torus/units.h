/* Products of cosines and sines by the matrix units of a GPU, in PTX, or the same numbers in plain
 * OpenCL C. Device only; LANES is 4.
 *
 *   UNITS  UNITS_PTX: mma.sync of NVIDIA's compute capability 8.0 and above. UNITS_EMULATED: the
 *          same sums by a model of them, for tests where there are none
 *
 * A unit tile is 8 left frequencies (rows: 8 cosines, 8 sines) times 4 right ones (columns: cosine,
 * sine, ..): each of 32 work-items, a warp, has the four sums (cc, cs, sc, ss) of one pair of
 * frequencies, left number lane / 4 and right number lane % 4. Factors of a step of STEP_POINTS
 * points are in local memory in the order in which lanes take them, words of WORD_POINTS points:
 *
 *   left   single [hi, lo][lane][cos, sin of points < 8; of the others], double [lane][cos, sin]
 *   right  single [lane][hi of points < 8, of the others; lo likewise], double [lane]
 *
 * Single precision: a factor is hi + lo / LOW_SCALE, both of fp16, the nearest; lo is scaled so
 * that small weights keep their digits above the least fp16. A step adds hi lo + lo hi and hi hi,
 * each from zero, and lo lo is left out; what comes out is added as floats, rounded to nearest, for
 * units cut. Double precision: fused operations, rounded to nearest, point after point.
 *
 * The model of a unit: products are exact; they and the sum so far are cut towards zero at 2^-23 of
 * the largest power of two below any of them, then added exactly and cut to 24 bits. Real units
 * keep digits below, or add 8 products and then 8 more.
 */
#ifndef PS_TORUS_UNITS_H
#define PS_TORUS_UNITS_H

#include "shared/real.h"

#ifdef __OPENCL_C_VERSION__

#define UNITS_EMULATED 1
#define UNITS_PTX 2
#ifndef UNITS
#define UNITS UNITS_EMULATED
#endif

#define WARP 32
#define UNIT_LEFT 8 /* frequencies of a unit tile */
#define UNIT_RIGHT 4
typedef PS_JOIN(REAL, 4) unit_sums; /* cc, cs, sc, ss */

#if PRECISION == 32

#define STEP_POINTS 16
#define WORD_POINTS 2
#define LEFT_WORDS (2 * WARP * 4) /* of a unit tile and a step */
#define RIGHT_WORDS (WARP * 4)
#define LOW_SCALE 2048.0f
typedef uint unit_word;

#if UNITS == UNITS_PTX

/* Two numbers as fp16, the first in the lower half of a word. */
static inline uint to_halves(const float a, const float b) {
    uint both;
    __asm("cvt.rn.f16x2.f32 %0, %1, %2;" : "=r"(both) : "f"(b), "f"(a));
    return both;
}

static inline float2 from_halves(const uint both) {
    float a, b;
    __asm("{.reg .b16 l, h; mov.b32 {l, h}, %2; cvt.f32.f16 %0, l; cvt.f32.f16 %1, h;}"
          : "=f"(a), "=f"(b)
          : "r"(both));
    return (float2)(a, b);
}

/* *sum += left right */
static inline void add_step(float4 *sum, const uint4 left, const uint right, const uint others) {
    __asm("mma.sync.aligned.m16n8k16.row.col.f32.f16.f16.f32 {%0,%1,%2,%3}, {%4,%5,%6,%7}, "
          "{%8,%9}, {%0,%1,%2,%3};"
          : "+f"(sum->x), "+f"(sum->y), "+f"(sum->z), "+f"(sum->w)
          : "r"(left.x), "r"(left.y), "r"(left.z), "r"(left.w), "r"(right), "r"(others));
}

static inline void add_unit_tile(unit_sums *sum, __local const uint *left,
                                 __local const uint *right, const uint lane) {
    const uint4 hi = *(__local const uint4 *)(left + lane * 4);
    const uint4 lo = *(__local const uint4 *)(left + LEFT_WORDS / 2 + lane * 4);
    const uint4 of_right = *(__local const uint4 *)(right + lane * 4);
    float4 low = (float4)0, high = (float4)0;
    add_step(&low, lo, of_right.x, of_right.y);
    add_step(&low, hi, of_right.z, of_right.w);
    add_step(&high, hi, of_right.x, of_right.y);
    *sum += fma(low, (float4)(1 / LOW_SCALE), high);
}

#else

/* Nearest, ties to even; from 2^-14 down in steps of 2^-24. */
static inline uint to_half(const float x) {
    const uint bits = as_uint(x), size = bits & 0x7fffffff;
    const uint small = convert_uint_rte(fabs(x) * 16777216.0f);
    const uint normal = (size + 0xfff + (size >> 13 & 1) - (112u << 23)) >> 13;
    return (bits >> 16 & 0x8000) | (size < 0x38800000 ? small : normal);
}

static inline float from_half(const uint half_bits) {
    const uint exponent = half_bits >> 10 & 31, digits = half_bits & 1023;
    const float size = exponent == 0 ? digits * 5.9604644775390625e-8f
                                     : as_float((exponent + 112) << 23 | digits << 13);
    return half_bits & 0x8000 ? -size : size;
}

static inline uint to_halves(const float a, const float b) {
    return to_half(a) | to_half(b) << 16;
}

static inline float2 from_halves(const uint both) {
    return (float2)(from_half(both & 0xffff), from_half(both >> 16));
}

/* A product of point j of the step. left: first word of a row of the tile; right: of a column. */
static inline float product_of(__local const uint *left, __local const uint *right, const uint j) {
    const float2 a = from_halves(left[j % 8 / 2 * 4 + j / 8 * 2]);
    const float2 b = from_halves(right[j % 8 / 2 * 4 + j / 8]);
    return j % 2 == 0 ? a.x * b.x : a.y * b.y;
}

static inline float cut_sum(const float sum, __local const uint *left, __local const uint *right) {
    float most = fabs(sum);
    int total;
    for (uint j = 0; j < STEP_POINTS; j++) {
        most = fmax(most, fabs(product_of(left, right, j)));
    }
    const int exponent = (int)(as_uint(most) >> 23) - 127;
    if (most == 0) {
        return 0;
    }
    const float scale = as_float((uint)(127 + 23 - exponent) << 23);
    total = convert_int_rtz(sum * scale);
    for (uint j = 0; j < STEP_POINTS; j++) {
        total += convert_int_rtz(product_of(left, right, j) * scale);
    }
    uint size = abs(total);
    const uint excess = size >= 1u << 24 ? 8 - clz(size) : 0; /* bits beyond 24 */
    size = size >> excess << excess;
    return (total < 0 ? -(float)size : (float)size) / scale;
}

static inline void add_unit_tile(unit_sums *sum, __local const uint *left,
                                 __local const uint *right, const uint lane) {
    float added[4];
    for (uint i = 0; i < 4; i++) { /* row: cosine, sine; column: cosine, sine */
        __local const uint *hi = left + lane / 4 * 16 + i / 2, *lo = hi + LEFT_WORDS / 2;
        __local const uint *of_right = right + (lane % 4 * 2 + i % 2) * 16;
        const float low = cut_sum(cut_sum(0, lo, of_right), hi, of_right + 2);
        added[i] = fma(low, 1 / LOW_SCALE, cut_sum(0, hi, of_right));
    }
    *sum += (float4)(added[0], added[1], added[2], added[3]);
}

#endif

/* x.x and x.y: of the points j and j + 1 of the step. */
static inline uint2 split(const float2 x) {
    const uint hi = to_halves(x.x, x.y);
    const float2 rest = (x - from_halves(hi)) * LOW_SCALE;
    return (uint2)(hi, to_halves(rest.x, rest.y));
}

static inline void put_left(__local uint *tile, const uint frequency, const uint j,
                            const float2 cosine, const float2 sine) {
    __local uint *const to = tile + (frequency * 4 + j % 8 / 2) * 4 + j / 8 * 2;
    const uint2 c = split(cosine), s = split(sine);
    to[0] = c.x;
    to[1] = s.x;
    to[LEFT_WORDS / 2] = c.y;
    to[LEFT_WORDS / 2 + 1] = s.y;
}

static inline void put_right(__local uint *tile, const uint frequency, const uint j,
                             const float2 cosine, const float2 sine) {
    __local uint *const to = tile + (frequency * 8 + j % 8 / 2) * 4 + j / 8;
    const uint2 c = split(cosine), s = split(sine);
    to[0] = c.x;
    to[2] = c.y;
    to[16] = s.x;
    to[18] = s.y;
}

#else

#define STEP_POINTS 4
#define WORD_POINTS 1
#define LEFT_WORDS (WARP * 2)
#define RIGHT_WORDS WARP
typedef double unit_word;

static inline void add_unit_tile(unit_sums *sum, __local const double *left,
                                 __local const double *right, const uint lane) {
#if UNITS == UNITS_PTX
    const double2 of_left = *(__local const double2 *)(left + lane * 2);
    const double of_right = right[lane];
    __asm("mma.sync.aligned.m8n8k4.row.col.f64.f64.f64.f64 {%0,%1}, {%2}, {%3}, {%0,%1};"
          : "+d"(sum->x), "+d"(sum->y)
          : "d"(of_left.x), "d"(of_right));
    __asm("mma.sync.aligned.m8n8k4.row.col.f64.f64.f64.f64 {%0,%1}, {%2}, {%3}, {%0,%1};"
          : "+d"(sum->z), "+d"(sum->w)
          : "d"(of_left.y), "d"(of_right));
#else
    for (uint j = 0; j < STEP_POINTS; j++) {
        const double cosine = left[(lane / 4 * 4 + j) * 2], sine = left[(lane / 4 * 4 + j) * 2 + 1];
        const double of_cosine = right[lane % 4 * 8 + j], of_sine = right[lane % 4 * 8 + 4 + j];
        *sum = fma((double4)(cosine, cosine, sine, sine),
                   (double4)(of_cosine, of_sine, of_cosine, of_sine), *sum);
    }
#endif
}

static inline void put_left(__local double *tile, const uint frequency, const uint j,
                            const double cosine, const double sine) {
    tile[(frequency * 4 + j) * 2] = cosine;
    tile[(frequency * 4 + j) * 2 + 1] = sine;
}

static inline void put_right(__local double *tile, const uint frequency, const uint j,
                             const double cosine, const double sine) {
    tile[frequency * 8 + j] = cosine;
    tile[frequency * 8 + 4 + j] = sine;
}

#endif

#endif

#endif
