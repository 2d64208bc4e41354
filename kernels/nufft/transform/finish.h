/* From rows of cells to powers: the mean is taken off, the row transformed, results left where they
 * belong. Device only.
 */
#ifndef PS_NUFFT_TRANSFORM_FINISH_H
#define PS_NUFFT_TRANSFORM_FINISH_H

#include "nufft/transform/fft.h"

/* A transform and what it is for. Frequencies q = -K .. K of its n are kept. */
typedef struct transform_axis {
    __global const uint *radices;
    __global const real *twiddles;
    __global const uint *position;
    __global const real *gains; /* [K + 1]: 1 / squared transform of the window at |q| */
    uint n, K;
} transform_axis;

/* Row `index` of rows [n][re, im][LANES]. */
static inline void load_row(FFT_SPACE real *row, __global const real *rows, const size_t index,
                            const uint n) {
    for (uint i = get_local_id(0); i < n; i += get_local_size(0)) {
        store_complex(row, i, load_global_complex(rows, index * n + i));
    }
    barrier(FFT_FENCE);
}

/* Frequency 0, in lane 0 of tile 0, is known: mean times pattern[cell][cosine, sine] is what it
 * leaves in the cells. */
static inline void take_off_mean(FFT_SPACE real *row, const real mean, __global const real *pattern,
                                 const uint n) {
    for (uint i = get_local_id(0); i < n; i += get_local_size(0)) {
        row[i * 2 * LANES] -= mean * pattern[2 * i];
        row[(i * 2 + 1) * LANES] -= mean * pattern[2 * i + 1];
    }
    barrier(FFT_FENCE);
}

/* Returns the sum at kept frequency i, q = i - K. */
static inline complexv kept_frequency(FFT_SPACE const real *row, const transform_axis axis,
                                      const uint i) {
    return load_complex(row, axis.position[i >= axis.K ? i - axis.K : axis.n + i - axis.K]);
}

/* power: [2K + 1][LANES] */
static inline void write_powers(FFT_SPACE real *row, const transform_axis axis, const real scale,
                                __global real *power) {
    fft_transform(row, 2 * LANES, axis.n, axis.radices, axis.twiddles);
    for (uint i = get_local_id(0); i < 2 * axis.K + 1; i += get_local_size(0)) {
        const complexv z = kept_frequency(row, axis, i);
        const real gain = axis.gains[i >= axis.K ? i - axis.K : axis.K - i] * scale;
        store_global(power, i, fma(z.re, z.re, z.im * z.im) * (realv)gain);
    }
}

/* columns: frequency -K of this row; the next frequency is num_rows rows further. */
static inline void write_columns(FFT_SPACE real *row, const transform_axis axis,
                                 const uint num_rows, __global real *columns) {
    fft_transform(row, 2 * LANES, axis.n, axis.radices, axis.twiddles);
    for (uint i = get_local_id(0); i < 2 * axis.K + 1; i += get_local_size(0)) {
        store_global_complex(columns, (size_t)i * num_rows, kept_frequency(row, axis, i));
    }
}

#endif
