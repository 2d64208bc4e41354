/* Realizations on the sphere, from points to values on rings: sums over points of w exp(-i m phi) spread over theta
 * are transformed to and fro, so that c_lm is a sum over rings (docs/sphere_nufft.md). Points are spread on a grid of
 * real numbers, longitude across rows, theta along them, in any order; the transform around the axis makes tiles of
 * orders; orders_rings.h does the rest. For CPUs: one work-group can do a realization whole, in the cache of its core.
 *
 * Launch: (work-items of one group, slots * shares). LANES is 2 at least. A slot does realizations first_realization +
 * slot, + slots more, ... before end_realization; where shares is more than 1, each share does some columns or tiles of it, and steps come in launches of their own.
 *
 *   points     [..][2] of orders_turns.cl, weights [..], offsets  realization r at offsets[r] .. offsets[r + 1]
 *   window, n, width, degree, bins  of nufft/window.h, the same on both axes; n is even
 *   radices, twiddles, position        of nufft/fft.h, of length n
 *   ring_radices, ring_twiddles, ring_position  of length `rings`, even and above 2 L
 *   around_gains [L + 1]: 1/2 over the transform of the window
 *   along_gains  [L + 1]: 1/4 over the transform of the window and over `rings`
 *   steps      bits: 1 spread, 2 around the axis, 4 rings
 *   grids      [slot][grid_rows][pitch]; the north pole is cell `pole` of a row
 *   all_rows   [slot][tile][columns][re, im][LANES], columns a multiple of 2 LANES; tiles: pairs of an even and an odd one
 *   values     [realization][order][sum, difference][ring_pitch][re, im]
 *   num_rings  rings / 4 + 1
 *   data, spectrum  local, [n][re, im][LANES], [rings][re, im][LANES]
 *   windows, cells  local, of a chunk: nufft/chunk.h
 */
#include "sphere/orders_rings.h"

enum { STEP_SPREAD = 1, STEP_AROUND = 2, STEP_RINGS = 4 };

/* Of `num` things, those with the numbers share, share + shares, ... */
static inline uint share_of(const uint num, const uint share, const uint shares) {
    return num > share ? (num - share + shares - 1) / shares : 0;
}

__kernel void sphere_orders(
    __global const ulong *restrict points, __global const real *restrict weights,
    __global const ulong *restrict offsets, const uint first_realization,
    const uint end_realization, __global const real *restrict window, const uint n,
    const uint width, const uint degree, const uint bins, __global const uint *restrict radices,
    __global const real *restrict twiddles, __global const uint *restrict position,
    __global const uint *restrict ring_radices, __global const real *restrict ring_twiddles,
    __global const uint *restrict ring_position, const uint rings,
    __global const real *restrict around_gains, __global const real *restrict along_gains,
    const uint L, const uint steps, const uint shares, const uint pitch, const uint grid_rows,
    const uint pole, const uint columns, const uint num_rings, const uint ring_pitch,
    __global real *restrict grids, __global real *restrict all_rows, __global real *restrict values,
    __local real *data, __local real *spectrum, __local real *windows, __local uint *cells) {
    const uint share = get_global_id(1) % shares;
    const uint slot = get_global_id(1) / shares, slots = get_global_size(1) / shares;
    const uint pairs = L / (2 * LANES) + 1;
    const uint groups = columns / (2 * LANES);
    const size_t row_reals = (size_t)columns * 2 * LANES;
    const window_axis across = {window, n, width, 0, degree, bins, 0, 1};
    const window_axis along = {window, n, width, 1, degree, bins, 0, 1};
    const chunk_axes axes = {across, across, along, 2, 0};
    const orders_grid grid = {grids + slot * (size_t)grid_rows * pitch, pitch, grid_rows};
    __global real *rows = all_rows + slot * 2 * pairs * row_reals;
    const chunk chunk = make_chunk(windows, cells, across, along);
    const bool is_spread = (steps & STEP_SPREAD) != 0;
    const uint own_groups = (steps & STEP_AROUND) != 0 ? share_of(groups, share, shares) : 0;
    const uint own_pairs = (steps & STEP_RINGS) != 0 ? share_of(pairs, share, shares) : 0;
    for (uint r = first_realization + slot; r < end_realization; r += slots) {
        clear_cells(grid.cells, is_spread ? (size_t)grid_rows * pitch : 0);
        const ulong end = is_spread ? offsets[r + 1] : offsets[r];
        for (ulong place = offsets[r]; place < end; place += CHUNK) {
            const uint count = (uint)min((ulong)CHUNK, end - place);
            fill_chunk(chunk, points + place * 2, weights + place, count, CHUNK, pitch, axes);
            if (get_local_size(0) == 1) {
                scatter(grid, chunk, axes);
            } else {
                scatter_together(grid, chunk, axes);
            }
            barrier_everywhere();
        }
        fold_rows(grid, n, is_spread ? width * pitch : 0);
        /* Groups of columns, then two transforms for each pair of tiles: one loop, since a second copy of all
         * transforms takes the compiler seconds. */
        for (uint step = 0; step < own_groups + 2 * own_pairs; step++) {
            const bool is_around = step < own_groups;
            const bool is_last = !is_around && (step - own_groups) % 2 != 0;
            const uint column = (share + step * shares) * 2 * LANES;
            const uint pair = share + (step - own_groups) / 2 * shares;
            __global real *even = rows + 2 * pair * row_reals;
            __local real *at = is_last ? spectrum : data;
            if (is_around) {
                load_columns(data, grid, column, n);
            } else if (!is_last) {
                load_meridians(data, even, even + row_reals, pole, n);
            }
            barrier(CLK_LOCAL_MEM_FENCE);
            fft_transform(at, 2 * LANES, is_last ? rings : n, is_last ? ring_radices : radices,
                          is_last ? ring_twiddles : twiddles);
            for (uint tile = get_local_id(0); is_around && tile < 2 * pairs;
                 tile += get_local_size(0)) {
                turn_orders(data, position, n, L, around_gains, tile / 2 * 2 * LANES + tile % 2,
                            rows + tile * row_reals + (size_t)column * 2 * LANES);
            }
            if (!is_around && !is_last) {
                copy_spectrum(spectrum, rings, data, position, n, L, along_gains);
            }
            const uint blocks = is_last ? ring_pitch / (LANES / 2) : 0;
            for (uint job = get_local_id(0); job < 2 * blocks; job += get_local_size(0)) {
                const uint odd = job / blocks, block = job % blocks;
                const uint first_order = pair * 2 * LANES + odd;
                const size_t parity_apart = 2 * ring_pitch, order_apart = 2 * parity_apart;
                const uint num = first_order <= L ? (L - first_order) / 2 + 1 : 0;
                write_some_rings(spectrum, ring_position, rings, num_rings, block * (LANES / 2),
                                 odd ? -1 : 1,
                                 values + (r * (size_t)(L + 1) + first_order) * order_apart,
                                 2 * order_apart, parity_apart, num);
            }
            barrier_everywhere();
        }
    }
}
