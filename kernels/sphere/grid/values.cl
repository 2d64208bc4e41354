/* Realizations on the sphere, from points to values on the angles of the grid itself: sums over
 * points of w exp(-i m phi), spread over theta. What a cell counts in c_lm is in a table
 * (docs/engines/sphere_grid.md). Points are spread on a grid of real numbers, longitude across
 * rows, theta along them.
 *
 * Launch: (1, slots) in work-groups of one item. LANES is 2 at least. A slot does the realizations
 * slot, slot + slots, ...
 *
 *   numbers    of numbers.h; their names are used here
 *   points     [..][2] of orders_ends.cl, weights [..], offsets  realization r at offsets[r] .. offsets[r + 1]
 *   window     of nufft/window.h, the same on both axes
 *   radices, twiddles, position  of nufft/transform/fft.h, of length n / 2
 *   gains      [L + 1][3]: around_gains of orders.cl
 *   begins     [order][even, odd l - m][most_runs] of begins.cl: values that do not count are left alone
 *   grids      [slot][n + width][pitch], and LANES numbers in front and behind; angle (i + 1/2) 2 pi / n is cell
 *              pole + i of a row, and windows of points at the pole reach `pole` cells behind it
 *   values     [order][value_sets][even, odd l - m][vector of angles][re, im][LANES] (values.h), realizations from
 *              first_value on; vectors for num_angles angles
 *   scratch    [slot][2][n / 2][re, im][LANES]
 *   windows, cells  local, of a chunk: nufft/chunk.h
 */
#define ALONE 1 /* CPUs alone have this kernel */
#include "shared/ahead.h"
#include "sphere/grid/table.h"
#include "sphere/nufft/numbers.h"
#include "sphere/nufft/orders_grid.h"
#include "sphere/values.h"

/* Kernels of the same program (docs/developer/decisions.md). */
#include "sphere/grid/begins.cl"
#include "sphere/grid/sums.cl"
#include "sphere/nufft/orders_ends.cl"

#if LANES == 2
#define REVERSED(v) ((v).s10)
#elif LANES == 4
#define REVERSED(v) ((v).s3210)
#elif LANES == 8
#define REVERSED(v) ((v).s76543210)
#elif LANES == 16
#define REVERSED(v) ((v).sfedcba9876543210)
#endif

/* LANES cells of a longitude; the rows behind the last are those of the first longitudes. */
static inline realv cells_of(const orders_grid grid, const uint row, const uint n, const uint width,
                             const int column) {
    __global const real *at = grid.cells + (long)row * grid.pitch + column;
    const realv cells = load_global(at, 0);
    return row < width ? cells + load_global(at + n * (size_t)grid.pitch, 0) : cells;
}

/* Angles first, first + 1, ... from both poles, of one longitude. A cell behind a pole is one in
 * front of it on the opposite longitude. */
typedef struct both_ends {
    realv north, south;
} both_ends;

/* Lanes in front of `end`; the others may be cells of the next row. */
static inline realv first_lanes(const realv v, const uint end) {
    real lanes[LANES];
    *(unaligned_realv *)lanes = v;
    for (uint i = 0; i < LANES; i++) {
        lanes[i] = i < end ? lanes[i] : 0;
    }
    return *(unaligned_realv *)lanes;
}

static inline void load_ends(both_ends *to, const orders_grid grid, const uint pole, const uint row,
                             const uint n, const uint width, const uint first) {
    const uint south = pole + n / 2;
    to->north = cells_of(grid, row, n, width, pole + first);
    to->south = REVERSED(cells_of(grid, row, n, width, south - first - LANES));
    if (first < pole) {
        const uint opposite = row < n / 2 ? row + n / 2 : row - n / 2;
        to->north +=
            first_lanes(REVERSED(cells_of(grid, opposite, n, width, (int)(pole - first) - LANES)),
                        pole - first);
        to->south += first_lanes(cells_of(grid, opposite, n, width, south + first), pole - first);
    }
}

/* All longitudes, two of which are one complex number: sums of both ends, and behind them
 * differences. With even degrees only the sum of a point and the one opposite to it, which has
 * both. */
static inline void load_angles(__global real *data, const orders_grid grid, const uint pole,
                               const uint n, const uint width, const uint first,
                               const uint only_even) {
    for (uint row = 0; row < n; row++) {
        both_ends ends, opposite;
        load_ends(&ends, grid, pole, row, n, width, first);
        if (only_even != 0) {
            load_ends(&opposite, grid, pole, row < n / 2 ? row + n / 2 : row - n / 2, n, width,
                      first);
            store_global(data, row, ends.north + opposite.south);
        } else {
            store_global(data, row, ends.north + ends.south);
            store_global(data, n + row, ends.north - ends.south);
        }
    }
}

