/* Realizations on the sphere, from points to values on rings: sums over points of w exp(-i m phi)
 * spread over theta are transformed to and fro, so that c_lm is a sum over rings
 * (docs/engines/sphere_nufft.md). Points are spread on a grid of real numbers, longitude across
 * rows, theta along them, in any order; the transform around the axis makes tiles of orders;
 * orders_rings.h does the rest. For CPUs: one work-group can do a realization whole, in the cache
 * of its core.
 *
 * Launch: (1, slots * shares) in work-groups of one item. LANES is 2 at least. A slot does
 * realizations first_realization + slot, + slots more, ... before end_realization; where shares is
 * more than 1, each share does some columns or tiles of it, and steps come in launches of their
 * own.
 *
 *   points     [..][2] of orders_ends.cl, weights [..], offsets  realization r at offsets[r] .. offsets[r + 1]
 *   numbers    of orders.h; their names are used here
 *   window     of nufft/window.h, the same on both axes
 *   radices, twiddles, position        of nufft/transform/fft.h, of length n / 2
 *   ring_radices, ring_twiddles, ring_position  of length `rings` / 2, above L
 *   turns, ring_turns  [n / 2], [num_rings] [cosine, sine] of -2 pi i / n, -2 pi i / rings
 *   around_gains [L + 1][3]: g, and g exp(-2 pi i m / n) / i, with g = 1/2 over the transform of the window
 *   along_gains  [L + 1]: 1/2 over the transform of the window and over `rings`
 *   grids      where strip is `columns` at least, [slot][grid_rows][pitch], in bands of sphere/bands.h; the north pole
 *              is cell `pole` of a row. What this kernel spreads is one band. Else [group][grid_rows][pitch], one strip
 *              at a time: spreading comes with the transform around the axis, for a share of the strips
 *   sorted, heights, strips, starts  scratch for strips: [group][most_points, rounded up to LANES][2], and without [2],
 *              twice; [group][strips + 1]
 *   all_rows   [slot][tile][columns][re, im][LANES], columns a multiple of LANES; tiles: pairs of an even and an odd one
 *   values     [order][value_sets][sum, difference][ring_pitch][re, im] (values.h), realizations from first_value on
 *   scratch    [group][n + rings / 2][re, im][LANES]
 *   windows, cells  local, of a chunk: nufft/chunk.h
 */
#define ALONE 1 /* CPUs alone have this kernel */
#include "sphere/nufft/orders.h"
#include "sphere/nufft/orders_rings.h"
#include "sphere/nufft/orders_strips.h"
#include "sphere/values.h"

/* Kernels of the same program (docs/developer/decisions.md). */
#include "sphere/nufft/orders_bands.cl"
#include "sphere/nufft/orders_ends.cl"
#include "sphere/nufft/orders_sort.cl"
#include "sphere/nufft/orders_sum.cl"

enum { STEP_SPREAD = 1, STEP_AROUND = 2, STEP_RINGS = 4 };

/* ---- what a share does ---------------------------------------------------------------------- */

/* Returns where those of a share begin among `num` things in a row. */
static inline uint start_of_share(const uint share, const uint num, const uint shares) {
    return (uint)((ulong)share * num / shares);
}

/* Returns how many of `num` things have the numbers share, share + shares, ... */
static inline uint share_of(const uint num, const uint share, const uint shares) {
    return num > share ? (num - share + shares - 1) / shares : 0;
}

/* Strips first_strip .. end_strip - 1, and those from `lead` on, whose windows reach there, are
 * spread; a grid that is whole counts as one. */
typedef struct share_work {
    uint share, shares, strip;
    bool is_whole, is_spread;
    uint lead, first_strip, end_strip;
    uint groups, pairs; /* groups of columns, pairs of tiles */
} share_work;

static inline void divide_strips(share_work *work, const uint columns, const uint bins) {
    const uint num_strips = (columns + work->strip - 1) / work->strip;
    const uint reach = (bins + work->strip - 2) / work->strip;
    if (work->is_whole) {
        work->lead = work->first_strip = 0;
        work->end_strip = 1;
        work->groups = share_of(columns / LANES, work->share, work->shares);
    } else {
        work->first_strip = start_of_share(work->share, num_strips, work->shares);
        work->end_strip = start_of_share(work->share + 1, num_strips, work->shares);
        work->lead = work->first_strip > reach ? work->first_strip - reach : 0;
        work->groups =
            (min(work->end_strip * work->strip, columns) - work->first_strip * work->strip) / LANES;
    }
}

