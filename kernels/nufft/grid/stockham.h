/* One transform of length N by the work-items of a group, LINES of them at a time: Stockham's
 * passes of radix RADIX_0 .. RADIX_3, whose product is N. Numbers stay in registers; between
 * two passes they go through local memory, first the real parts and then the imaginary ones, so
 * that a number takes the room of a real. The radices and the number of work-items, ITEMS, are
 * compiled in, so that registers have constant indices. Results do not depend on LINES and
 * ITEMS. Device only.
 *
 * Job b of a pass is one butterfly; work-item i has jobs i, i + ITEMS, ...
 */
#ifndef PS_NUFFT_GRID_STOCKHAM_H
#define PS_NUFFT_GRID_STOCKHAM_H

#include "nufft/transform/squares.h"

#ifndef RADIX_0
#define RADIX_0 16
#endif
#ifndef RADIX_1
#define RADIX_1 1
#endif
#ifndef RADIX_2
#define RADIX_2 1
#endif
#ifndef RADIX_3
#define RADIX_3 1
#endif
#define N (RADIX_0 * RADIX_1 * RADIX_2 * RADIX_3)
#ifndef LINES
#define LINES 1
#endif
#ifndef ITEMS
#define ITEMS 16
#endif
/* Lines are next to each other in memory, else numbers of a line are. */
#ifndef IS_ACROSS
#define IS_ACROSS 0
#endif

/* Room of a line: a number more after sixteen, and lines eight banks apart. */
#define LINE_PLACE(i) ((i) + (i) / 16)
#define LINE_REALS ((N + N / 16) / 32 * 32 + 40)

#define JOBS(radix) (N / (radix)*LINES)
#define ROUNDS(radix) ((JOBS(radix) + ITEMS - 1) / ITEMS)
#define HELD(radix) (ROUNDS(radix) * (radix))
#define LARGER(a, b) ((a) > (b) ? (a) : (b))
#define MOST_HELD LARGER(LARGER(HELD(RADIX_0), HELD(RADIX_1)), LARGER(HELD(RADIX_2), HELD(RADIX_3)))

typedef struct held {
    real re[MOST_HELD], im[MOST_HELD];
} held;

/* The line of a job, and which of its butterflies it is. */
static inline uint line_of_job(const uint job, const int radix) {
    return IS_ACROSS ? job % LINES : job / (N / radix);
}

static inline uint place_of_job(const uint job, const int radix) {
    return IS_ACROSS ? job / LINES : job % (N / radix);
}

/* Result i of butterfly t behind passes whose radices make `before`. */
static inline uint result_of(const uint t, const int i, const int radix, const int before) {
    return t / before * (before * radix) + t % before + i * before;
}

/* The functions of pass P: its radix is a constant in them, so that compilers unroll their loops.
 *
 * work  butterflies; roots: [N][cosine, sine] of -2 pi i / N
 * put   one part of all results into local memory
 * take  one part of what the butterflies begin with from there */
#define PASS(P, RADIX, BEFORE)                                                                     \
    static inline void work_##P(held *x, __global const real *roots) {                             \
        _Pragma("unroll") for (int round = 0; round < ROUNDS(RADIX); round++) {                    \
            const uint job = get_local_id(0) + round * ITEMS;                                      \
            const uint step = place_of_job(job, RADIX) % (BEFORE) * (N / ((BEFORE)*RADIX));        \
            complexv values[RADIX];                                                                \
            if (job < JOBS(RADIX)) {                                                               \
                _Pragma("unroll") for (int i = 0; i < RADIX; i++) {                                \
                    values[i] = (complexv){x->re[round * RADIX + i], x->im[round * RADIX + i]};    \
                    if ((BEFORE) > 1 && i > 0) {                                                   \
                        __global const real *const root = roots + 2 * (size_t)(i * step);          \
                        values[i] = complex_multiply(values[i], root[0], root[1]);                 \
                    }                                                                              \
                }                                                                                  \
                PS_JOIN(butterfly_, RADIX)(values);                                                \
                _Pragma("unroll") for (int i = 0; i < RADIX; i++) {                                \
                    x->re[round * RADIX + i] = values[i].re;                                       \
                    x->im[round * RADIX + i] = values[i].im;                                       \
                }                                                                                  \
            }                                                                                      \
        }                                                                                          \
    }                                                                                              \
    static inline void put_##P(const real *part, __local real *lines) {                            \
        _Pragma("unroll") for (int round = 0; round < ROUNDS(RADIX); round++) {                    \
            const uint job = get_local_id(0) + round * ITEMS, t = place_of_job(job, RADIX);        \
            __local real *const line = lines + line_of_job(job, RADIX) * LINE_REALS;               \
            if (job < JOBS(RADIX)) {                                                               \
                _Pragma("unroll") for (int i = 0; i < RADIX; i++) {                                \
                    line[LINE_PLACE(result_of(t, i, RADIX, BEFORE))] = part[round * RADIX + i];    \
                }                                                                                  \
            }                                                                                      \
        }                                                                                          \
        barrier(CLK_LOCAL_MEM_FENCE);                                                              \
    }                                                                                              \
    static inline void take_##P(real *part, __local const real *lines) {                           \
        _Pragma("unroll") for (int round = 0; round < ROUNDS(RADIX); round++) {                    \
            const uint job = get_local_id(0) + round * ITEMS, t = place_of_job(job, RADIX);        \
            __local const real *const line = lines + line_of_job(job, RADIX) * LINE_REALS;         \
            if (job < JOBS(RADIX)) {                                                               \
                _Pragma("unroll") for (int i = 0; i < RADIX; i++) {                                \
                    part[round * RADIX + i] = line[LINE_PLACE(t + i * (N / RADIX))];               \
                }                                                                                  \
            }                                                                                      \
        }                                                                                          \
        barrier(CLK_LOCAL_MEM_FENCE);                                                              \
    }

PASS(0, RADIX_0, 1)
#if RADIX_1 > 1
PASS(1, RADIX_1, RADIX_0)
#endif
#if RADIX_2 > 1
PASS(2, RADIX_2, RADIX_0 *RADIX_1)
#endif
#if RADIX_3 > 1
PASS(3, RADIX_3, RADIX_0 *RADIX_1 *RADIX_2)
#endif

/* All numbers, from the work-items of a pass to those of the next, and its butterflies. */
#define NEXT_PASS(P, NEXT)                                                                         \
    put_##P(x->re, lines);                                                                         \
    take_##NEXT(x->re, lines);                                                                     \
    put_##P(x->im, lines);                                                                         \
    take_##NEXT(x->im, lines);                                                                     \
    work_##NEXT(x, roots);

/* The radix of the last pass, and the product of those before. */
#define LAST_RADIX (RADIX_3 > 1 ? RADIX_3 : RADIX_2 > 1 ? RADIX_2 : RADIX_1 > 1 ? RADIX_1 : RADIX_0)
#define BEFORE_LAST (N / LAST_RADIX)

/* x: number t + i N / RADIX_0 of a line in front, result result_of(t, i, LAST_RADIX, BEFORE_LAST)
 * behind */
static inline void transform_lines(held *x, __local real *lines, __global const real *roots) {
    work_0(x, roots);
    (void)lines;
#if RADIX_1 > 1
    NEXT_PASS(0, 1)
#endif
#if RADIX_2 > 1
    NEXT_PASS(1, 2)
#endif
#if RADIX_3 > 1
    NEXT_PASS(2, 3)
#endif
}

#endif
