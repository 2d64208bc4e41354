/* Windows of points along a row of cells: all bins of a point as one vector, made for four points
 * at a time, and added to rows of real numbers. Device only.
 */
#ifndef PS_NUFFT_ROW_WINDOWS_H
#define PS_NUFFT_ROW_WINDOWS_H

#include "nufft/window.h"

typedef PS_JOIN(REAL, 4) real4;
typedef real4 unaligned_real4 __attribute__((aligned(sizeof(real))));
typedef PS_JOIN(REAL, 16) real16;
typedef real16 unaligned_real16 __attribute__((aligned(sizeof(real))));

/* All 8 bins of four points, [4][8]: two chains, since each step waits for the one before. */
static inline void make_8_bins(const window_axis axis, __local const real *centres,
                               __local real *to) {
    const real16 u = (real16)((real8)centres[0], (real8)centres[1]);
    const real16 v = (real16)((real8)centres[2], (real8)centres[3]);
    __global const unaligned_real8 *from =
        (__global const unaligned_real8 *)axis.coefficients + axis.degree;
    real16 first = (real16)(*from, *from), second = first;
    for (uint i = 0; i < axis.degree; i++) {
        from--;
        const real16 coefficients = (real16)(*from, *from);
        first = fma(first, u, coefficients);
        second = fma(second, v, coefficients);
    }
    *(__local unaligned_real16 *)to = first;
    *(__local unaligned_real16 *)(to + 16) = second;
}

/* All 16 bins of four points: [4][16] */
static inline void make_16_bins(const window_axis axis, __local const real *centres,
                                __local real *to) {
    __global const unaligned_real16 *from =
        (__global const unaligned_real16 *)axis.coefficients + axis.degree;
    real16 of[4] = {*from, *from, *from, *from};
    for (uint i = 0; i < axis.degree; i++) {
        from--;
        const real16 coefficients = *from;
#pragma unroll
        for (uint j = 0; j < 4; j++) {
            of[j] = fma(of[j], (real16)centres[j], coefficients);
        }
    }
#pragma unroll
    for (uint j = 0; j < 4; j++) {
        *(__local unaligned_real16 *)(to + j * 16) = of[j];
    }
}

/* All bins of four points: [4][bins] */
static inline void make_row_windows(const window_axis axis, __local const real *centres,
                                    __local real *to) {
    if (axis.bins == 8) {
        make_8_bins(axis, centres, to);
    } else {
        make_16_bins(axis, centres, to);
    }
}

/* ---- adding --------------------------------------------------------------------------------- */

/* A row of 8 or 16 cells, and one of 12 by the first of 16 values: in double precision rows are
 * what spreading waits for, and a third less of windows up to 12 cells wide is worth a branch. */
#define ADD_ROW_8(SPACE, at, weight, values)                                                       \
    *(SPACE unaligned_real8 *)(at) = fma((real8)(weight), values, *(SPACE unaligned_real8 *)(at));
#define ADD_ROW_16(SPACE, at, weight, values)                                                      \
    *(SPACE unaligned_real16 *)(at) =                                                              \
        fma((real16)(weight), values, *(SPACE unaligned_real16 *)(at));
#define ADD_ROW_12(SPACE, at, weight, values)                                                      \
    ADD_ROW_8(SPACE, at, weight, (values).lo)                                                      \
    *(SPACE unaligned_real4 *)((at) + 8) =                                                         \
        fma((real4)(weight), (values).hi.lo, *(SPACE unaligned_real4 *)((at) + 8));

/* A point into num_rows rows `pitch` apart, by one work-item: values along a row are one vector,
 * weighted row by row by across. Four rows in a step: addresses and the loop are half of the
 * instructions else. */
#define ADD_ROWS(NAME, SPACE, CELLS, BINS)                                                         \
    static inline void add_##NAME##_values_##CELLS(SPACE real *at, const size_t pitch,             \
                                                   __local const real *across,                     \
                                                   const real##BINS values, const uint num_rows) { \
        uint row = 0;                                                                              \
        for (; row + 4 <= num_rows; row += 4) {                                                    \
            _Pragma("unroll") for (uint i = 0; i < 4; i++){ADD_ROW_##CELLS(                        \
                SPACE, at + i * pitch, across[(row + i) * CHUNK], values)} at += 4 * pitch;        \
        }                                                                                          \
        for (; row < num_rows; row++) {                                                            \
            ADD_ROW_##CELLS(SPACE, at, across[row * CHUNK], values) at += pitch;                   \
        }                                                                                          \
    }

/* width: of the window along rows, whose values are [8] or [16]. */
#define ADD_ANY_ROWS(NAME, SPACE)                                                                  \
    ADD_ROWS(NAME, SPACE, 8, 8)                                                                    \
    ADD_ROWS(NAME, SPACE, 12, 16)                                                                  \
    ADD_ROWS(NAME, SPACE, 16, 16)                                                                  \
    static inline void add_##NAME##_rows(SPACE real *at, const size_t pitch,                       \
                                         __local const real *across, __local const real *along,    \
                                         const uint num_rows, const uint width) {                  \
        if (width <= 8) {                                                                          \
            add_##NAME##_values_8(at, pitch, across, *(__local const unaligned_real8 *)along,      \
                                  num_rows);                                                       \
        } else if (PRECISION == 64 && width <= 12) {                                               \
            add_##NAME##_values_12(at, pitch, across, *(__local const unaligned_real16 *)along,    \
                                   num_rows);                                                      \
        } else {                                                                                   \
            add_##NAME##_values_16(at, pitch, across, *(__local const unaligned_real16 *)along,    \
                                   num_rows);                                                      \
        }                                                                                          \
    }

ADD_ANY_ROWS(global, __global)
ADD_ANY_ROWS(local, __local)

#endif