/* The first column of a group. */
static inline uint column_of(const share_work work, const uint group) {
    return work.is_whole ? (work.share + group * work.shares) * LANES
                         : work.first_strip * work.strip + group * LANES;
}

/* In any order, begin .. end - 1, or strip by strip from starts on. */
typedef struct some_points {
    __global const ulong *turns;
    __global const real *weights;
    ulong begin, end;
    __global const uint *starts;
} some_points;

/* Spreads what group `group` of columns needs, one after the other: a strip before its first group.
 */
static inline void spread_for_group(const share_work work, const uint group, const orders_grid grid,
                                    const chunk chunk, const some_points points,
                                    const chunk_axes axes) {
    const uint column = column_of(work, group);
    const uint here = work.is_whole ? 0 : column / work.strip;
    const bool is_next =
        work.is_spread && (group == 0 || (group < work.groups && column % work.strip == 0));
    const uint end = is_next ? min(here + 1, work.end_strip) : 0;
    for (uint at = group == 0 ? work.lead : here; at < end; at++) {
        const orders_grid to = {grid.cells, grid.pitch, grid.rows, at * work.strip};
        carry_cells(grid, at == work.lead ? grid.pitch : work.strip);
        const ulong begin = work.is_whole ? points.begin : points.starts[at];
        const ulong behind = work.is_whole ? points.end : points.starts[at + 1];
        spread_points(to, chunk, points.turns, points.weights, begin, behind, axes);
    }
}

/* ---- transforms ----------------------------------------------------------------------------- */

/* A transform of half a length: around the axis and along theta, or to rings. */
typedef struct half_plan {
    __global const uint *radices;
    __global const real *twiddles;
    __global const uint *position;
    uint length;
} half_plan;

/* All tiles of a realization, columns * 2 * LANES numbers each. */
typedef struct order_tiles {
    __global real *rows;
    size_t row_reals;
    uint num;
} order_tiles;

static inline void write_orders(const order_tiles tiles, __global const real *data,
                                const half_plan around, const uint L, __global const real *gains,
                                const uint column) {
    for (uint tile = 0; tile < tiles.num; tile++) {
        turn_orders(data, around.position, around.length, L, gains, tile / 2 * 2 * LANES + tile % 2,
                    tiles.rows + tile * tiles.row_reals + (size_t)column * 2 * LANES);
    }
}

static inline void write_rings(const ring_target target, __global const real *spectrum,
                               const half_plan to_rings, const uint num_rings,
                               const uint ring_pitch, const uint parity,
                               __global const real *ring_turns, const uint first_order) {
    for (uint block = 0; block < ring_pitch / (LANES / 2); block++) {
        write_some_rings(spectrum, to_rings.position, to_rings.length, num_rings,
                         block * (LANES / 2), parity, ring_turns, target, first_order);
    }
}

