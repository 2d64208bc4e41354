/* Whole realizations, one by each work-group: points are spread on a grid of real numbers, in any
 * order; two transforms, one behind the other, make powers of it. In two dimensions they are those
 * of the axes. In one, the grid of first_n second_n cells is read as rows of second_n: with cell m
 * = m_1 second_n + m_2, frequency k_1 + first_n k_2 is the transform over m_2, at k_2, of exp(-2 pi
 * i k_1 m_2 / (first_n second_n)) times the transform over m_1, at k_1. For CPUs: the grid and what
 * the first transform leaves stay in the cache of a core, so a work-group takes one realization
 * after the other. Launch: (work-items of one group, groups).
 *
 *   numbers    of nufft/whole.h; their names are used here
 *   points, weights, offsets  of engines/torus/torus_points.h
 *   across_window, along_window  of nufft/window.h; in one dimension there is none across
 *   first_*, second_*  of transforms, nufft/transform/finish.h
 *   lane_turns [second_n][re, im][LANES], tile_turns [tile][second_n][re, im]: in one dimension, the factors
 *              above of k_1 = lane and of k_1 = tile LANES
 *   gains      [tile][2 second_K + 1][LANES]: 1 / squared transform of the window, a quarter of it (frequencies are
 *              twice what they should be, nufft/transform/halves.h), 0 where nothing is asked for
 *   means      [realization]: taken off every cell: frequency 0
 *   scales     [realization]
 *   power      [realization][stride], there as gains
 *   grids      [group][grid_reals]: rows of `pitch`, some more than cells: windows go on behind them
 *   rows       [group][cell][re, im][LANES]: a row of a tile, columns cells (second_n, up to a multiple of 2 LANES);
 *              behind it, in one dimension, room for the last columns, first_n cells; in two, for the shared tile
 *   windows, cells  local, of a chunk: nufft/chunk.h
 */
#define FFT_IN_GLOBAL
#include "nufft/chunk.h"
#include "nufft/transform/halves.h"
#include "nufft/shared_tile.h"
#include "nufft/whole.h"

typedef struct whole_grid {
    __global real *cells;
    uint pitch, rows; /* in memory */
    bool is_line;     /* one dimension: rows follow each other without gaps */
} whole_grid;

/* A chunk by one work-item. (Not just its `count` points: what is known before a barrier and used
 * in a loop behind it is more than PoCL 3.1 can do here.) In one dimension there are no loops over
 * rows. */
static inline void scatter(const whole_grid grid, const chunk from, const chunk_axes axes) {
    const uint bins = axes.along.bins;
    for (uint i = 0; i < CHUNK && grid.is_line; i++) {
        add_global_rows(grid.cells + from.cells[i], grid.pitch, from.across + i,
                        from.along + i * bins, 1, axes.along.width);
    }
    for (uint i = 0; i < CHUNK && !grid.is_line; i++) {
        add_global_rows(grid.cells + from.cells[i], grid.pitch, from.across + i,
                        from.along + i * bins, axes.across.width, axes.along.width);
    }
}

/* The same by all: each has the cells of a row that are its number modulo their number. */
static inline void scatter_together(const whole_grid grid, const chunk from,
                                    const chunk_axes axes) {
    const uint size = num_items();
    for (uint i = 0; i < CHUNK; i++) {
        const uint own = (own_item() + size - from.columns[i] % size) % size;
        for (uint bin = own; bin < axes.along.bins; bin += size) {
            for (uint row = 0; row < axes.across.width; row++) {
                __global real *to = grid.cells + from.cells[i] + row * grid.pitch + bin;
                *to = fma(from.across[row * CHUNK + i], from.along[i * axes.along.bins + bin], *to);
            }
        }
    }
}

/* The mean is taken off every cell before anything is added. */
static inline void clear_grid(const whole_grid grid, const real mean) {
    for (size_t i = own_item(); i < grid.rows * (size_t)grid.pitch / LANES; i += num_items()) {
        store_global(grid.cells, i, (realv)-mean);
    }
    barrier_everywhere();
}

/* Cells behind the last row and column are the first ones again. (No barrier under a condition:
 * PoCL would copy all that follows.) */
