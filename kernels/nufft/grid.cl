/* Points of one large set in two dimensions spread on the whole fine grid, as real numbers, a block
 * of rows by each work-group. Launch: (work-items of one group, blocks).
 *
 * Rows lie along the last axis; blocks are block_rows cells of axis 0.
 *
 *   places, sorted, heights  of nufft/sort.cl, in parts
 *   starts    [part][block_n + 2]: places in the order of cells of axis 0
 *   numbers   grid_numbers of nufft/numbers.h; the coordinates are those of the points
 *   block_window, last_window  coefficients of nufft/window.h
 *   high, low [cell of axis 0][cell of the last axis]: pairs of numbers, continued unless is_first; a slab
 *             of them, the blocks from first_block on
 *   rows      local, [block_rows][last_n + last_bins]; last_n is a multiple of LANES
 *   windows, cells  local, of a chunk: nufft/chunk.h
 */
#include "nufft/chunk.h"
#include "shared/pair.h"

/* Rows of a block that a window touches which begins `row_before + 1 - width` rows from the first.
 */
typedef struct touched_rows {
    uint first, end, first_bin;
} touched_rows;

static inline touched_rows rows_touched(const uint row_before, const uint num_rows,
                                        const uint width) {
    const uint first = max(row_before + 1, width) - width;
    return (touched_rows){first, min(row_before + 1, num_rows), first + width - 1 - row_before};
}

/* `count` points of a chunk by one work-item. */
static inline void add_alone(__local real *rows, const chunk from, const uint count,
                             const touched_rows touched, const chunk_axes axes) {
    const uint pitch = axes.along.n + axes.along.bins;
    for (uint i = 0; i < count; i++) {
        add_local_rows(rows + touched.first * pitch + from.columns[i], pitch,
                       from.across + touched.first_bin * CHUNK + i,
                       from.along + i * axes.along.bins, touched.end - touched.first,
                       axes.along.width);
    }
}

/* The same by all work-items: each has the cells that are its number modulo their number. */
static inline void add_together(__local real *rows, const chunk from, const uint count,
                                const touched_rows touched, const chunk_axes axes) {
    const uint pitch = axes.along.n + axes.along.bins;
    const uint size = get_local_size(0);
    for (uint i = 0; i < count; i++) {
        const uint own = (get_local_id(0) + size - from.columns[i] % size) % size;
        for (uint bin = own; bin < axes.along.width; bin += size) {
            for (uint row = touched.first; row < touched.end; row++) {
                const uint across = touched.first_bin + row - touched.first;
                __local real *at = rows + row * pitch + from.columns[i] + bin;
                *at = fma(from.across[across * CHUNK + i], from.along[i * axes.along.bins + bin],
                          *at);
            }
        }
    }
}

/* The cells behind the end of rows are the first ones again; then into the pairs. */
static inline void add_to_grid(__local real *rows, const uint num_rows, const window_axis last,
                               const uint is_first, __global real *high, __global real *low) {
    const uint pitch = last.n + last.bins;
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint row = 0; row < num_rows; row++) {
        for (uint i = get_local_id(0); i < last.bins; i += get_local_size(0)) {
            rows[row * pitch + i] += rows[row * pitch + last.n + i];
        }
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint row = 0; row < num_rows; row++) {
        for (size_t i = get_local_id(0); i < last.n / LANES; i += get_local_size(0)) {
            const size_t at = row * (size_t)(last.n / LANES) + i;
            realv sum = 0, rest = 0;
            if (!is_first) {
                sum = load_global(high, at);
                rest = load_global(low, at);
            }
            pair_add(&sum, &rest, load_local(rows + row * pitch, i));
            store_global(high, at, sum);
            store_global(low, at, rest);
        }
    }
}

__kernel void nufft_grid(const grid_numbers numbers, __global const ulong *restrict places,
                         __global const ulong *restrict sorted,
                         __global const real *restrict heights,
                         __global const uint *restrict starts,
                         __global const real *restrict block_window,
                         __global const real *restrict last_window, __global real *restrict high,
                         __global real *restrict low, __local real *rows, __local real *windows,
                         __local uint *cells) {
    const uint block_n = numbers.block.n, block_width = numbers.block.width;
    const uint last_n = numbers.last.n, last_bins = numbers.last.bins;
    const uint num_parts = numbers.num_parts, block_rows = numbers.block_rows;
    const size_t block = get_global_id(1);
    const uint first_row = (uint)(numbers.first_block + block) * block_rows;
    const uint num_rows = min(block_rows, block_n - first_row);
    const window_axis across = make_chunk_window(block_window, numbers.block, 0);
    const window_axis along = make_chunk_window(last_window, numbers.last, 1);
    const chunk_axes axes = {across, along, 2};
    const chunk chunk = make_chunk(windows, cells, across, along);
    const size_t at = block * block_rows * last_n;
    for (uint i = get_local_id(0); i < num_rows * (last_n + last_bins); i += get_local_size(0)) {
        rows[i] = 0;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint before = 0; before < num_rows + block_width - 1; before++) {
        const uint key = (first_row + before + block_n - block_width + 1) % block_n;
        const touched_rows touched = rows_touched(before, num_rows, block_width);
        for (uint part = 0; part < num_parts; part++) {
            __global const uint *start = starts + part * ((size_t)block_n + 2) + key;
            const size_t end = places[part] + start[1];
            for (size_t place = places[part] + start[0]; place < end; place += CHUNK) {
                const uint count = (uint)min((size_t)CHUNK, end - place);
                fill_chunk(chunk, sorted + place * 2, heights + place, count, count, 0, axes);
                if (get_local_size(0) == 1) {
                    add_alone(rows, chunk, count, touched, axes);
                } else {
                    add_together(rows, chunk, count, touched, axes);
                }
                barrier(CLK_LOCAL_MEM_FENCE);
            }
        }
    }
    add_to_grid(rows, num_rows, along, numbers.is_first, high + at, low + at);
}