__kernel void sphere_orders(
    const orders_numbers numbers, __global const ulong *restrict points,
    __global const real *restrict weights, __global const ulong *restrict offsets,
    __global const real *restrict window, __global const uint *restrict radices,
    __global const real *restrict twiddles, __global const uint *restrict position,
    __global const uint *restrict ring_radices, __global const real *restrict ring_twiddles,
    __global const uint *restrict ring_position, __global const real *restrict turns,
    __global const real *restrict ring_turns, __global const real *restrict around_gains,
    __global const real *restrict along_gains, __global ulong *restrict sorted,
    __global real *restrict heights, __global uint *restrict strips, __global uint *restrict starts,
    __global real *restrict grids, __global real *restrict all_rows, __global real *restrict values,
    __global real *restrict scratch, __local real *windows, __local uint *cells) {
    const uint n = numbers.window.n, width = numbers.window.width, bins = numbers.window.bins;
    const uint end_realization = numbers.end_realization, steps = numbers.steps;
    const uint shares = numbers.shares, L = numbers.L, pitch = numbers.pitch;
    const uint grid_rows = numbers.grid_rows, bands = numbers.bands, pole = numbers.pole;
    const uint columns = numbers.columns, strip = numbers.strip, rings = numbers.rings;
    const uint num_rings = numbers.num_rings, ring_pitch = numbers.ring_pitch;
    const uint first_value = numbers.first_value, value_sets = numbers.value_sets;
    const uint slot = get_global_id(1) / shares, slots = get_global_size(1) / shares;
    const uint pairs = L / (2 * LANES) + 1;
    const uint transforms = numbers.only_even != 0 ? 2 : 4; /* of a pair of tiles */
    const uint num_strips = (columns + strip - 1) / strip;
    const size_t group = get_global_id(1), row_reals = (size_t)columns * 2 * LANES;
    const size_t room = (numbers.most_points + LANES - 1) / LANES * LANES;
    const window_axis across = make_chunk_window(window, numbers.window, 0);
    const window_axis along = make_chunk_window(window, numbers.window, 1);
    const chunk_axes axes = {across, along, 2};
    const chunk chunk = make_chunk(windows, cells, across, along);
    const half_plan around = {radices, twiddles, position, n / 2};
    const half_plan to_rings = {ring_radices, ring_twiddles, ring_position, rings / 2};
    share_work work = {.share = get_global_id(1) % shares,
                       .shares = shares,
                       .strip = strip,
                       .is_whole = strip >= columns,
                       .is_spread = (steps & STEP_SPREAD) != 0};
    divide_strips(&work, columns, bins);
    work.groups = (steps & STEP_AROUND) != 0 ? work.groups : 0;
    work.pairs = (steps & STEP_RINGS) != 0 ? share_of(pairs, work.share, shares) : 0;
    const orders_grid grid = {grids + (work.is_whole ? slot : group) * (size_t)grid_rows * pitch,
                              pitch, grid_rows, 0};
    const order_tiles tiles = {all_rows + slot * 2 * pairs * row_reals, row_reals, 2 * pairs};
    __global real *data = scratch + group * (size_t)(n + rings / 2) * 2 * LANES;
    __global real *spectrum = data + (size_t)n * 2 * LANES;
    const strip_points sorting = {sorted + group * room * 2, heights + group * room,
                                  strips + group * room, starts + group * (num_strips + 1)};
    const uint num_steps = work.groups + transforms * work.pairs;
    const uint last_step = max(num_steps, work.is_spread ? 1u : 0u); /* one for spreading alone */
    uint passes = 0;
    while (radices[passes] != 0) {
        passes++;
    }
    const half_plan nothing = {radices + passes, twiddles, position, 0};
    for (uint r = numbers.first_realization + slot; r < end_realization; r += slots) {
        const some_points whole = {points, weights, offsets[r], offsets[r + 1], starts};
        const some_points by_strips = {sorting.turns, sorting.weights, 0, 0, sorting.starts};
        const ring_target target = {values + (first_value + r) * 4 * (size_t)ring_pitch,
                                    order_pitch(value_sets, 2 * (size_t)ring_pitch),
                                    2 * (size_t)ring_pitch, L};
        if (work.is_spread && !work.is_whole) {
            sort_by_strips(sorting, points + offsets[r] * 2, weights + offsets[r],
                           offsets[r + 1] - offsets[r], along, strip, work.lead, work.end_strip);
        }
        /* Groups of columns, then to and fro for each pair of tiles, even frequencies and odd ones:
         * one loop, since a second copy of all transforms takes the compiler seconds. */
        for (uint step = 0; step < last_step; step++) {
            const bool is_around = step < work.groups, is_idle = step >= num_steps;
            const uint phase = is_around ? 0 : (step - work.groups) % transforms;
            const uint parity = phase / 2;
            const bool is_last = phase % 2 != 0;
            const uint column = column_of(work, step);
            const uint pair = work.share + (step - work.groups) / transforms * shares;
            __global const real *even = tiles.rows + 2 * pair * row_reals;
            __global real *own = data + parity * (size_t)around.length * 2 * LANES;
            const half_plan plan = is_idle ? nothing : is_last ? to_rings : around;
            spread_for_group(work, step, grid, chunk, work.is_whole ? whole : by_strips, axes);
            if (is_around) {
                load_columns(data, grid, work.is_whole ? column : column % strip, n, width, bands);
            } else if (phase == 0 && !is_idle) {
                load_meridians(data, even, even + row_reals, pole, n, turns);
            }
            fft_transform(is_last ? spectrum : own, 2 * LANES, plan.length, plan.radices,
                          plan.twiddles);
            if (is_around) {
                write_orders(tiles, data, around, L, around_gains, column);
            } else if (is_last) {
                write_rings(target, spectrum, to_rings, num_rings, ring_pitch, parity, ring_turns,
                            pair * 2 * LANES);
            } else if (!is_idle) {
                copy_spectrum(spectrum, to_rings.length, own, position, around.length, L, parity,
                              along_gains);
            }
        }
    }
}
