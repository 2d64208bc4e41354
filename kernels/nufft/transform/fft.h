/* Fourier transforms of any length that has no prime factor above 7, LANES of them side by side, in
 * place, by one work-group: passes of radix 8, 7, 5, 4, 3, 2, decimated in frequency.
 *
 * A buffer is [cell][re, im][LANES]. The work-items of a group share the butterflies of a pass; on
 * CPUs a group has one work-item. The plan of a length is data, so one program serves all lengths:
 *
 *   radices   of the passes, ended by 0
 *   twiddles  [pass][t][j][cosine, sine] of -2 pi t j / length, j = 1 .. radix - 1, for the transforms
 *             of that pass: of the whole length first, then of a radix-th part, ...
 *
 * The result of frequency k stands in cell position[k] (host/engines/nufft/fft.c): putting it in
 * order would be a pass of its own. Nothing depends on what stands in other lanes.
 *
 * Buffers are in local memory, or in global memory where FFT_IN_GLOBAL is defined before: one
 * program has one kind, since a second copy of all passes takes the compiler seconds.
 */
#ifndef PS_NUFFT_TRANSFORM_FFT_H
#define PS_NUFFT_TRANSFORM_FFT_H

#include "nufft/transform/butterfly.h"
#include "shared/group.h"

#ifdef FFT_IN_GLOBAL
#define FFT_SPACE __global
#define FFT_FENCE CLK_GLOBAL_MEM_FENCE
#define FFT_LOAD load_global
#define FFT_STORE store_global
#else
#define FFT_SPACE __local
#define FFT_FENCE CLK_LOCAL_MEM_FENCE
#define FFT_LOAD load_local
#define FFT_STORE store_local
#endif

static inline complexv load_complex(FFT_SPACE const real *from, const size_t cell) {
    return (complexv){FFT_LOAD(from, 2 * cell), FFT_LOAD(from, 2 * cell + 1)};
}

static inline complexv load_global_complex(__global const real *from, const size_t cell) {
    return (complexv){load_global(from, 2 * cell), load_global(from, 2 * cell + 1)};
}

static inline void store_complex(FFT_SPACE real *to, const size_t cell, const complexv x) {
    FFT_STORE(to, 2 * cell, x.re);
    FFT_STORE(to, 2 * cell + 1, x.im);
}

static inline void store_global_complex(__global real *to, const size_t cell, const complexv x) {
    store_global(to, 2 * cell, x.re);
    store_global(to, 2 * cell + 1, x.im);
}

/* One pass: transforms of length RADIX m, one behind the other, into RADIX transforms of length m
 * each. Cells are `apart` numbers from each other. The last pass, m = 1, has no factors but 1.
 * Pointers and strides are kept instead of indices: integer work would cost as much as the
 * butterflies. */
#define FFT_PASS(RADIX)                                                                            \
    static inline void fft_pass_##RADIX(FFT_SPACE real *data, const size_t apart,                  \
                                        __global const real *twiddles, const size_t m,             \
                                        const size_t length) {                                     \
        FFT_SPACE real *const end = data + length * apart;                                         \
        const size_t stride = m * apart;                                                           \
        size_t t = own_item();                                                                     \
        for (;;) {                                                                                 \
            while (t >= m && data < end) {                                                         \
                t -= m;                                                                            \
                data += RADIX * stride;                                                            \
            }                                                                                      \
            if (data >= end) {                                                                     \
                break;                                                                             \
            }                                                                                      \
            complexv x[RADIX];                                                                     \
            FFT_SPACE real *at = data + t * apart;                                                 \
            __global const real *factor = twiddles + t * (2 * (RADIX - 1));                        \
            _Pragma("unroll") for (int j = 0; j < RADIX; j++) {                                    \
                x[j] = load_complex(at + j * stride, 0);                                           \
            }                                                                                      \
            butterfly_##RADIX(x);                                                                  \
            if (m > 1) {                                                                           \
                _Pragma("unroll") for (int j = 1; j < RADIX; j++) {                                \
                    x[j] = complex_multiply(x[j], factor[2 * j - 2], factor[2 * j - 1]);           \
                }                                                                                  \
            }                                                                                      \
            _Pragma("unroll") for (int j = 0; j < RADIX; j++) {                                    \
                store_complex(at + j * stride, 0, x[j]);                                           \
            }                                                                                      \
            t += num_items();                                                                      \
        }                                                                                          \
    }

FFT_PASS(2)
FFT_PASS(3)
FFT_PASS(4)
FFT_PASS(5)
FFT_PASS(7)
FFT_PASS(8)

#define FFT_CASE(RADIX)                                                                            \
    case RADIX:                                                                                    \
        fft_pass_##RADIX(data, apart, twiddles, m, length);                                        \
        break

/* All work-items call it, and see the result when it returns. */
static inline void fft_transform(FFT_SPACE real *data, const size_t apart, const uint length,
                                 __global const uint *radices, __global const real *twiddles) {
    size_t m = length;
    for (uint pass = 0; radices[pass] != 0; pass++) {
        const uint radix = radices[pass];
        m /= radix;
        switch (radix) {
            FFT_CASE(2);
            FFT_CASE(3);
            FFT_CASE(4);
            FFT_CASE(5);
            FFT_CASE(7);
            FFT_CASE(8);
        }
        twiddles += 2 * m * (radix - 1);
        GROUP_BARRIER(FFT_FENCE);
    }
}

#endif