static inline void fold_grid(const whole_grid grid, const real mean, const window_axis across,
                             const window_axis along, const uint n) {
    const uint behind = grid.is_line ? along.bins : across.width * grid.pitch;
    const uint num_rows = grid.is_line ? 0 : across.n;
    for (uint i = own_item(); i < behind; i += num_items()) {
        grid.cells[i] += grid.cells[n + i] + mean;
    }
    barrier_everywhere();
    for (uint row = own_item(); row < num_rows; row += num_items()) {
        __global real *at = grid.cells + row * grid.pitch;
        for (uint i = 0; i < along.bins; i++) {
            at[i] += at[along.n + i] + mean;
        }
    }
    barrier_everywhere();
}

/* Where the first transform of 2 LANES columns is done, real and imaginary parts of a cell side by
 * side: in the grid, `apart` numbers from cell to cell. In one dimension the last columns go on
 * into the next row: they are copied. */
typedef struct column_place {
    __global real *cells;
    size_t apart;
} column_place;

static inline bool are_copied(const whole_grid grid, const uint column) {
    return column + 2 * LANES > grid.pitch;
}

static inline column_place place_of_columns(const whole_grid grid, __global real *spare,
                                            const uint column) {
    return are_copied(grid, column) ? (column_place){spare, 2 * LANES}
                                    : (column_place){grid.cells + column, grid.pitch};
}

static inline void copy_columns(__global real *spare, const whole_grid grid, const uint column,
                                const uint n) {
    for (uint m = own_item(); m < n; m += num_items()) {
        store_complex(spare, m, load_global_complex(grid.cells + m * grid.pitch + column, 0));
    }
}

/* A row of a tile, from all columns. */
static inline void turn_columns(__global real *row, const whole_grid grid, __global real *spare,
                                const transform_axis first, const uint k, const uint columns) {
    for (uint group = own_item(); group < columns / (2 * LANES); group += num_items()) {
        const uint column = group * 2 * LANES;
        const column_place from = place_of_columns(grid, spare, column);
        turn_halves(from.cells, from.apart, first, k, row + column * 2 * LANES);
    }
}

/* In one dimension, between the transforms. */
static inline void turn_line(__global real *row, const uint n, __global const real *lane_turns,
                             __global const real *tile_turns) {
    for (uint i = own_item(); i < n; i += num_items()) {
        const complexv turn = load_global_complex(lane_turns, i);
        const complexv z =
            complex_multiply(load_complex(row, i), tile_turns[2 * i], tile_turns[2 * i + 1]);
        store_complex(row, i, complex_multiply_lanes(z, turn.re, turn.im));
    }
}

static inline void write_row(__global const real *row, const transform_axis second,
                             const real scale, __global const real *gains, __global real *power) {
    for (uint i = own_item(); i < 2 * second.K + 1; i += num_items()) {
        const complexv z = kept_frequency(row, second, i);
        store_global(power, i,
                     fma(z.re, z.re, z.im * z.im) * (load_global(gains, i) * (realv)scale));
    }
}

