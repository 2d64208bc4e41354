/* Vectors of moments of LANES pairs, each added to the row of its bin.
 *
 * The transposition from vectors of pairs to rows of moments is written for registers of 128 bits
 * side by side: shuffles within them are one instruction on any CPU, and the parts are put together
 * once. Rows go from registers to the sums: no local memory in between.
 */
#ifndef PS_PAIRS_ROWS_H
#define PS_PAIRS_ROWS_H

#include "shared/real.h"
#include "pairs/layout.h"

#define MOMENTS 8

#ifdef __OPENCL_C_VERSION__

typedef PS_JOIN(REAL, 8) moments; /* MOMENTS */
typedef moments unaligned_moments __attribute__((aligned(sizeof(real))));
typedef PS_VECTOR(int) intv;
#define TO_INTV(x) PS_JOIN(convert_, PS_VECTOR(int))(x)

PAIRS_INLINE void add_row(__global real *sums, const int row, const moments numbers) {
    *(__global unaligned_moments *)(sums + row) += numbers;
}

#if LANES == 1
PAIRS_INLINE void add_rows(const realv *a, __local const int *rows, __global real *sums) {
    add_row(sums, rows[0], (moments)(a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7]));
}
#else

/* Parts of 128 bits, q of them: two or four moments of a pair each. */
#if PRECISION == 64 && LANES == 4
#define EVEN_ONES(a, b) ((realv)((a).s0, (b).s0, (a).s2, (b).s2))
#define ODD_ONES(a, b) ((realv)((a).s1, (b).s1, (a).s3, (b).s3))
#elif PRECISION == 64 && LANES == 8
#define EVEN_ONES(a, b) ((realv)((a).s0, (b).s0, (a).s2, (b).s2, (a).s4, (b).s4, (a).s6, (b).s6))
#define ODD_ONES(a, b) ((realv)((a).s1, (b).s1, (a).s3, (b).s3, (a).s5, (b).s5, (a).s7, (b).s7))
#elif PRECISION == 32 && LANES == 8
#define LOW_ONES(a, b) ((realv)((a).s0, (b).s0, (a).s1, (b).s1, (a).s4, (b).s4, (a).s5, (b).s5))
#define HIGH_ONES(a, b) ((realv)((a).s2, (b).s2, (a).s3, (b).s3, (a).s6, (b).s6, (a).s7, (b).s7))
#define LOW_TWOS(a, b) ((realv)((a).s01, (b).s01, (a).s45, (b).s45))
#define HIGH_TWOS(a, b) ((realv)((a).s23, (b).s23, (a).s67, (b).s67))
#elif PRECISION == 32 && LANES == 16
#define LOW_ONES(a, b)                                                                             \
    ((realv)((a).s0, (b).s0, (a).s1, (b).s1, (a).s4, (b).s4, (a).s5, (b).s5, (a).s8, (b).s8,       \
             (a).s9, (b).s9, (a).sc, (b).sc, (a).sd, (b).sd))
#define HIGH_ONES(a, b)                                                                            \
    ((realv)((a).s2, (b).s2, (a).s3, (b).s3, (a).s6, (b).s6, (a).s7, (b).s7, (a).sa, (b).sa,       \
             (a).sb, (b).sb, (a).se, (b).se, (a).sf, (b).sf))
#define LOW_TWOS(a, b)                                                                             \
    ((realv)((a).s01, (b).s01, (a).s45, (b).s45, (a).s89, (b).s89, (a).scd, (b).scd))
#define HIGH_TWOS(a, b)                                                                            \
    ((realv)((a).s23, (b).s23, (a).s67, (b).s67, (a).sab, (b).sab, (a).sef, (b).sef))
#endif

#if defined(EVEN_ONES)
#define ADD_TWO(even, odd, two)                                                                    \
    add_row(sums, rows[0x##even], (moments)(e[0].s##two, e[1].s##two, e[2].s##two, e[3].s##two));  \
    add_row(sums, rows[0x##odd], (moments)(o[0].s##two, o[1].s##two, o[2].s##two, o[3].s##two));

PAIRS_INLINE void add_rows(const realv *a, __local const int *rows, __global real *sums) {
    const realv e[] = {EVEN_ONES(a[0], a[1]), EVEN_ONES(a[2], a[3]), EVEN_ONES(a[4], a[5]),
                       EVEN_ONES(a[6], a[7])};
    const realv o[] = {ODD_ONES(a[0], a[1]), ODD_ONES(a[2], a[3]), ODD_ONES(a[4], a[5]),
                       ODD_ONES(a[6], a[7])};
    ADD_TWO(0, 1, 01)
    ADD_TWO(2, 3, 23)
#if LANES == 8
    ADD_TWO(4, 5, 45)
    ADD_TWO(6, 7, 67)
#endif
}
#elif defined(LOW_ONES)
#define ADD_FOUR(i, j, k, l, four)                                                                 \
    add_row(sums, rows[0x##i], (moments)(p[0].four, p[4].four));                                   \
    add_row(sums, rows[0x##j], (moments)(p[1].four, p[5].four));                                   \
    add_row(sums, rows[0x##k], (moments)(p[2].four, p[6].four));                                   \
    add_row(sums, rows[0x##l], (moments)(p[3].four, p[7].four));

/* Moments a[0] .. a[3] of pairs 0 .. 3 of every part. */
PAIRS_INLINE void turn_four(const realv *a, realv *p) {
    const realv low[] = {LOW_ONES(a[0], a[1]), LOW_ONES(a[2], a[3])};
    const realv high[] = {HIGH_ONES(a[0], a[1]), HIGH_ONES(a[2], a[3])};
    p[0] = LOW_TWOS(low[0], low[1]);
    p[1] = HIGH_TWOS(low[0], low[1]);
    p[2] = LOW_TWOS(high[0], high[1]);
    p[3] = HIGH_TWOS(high[0], high[1]);
}

PAIRS_INLINE void add_rows(const realv *a, __local const int *rows, __global real *sums) {
    realv p[MOMENTS];
    turn_four(a, p);
    turn_four(a + 4, p + 4);
    ADD_FOUR(0, 1, 2, 3, s0123)
    ADD_FOUR(4, 5, 6, 7, s4567)
#if LANES == 16
    ADD_FOUR(8, 9, a, b, s89ab)
    ADD_FOUR(c, d, e, f, scdef)
#endif
}
#else /* few lanes, or more than a CPU has: one number at a time */
#define ADD_ONE(lane)                                                                              \
    add_row(sums, rows[0x##lane],                                                                  \
            (moments)(a[0].s##lane, a[1].s##lane, a[2].s##lane, a[3].s##lane, a[4].s##lane,        \
                      a[5].s##lane, a[6].s##lane, a[7].s##lane));

PAIRS_INLINE void add_rows(const realv *a, __local const int *rows, __global real *sums) {
    ADD_ONE(0)
    ADD_ONE(1)
#if LANES > 2
    ADD_ONE(2)
    ADD_ONE(3)
#endif
#if LANES > 4
    ADD_ONE(4)
    ADD_ONE(5)
    ADD_ONE(6)
    ADD_ONE(7)
#endif
#if LANES > 8
    ADD_ONE(8)
    ADD_ONE(9)
    ADD_ONE(a)
    ADD_ONE(b)
    ADD_ONE(c)
    ADD_ONE(d)
    ADD_ONE(e)
    ADD_ONE(f)
#endif
}
#endif
#endif

#endif

#endif
