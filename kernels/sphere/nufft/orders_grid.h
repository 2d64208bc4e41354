/* The grid of a realization on the sphere, and what its transform around the axis leaves. Device
 * only.
 *
 * A row of the grid has the cells of one longitude: angles from the pole from `pole` cells in front
 * of the north pole to as many behind the south pole, where windows of points near the poles still
 * reach. Rows go all around.
 */
#ifndef PS_SPHERE_ORDERS_GRID_H
#define PS_SPHERE_ORDERS_GRID_H

/* Rows of high degrees are longer than local memory. */
#define FFT_IN_GLOBAL
#include "nufft/chunk.h"
#include "nufft/transform/fft.h"
#include "sphere/bands.h"
#include "shared/transpose.h"

typedef struct orders_grid {
    __global real *cells;
    uint pitch, rows; /* in memory, of all bands: windows go on behind the last row of each */
    uint origin;      /* the first cell here, as points count them */
} orders_grid;

/* ---- spreading ------------------------------------------------------------------------------ */

/* A chunk. (nufft/whole.cl says why not just as many points as there are.) */
static inline void scatter(const orders_grid grid, const chunk from, const chunk_axes axes) {
    for (uint i = 0; i < CHUNK; i++) {
        add_global_rows(grid.cells + (from.cells[i] - grid.origin), grid.pitch, from.across + i,
                        from.along + i * axes.along.bins, axes.across.width, axes.along.width);
    }
}

/* Points begin .. end - 1. */
static inline void spread_points(const orders_grid to, const chunk chunk,
                                 __global const ulong *points, __global const real *weights,
                                 const ulong begin, const ulong end, const chunk_axes axes) {
    for (ulong place = begin; place < end; place += CHUNK) {
        const uint count = (uint)min((ulong)CHUNK, end - place);
        fill_chunk(chunk, points + place * 2, weights + place, count, CHUNK, to.pitch, axes);
        scatter(to, chunk, axes);
    }
}

/* `num` cells; none: nothing is done. */
static inline void clear_cells(__global real *cells, const size_t num) {
    for (size_t i = 0; i < num / LANES; i++) {
        store_global(cells, i, (realv)0);
    }
}

/* ---- around the axis ------------------------------------------------------------------------ */

/* LANES columns of the grid, n rows in bands, as n / 2 complex numbers: even rows are real parts,
 * odd rows imaginary ones. The first rows of a band are also those behind the band before it. */
static inline void load_columns(__global real *data, const orders_grid grid,
                                const uint first_column, const uint n, const uint width,
                                const uint bands) {
    for (uint band = 0; band < bands; band++) {
        const uint before = band == 0 ? bands - 1 : band - 1;
        const uint start = start_of_band(band, n, bands);
        const uint num = start_of_band(band + 1, n, bands) - start;
        const uint behind = start_of_band(before + 1, n, bands) - start_of_band(before, n, bands);
        const size_t band_reals = (size_t)(grid.rows / bands) * grid.pitch;
        __global const real *own = grid.cells + band * band_reals + first_column;
        __global const real *other =
            grid.cells + before * band_reals + behind * (size_t)grid.pitch + first_column;
        for (uint i = 0; i < width; i++) {
            store_global(data, start + i,
                         load_global(own + i * (size_t)grid.pitch, 0) +
                             load_global(other + i * (size_t)grid.pitch, 0));
        }
        for (uint i = width; i < num; i++) {
            store_global(data, start + i, load_global(own + i * (size_t)grid.pitch, 0));
        }
    }
}

/* Order m of LANES columns. The transform Z of half the length n gives that of all rows, X(m) = S /
 * 2 + exp(-2 pi i m / n) D / 2i with S, D = Z(m) +- conj Z(n/2 - m). gains [L + 1][3] have the
 * factors of S and D (re, im), and undo the window. */
static inline __attribute__((always_inline)) void
order_of_columns(complexv *to, __global const real *data, __global const uint *position,
                 const uint middle, __global const real *gains, const uint m) {
    const complexv z = load_complex(data, position[m]);
    const complexv other = load_complex(data, position[m == 0 ? 0 : middle - m]);
    const complexv sum = {z.re + other.re, z.im - other.im};
    const complexv difference = {z.re - other.re, z.im + other.im};
    const complexv turned = complex_multiply(difference, gains[3 * m + 1], gains[3 * m + 2]);
    to->re = fma(sum.re, (realv)gains[3 * m], turned.re);
    to->im = fma(sum.im, (realv)gains[3 * m], turned.im);
}

/* Orders first_order, first_order + 2, ... of LANES columns, turned so that lanes are orders:
 * [column][re, im][LANES]. Orders above L are zeros. */
static inline __attribute__((always_inline)) void
turn_orders(__global const real *data, __global const uint *position, const uint middle,
            const uint L, __global const real *gains, const uint first_order, __global real *to) {
    realv re[LANES], im[LANES];
#pragma unroll
    for (int i = 0; i < LANES; i++) {
        const uint order = first_order + 2 * i;
        complexv x;
        order_of_columns(&x, data, position, middle, gains, min(order, L));
        re[i] = order <= L ? x.re : (realv)0;
        im[i] = order <= L ? x.im : (realv)0;
    }
    transpose(re);
    transpose(im);
#pragma unroll
    for (int i = 0; i < LANES; i++) {
        store_global_complex(to, i, (complexv){re[i], im[i]});
    }
}

#endif