__kernel void nufft_whole(
    const whole_numbers numbers, __global const ulong *restrict points,
    __global const real *restrict weights, __global const ulong *restrict offsets,
    __global const real *restrict across_window, __global const real *restrict along_window,
    __global const uint *restrict first_radices, __global const real *restrict first_twiddles,
    __global const uint *restrict first_position, __global const uint *restrict second_radices,
    __global const real *restrict second_twiddles, __global const uint *restrict second_position,
    __global const real *restrict lane_turns, __global const real *restrict tile_turns,
    __global const real *restrict gains, __global const real *restrict means,
    __global const real *restrict scales, __global real *restrict power,
    __global real *restrict grids, __global real *restrict rows, __local real *windows,
    __local uint *cells) {
    const uint num_realizations = numbers.num_realizations, first_row = numbers.first_row;
    const uint dimension = numbers.dimension, pitch = numbers.pitch;
    const uint num_tiles = numbers.num_tiles, shared_lanes = numbers.shared_lanes;
    const uint first_n = numbers.first.n, second_n = numbers.second.n;
    const uint second_K = numbers.second.K;
    const ulong stride = numbers.stride;
    const uint columns = (second_n + 2 * LANES - 1) / (2 * LANES) * (2 * LANES);
    const window_axis across = make_chunk_window(across_window, numbers.across, 0);
    const window_axis along = make_chunk_window(along_window, numbers.along, dimension - 1);
    const transform_axis first = {first_radices, first_twiddles, first_position, 0,
                                  first_n,       numbers.first.K};
    const transform_axis second = {second_radices, second_twiddles, second_position, 0,
                                   second_n,       second_K};
    const whole_grid grid = {grids + get_global_id(1) * numbers.grid_reals, pitch,
                             numbers.grid_rows, dimension == 1};
    __global real *row = rows + get_global_id(1) * numbers.row_reals;
    __global real *spare = row + columns * 2 * LANES;
    const chunk_axes axes = {across, along, dimension};
    const chunk chunk = make_chunk(windows, cells, across, along);
    const uint sharing = shared_lanes > 0 ? LANES / shared_lanes : 1;
    const uint own_tiles = shared_lanes > 0 ? num_tiles - 1 : num_tiles;
    for (size_t r = get_global_id(1); r < num_realizations; r += get_global_size(1)) {
        clear_grid(grid, means[r]);
        for (size_t place = offsets[r]; place < offsets[r + 1]; place += CHUNK) {
            const uint count = (uint)min((ulong)CHUNK, offsets[r + 1] - place);
            fill_chunk(chunk, points + place * dimension, weights + place, count, CHUNK, pitch,
                       axes);
            if (num_items() == 1) {
                scatter(grid, chunk, axes);
            } else {
                scatter_together(grid, chunk, axes);
            }
            barrier_everywhere();
        }
        fold_grid(grid, means[r], across, along, dimension == 1 ? along.n : across.n * pitch);
        /* First groups of columns, then tiles: one loop, since a second copy of all transforms
         * takes the compiler seconds. */
        const uint groups = columns / (2 * LANES);
        const uint before =
            (uint)(r / get_global_size(1)) % sharing; /* others in the shared tile */
        const bool is_full = before + 1 == sharing || r + get_global_size(1) >= num_realizations;
        const uint tiles = own_tiles + (shared_lanes > 0 && is_full ? 1 : 0);
        for (uint step = 0; step < groups + tiles; step++) {
            const bool is_first = step < groups;
            const transform_axis axis = is_first ? first : second;
            const uint column = step * 2 * LANES, tile = step - groups;
            const bool is_shared = !is_first && tile == own_tiles;
            const column_place place = is_first
                                           ? place_of_columns(grid, spare, column)
                                           : (column_place){is_shared ? spare : row, 2 * LANES};
            const shared_tile shared = {spare, shared_lanes, before * shared_lanes,
                                        own_tiles * LANES};
            if (is_first && are_copied(grid, column)) {
                copy_columns(spare, grid, column, first_n);
            }
            if (!is_first && !is_shared) {
                turn_columns(row, grid, spare, first, tile * LANES, columns);
            }
            barrier_everywhere();
            if (!is_first && dimension == 1) {
                turn_line(row, second_n, lane_turns, tile_turns + tile * (size_t)second_n * 2);
            }
            barrier_everywhere();
            fft_transform(place.cells, place.apart, axis.n, axis.radices, axis.twiddles);
            if (is_first && shared_lanes > 0 && own_item() == 0) {
                collect_columns(shared, column, place.cells, place.apart, first);
            }
            const size_t at = tile * (2 * (size_t)second_K + 1) * LANES;
            for (uint i = 0; is_shared && i <= before; i++) {
                const size_t realization = r - (before - i) * get_global_size(1);
                const shared_tile from = {spare, shared_lanes, i * shared_lanes, 0};
                write_lanes(from, second, scales[first_row + realization], gains + at,
                            power + (first_row + realization) * stride + at);
            }
            if (!is_first && !is_shared) {
                write_row(row, second, scales[first_row + r], gains + at,
                          power + (first_row + r) * stride + at);
            }
            barrier_everywhere();
        }
    }
}
