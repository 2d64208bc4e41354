/* The grid of a realization on the sphere, and what its transform around the axis leaves. Device only.
 *
 * A row of the grid has the cells of one longitude: angles from the pole from MARGIN cells in front of the north
 * pole to as many behind the south pole, where windows of points near the poles still reach. Rows go all around.
 */
#ifndef PS_SPHERE_ORDERS_GRID_H
#define PS_SPHERE_ORDERS_GRID_H

#include "nufft/chunk.h"
#include "nufft/fft.h"
#include "shared/transpose.h"

typedef struct orders_grid {
    __global real *cells;
    uint pitch, rows; /* in memory: windows go on behind the last row */
} orders_grid;

static inline void barrier_everywhere(void) {
    barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);
}

/* ---- spreading ------------------------------------------------------------------------------ */

/* A chunk by one work-item. (nufft/whole.cl says why not just as many points as there are.) */
static inline void scatter(const orders_grid grid, const chunk from, const chunk_axes axes) {
    for (uint i = 0; i < CHUNK; i++) {
        add_global_rows(grid.cells + from.cells[i], grid.pitch, from.across + i,
                        from.along + i * axes.along.bins, axes.across.width, axes.along.bins);
    }
}

/* The same by all: each has the cells of a row that are its number modulo their number. */
static inline void scatter_together(const orders_grid grid, const chunk from,
                                    const chunk_axes axes) {
    const uint size = get_local_size(0);
    for (uint i = 0; i < CHUNK; i++) {
        const uint own = (get_local_id(0) + size - from.columns[i] % size) % size;
        for (uint bin = own; bin < axes.along.bins; bin += size) {
            for (uint row = 0; row < axes.across.width; row++) {
                __global real *to = grid.cells + from.cells[i] + row * grid.pitch + bin;
                *to = fma(from.across[row * CHUNK + i], from.along[i * axes.along.bins + bin], *to);
            }
        }
    }
}

/* `num` cells; none: nothing is done. */
static inline void clear_cells(__global real *cells, const size_t num) {
    for (size_t i = get_local_id(0); i < num / LANES; i += get_local_size(0)) {
        store_global(cells, i, (realv)0);
    }
    barrier_everywhere();
}

/* Rows behind the last are the first ones again. num: cells of them, or 0. */
static inline void fold_rows(const orders_grid grid, const uint n, const uint num) {
    for (uint i = get_local_id(0); i < num; i += get_local_size(0)) {
        grid.cells[i] += grid.cells[(size_t)n * grid.pitch + i];
    }
    barrier_everywhere();
}

/* ---- around the axis ------------------------------------------------------------------------ */

/* 2 LANES columns of the grid, n rows: half of them as real, half as imaginary parts. */
static inline void load_columns(__local real *data, const orders_grid grid, const uint first_column,
                                const uint n) {
    for (uint m = get_local_id(0); m < n; m += get_local_size(0)) {
        __global const real *from = grid.cells + (size_t)m * grid.pitch + first_column;
        store_complex(data, m, (complexv){load_global(from, 0), load_global(from, 1)});
    }
}

/* Orders first_order, first_order + 2, ... of 2 LANES columns, turned so that lanes are orders: [column][re, im][LANES].
 * With Z = A + i B, A(m) = (Z(m) + conj Z(-m)) / 2 and B(m) = (Z(m) - conj Z(-m)) / 2i. gains [L + 1] have the half
 * and undo the window; orders above L are zeros. */
static inline __attribute__((always_inline)) void
turn_orders(__local const real *data, __global const uint *position, const uint n, const uint L,
            __global const real *gains, const uint first_order, __global real *to) {
    realv a_re[LANES], a_im[LANES], b_re[LANES], b_im[LANES];
#pragma unroll
    for (int i = 0; i < LANES; i++) {
        const uint order = first_order + 2 * i;
        const uint at = min(order, L);
        const complexv z = load_complex(data, position[at]);
        const complexv other = load_complex(data, position[at == 0 ? 0 : n - at]);
        const realv factor = (realv)(order <= L ? gains[at] : 0);
        a_re[i] = (z.re + other.re) * factor;
        a_im[i] = (z.im - other.im) * factor;
        b_re[i] = (z.im + other.im) * factor;
        b_im[i] = (other.re - z.re) * factor;
    }
    transpose(a_re);
    transpose(a_im);
    transpose(b_re);
    transpose(b_im);
#pragma unroll
    for (int i = 0; i < LANES; i++) {
        store_global_complex(to, i, (complexv){a_re[i], a_im[i]});
        store_global_complex(to, LANES + i, (complexv){b_re[i], b_im[i]});
    }
}

#endif