/* Whether cells of an order count in some degree at angles below `end`: towards the poles only
 * those of low orders do. begins: of its `num` runs. */
static inline bool is_wanted(__global const uint *begins, const uint num, const uint end) {
    bool is_there = false;
    for (uint run = 0; run < num; run++) {
        is_there = is_there || begins[run] < end;
    }
    return is_there;
}

/* Orders first_order, + step, ... of a transform, to [order][..], that count at angles below `end`.
 */
static inline void write_orders(__global real *to, const size_t order_apart,
                                __global const real *data, __global const uint *position,
                                const uint middle, const uint L, __global const real *gains,
                                const uint first_order, const uint step,
                                __global const uint *begins, const uint most_runs, const uint odd,
                                const uint end) {
    const uint ahead = 4; /* orders; 12 are as good */
    for (uint m = first_order; m <= L; m += step) {
        if (is_wanted(begins + (2 * m + odd) * most_runs, most_runs, end)) {
            will_write(to + (m + ahead * step) * order_apart);
            will_write(to + (m + ahead * step) * order_apart + LANES);
            complexv x;
            order_of_columns(&x, data, position, middle, gains, m);
            store_global_complex(to + m * order_apart, 0, x);
        }
    }
}

__kernel void
sphere_grid_values(const grid_values_numbers numbers, __global const ulong *restrict points,
                   __global const real *restrict weights, __global const ulong *restrict offsets,
                   __global const real *restrict window, __global const uint *restrict radices,
                   __global const real *restrict twiddles, __global const uint *restrict position,
                   __global const real *restrict gains, __global const uint *restrict begins,
                   __global real *restrict grids, __global real *restrict values,
                   __global real *restrict scratch, __local real *windows, __local uint *cells) {
    const uint n = numbers.window.n, width = numbers.window.width;
    const uint num_realizations = numbers.num_realizations;
    const uint L = numbers.L, only_even = numbers.only_even, most_runs = numbers.most_runs;
    const uint pitch = numbers.pitch, pole = numbers.pole, num_angles = numbers.num_angles;
    const uint first_value = numbers.first_value, value_sets = numbers.value_sets;
    const uint slot = get_global_id(1), slots = get_global_size(1);
    const uint groups = (num_angles + LANES - 1) / LANES;
    const uint transforms = only_even != 0 ? 1 : 2;
    const window_axis across = make_chunk_window(window, numbers.window, 0);
    const window_axis along = make_chunk_window(window, numbers.window, 1);
    const chunk_axes axes = {across, along, 2};
    const chunk chunk = make_chunk(windows, cells, across, along);
    const size_t grid_reals = (size_t)(n + width) * pitch + 2 * LANES;
    __global real *all_cells = grids + slot * grid_reals;
    const orders_grid grid = {all_cells + LANES, pitch, n + width, 0};
    const size_t parity_apart = (size_t)groups * 2 * LANES,
                 order_apart = order_pitch(value_sets, parity_apart);
    __global real *data = scratch + slot * (size_t)n * 2 * LANES;
    for (uint r = slot; r < num_realizations; r += slots) {
        __global real *of_set = values + (first_value + r) * 2 * parity_apart;
        clear_cells(all_cells, grid_reals);
        spread_points(grid, chunk, points, weights, offsets[r], offsets[r + 1], axes);
        /* One loop, since a second copy of all transforms takes the compiler seconds. */
        for (uint i = 0; i < groups * transforms; i++) {
            const uint group = i / transforms, odd = i % transforms, end = (group + 1) * LANES;
            __global real *own = data + odd * (size_t)n * LANES;
            __global real *to = of_set + group * 2 * LANES + odd * parity_apart;
            if (odd == 0) {
                load_angles(data, grid, pole, n, width, group * LANES, only_even);
            }
            fft_transform(own, 2 * LANES, n / 2, radices, twiddles);
            if (only_even != 0) {
                write_orders(to, order_apart, own, position, n / 2, L, gains, 0, 2, begins,
                             most_runs, 0, end);
                write_orders(to + parity_apart, order_apart, own, position, n / 2, L, gains, 1, 2,
                             begins, most_runs, 1, end);
            } else {
                write_orders(to, order_apart, own, position, n / 2, L, gains, 0, 1, begins,
                             most_runs, odd, end);
            }
        }
    }
}
