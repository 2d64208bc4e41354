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
 *   radices, twiddles, position        of nufft/fft.h, of length n / 2
 *   ring_radices, ring_twiddles, ring_position  of length `rings` / 2, above L
 *   turns, ring_turns  [n / 2], [num_rings] [cosine, sine] of -2 pi i / n, -2 pi i / rings
 *   around_gains [L + 1][3]: g, and g exp(-2 pi i m / n) / i, with g = 1/2 over the transform of the window
 *   along_gains  [L + 1]: 1/2 over the transform of the window and over `rings`
 *   steps      bits: 1 spread, 2 around the axis, 4 rings
 *   strip      columns of a strip (orders_strips.h), a multiple of LANES
 *   grids      where strip is `columns` at least, [slot][grid_rows][pitch], in bands of sphere/bands.h; the north pole
 *              is cell `pole` of a row. What this kernel spreads is one band. Else [group][grid_rows][pitch], one strip
 *              at a time: spreading comes with the transform around the axis, for a share of the strips
 *   sorted, heights, strips, starts  scratch for strips: [group][most_points, rounded up to LANES][2], and without [2],
 *              twice; [group][strips + 1]
 *   all_rows   [slot][tile][columns][re, im][LANES], columns a multiple of LANES; tiles: pairs of an even and an odd one
 *   values     [order][value_sets][sum, difference][ring_pitch][re, im], realizations from first_value on
 *   num_rings  rings / 4 + 1
 *   only_even  even degrees only: the values of others are left alone
 *   scratch    [group][n + rings / 2][re, im][LANES]
 *   windows, cells  local, of a chunk: nufft/chunk.h
 */
#include "sphere/orders_rings.h"
#include "sphere/orders_strips.h"

enum { STEP_SPREAD = 1, STEP_AROUND = 2, STEP_RINGS = 4 };

/* Of `num` things in a row, where those of a share begin. */
static inline uint start_of_share(const uint share, const uint num, const uint shares) {
    return (uint)((ulong)share * num / shares);
}

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
    __global const real *restrict turns, __global const real *restrict ring_turns,
    __global const real *restrict around_gains, __global const real *restrict along_gains,
    const uint L, const uint only_even, const uint steps, const uint shares, const uint pitch,
    const uint grid_rows, const uint bands, const uint pole, const uint columns,
    const uint num_rings, const uint ring_pitch, const uint strip, const ulong most_points,
    __global ulong *restrict sorted, __global real *restrict heights,
    __global uint *restrict strips, __global uint *restrict starts, __global real *restrict grids,
    __global real *restrict all_rows, __global real *restrict values, const uint first_value,
    const uint value_sets, __global real *restrict scratch, __local real *windows,
    __local uint *cells) {
    const uint share = get_global_id(1) % shares;
    const uint slot = get_global_id(1) / shares, slots = get_global_size(1) / shares;
    const uint pairs = L / (2 * LANES) + 1;
    const uint groups = columns / LANES, middle = n / 2, half_rings = rings / 2;
    const uint transforms = only_even != 0 ? 2 : 4; /* of a pair of tiles */
    const size_t row_reals = (size_t)columns * 2 * LANES;
    const window_axis across = {window, n, width, 0, degree, bins, 0, 1};
    const window_axis along = {window, n, width, 1, degree, bins, 0, 1};
    const chunk_axes axes = {across, across, along, 2, 0};
    const size_t group = get_global_id(1);
    const bool is_whole = strip >= columns;
    const orders_grid grid = {grids + (is_whole ? slot : group) * (size_t)grid_rows * pitch, pitch,
                              grid_rows, 0};
    __global real *rows = all_rows + slot * 2 * pairs * row_reals;
    __global real *data = scratch + group * (size_t)(n + half_rings) * 2 * LANES;
    __global real *spectrum = data + (size_t)n * 2 * LANES;
    const chunk chunk = make_chunk(windows, cells, across, along);
    const bool is_spread = (steps & STEP_SPREAD) != 0;
    /* Strips of this share, and those before them whose windows reach here. */
    const uint num_strips = (columns + strip - 1) / strip;
    const uint first_strip = is_whole ? 0 : start_of_share(share, num_strips, shares);
    const uint end_strip = is_whole ? 1 : start_of_share(share + 1, num_strips, shares);
    const uint reach = is_whole ? 0 : (bins + strip - 2) / strip;
    const uint lead = first_strip > reach ? first_strip - reach : 0;
    const size_t room = (most_points + LANES - 1) / LANES * LANES;
    const strip_points own_points = {sorted + group * room * 2, heights + group * room,
                                     strips + group * room, starts + group * (num_strips + 1)};
    const uint groups_here = is_whole
                                 ? share_of(groups, share, shares)
                                 : (min(end_strip * strip, columns) - first_strip * strip) / LANES;
    const uint own_groups = (steps & STEP_AROUND) != 0 ? groups_here : 0;
    const uint own_pairs = (steps & STEP_RINGS) != 0 ? share_of(pairs, share, shares) : 0;
    const uint num_steps = own_groups + transforms * own_pairs;
    const uint last_step = max(num_steps, is_spread ? 1u : 0u); /* one for spreading alone */
    uint passes = 0;
    while (radices[passes] != 0) {
        passes++;
    }
    __global const uint *no_radices = radices + passes;
    for (uint r = first_realization + slot; r < end_realization; r += slots) {
        if (is_spread && !is_whole && get_local_id(0) == 0) {
            sort_by_strips(own_points, points + offsets[r] * 2, weights + offsets[r],
                           offsets[r + 1] - offsets[r], along, strip, lead, end_strip);
        }
        barrier_everywhere();
        /* Groups of columns, then to and fro for each pair of tiles, even frequencies and odd ones: one loop, since a
         * second copy of all transforms takes the compiler seconds. */
        for (uint step = 0; step < last_step; step++) {
            const bool is_around = step < own_groups, is_idle = step >= num_steps;
            const uint phase = is_around ? 0 : (step - own_groups) % transforms;
            const bool is_last = phase % 2 != 0;
            const uint parity = phase / 2;
            const uint column =
                is_whole ? (share + step * shares) * LANES : first_strip * strip + step * LANES;
            const uint pair = share + (step - own_groups) / transforms * shares;
            __global real *even = rows + 2 * pair * row_reals;
            __global real *own = data + parity * (size_t)middle * 2 * LANES;
            const uint here = is_whole ? 0 : column / strip;
            const bool is_next = is_spread && (step == 0 || (is_around && column % strip == 0));
            for (uint at = step == 0 ? lead : here; at < (is_next ? min(here + 1, end_strip) : 0);
                 at++) {
                carry_cells(grid, at == lead ? pitch : strip);
                const ulong begin = is_whole ? offsets[r] : own_points.starts[at];
                const ulong end = is_whole ? offsets[r + 1] : own_points.starts[at + 1];
                __global const ulong *from = is_whole ? points : own_points.turns;
                __global const real *masses = is_whole ? weights : own_points.weights;
                const orders_grid to = {grid.cells, pitch, grid_rows, at * strip};
                for (ulong place = begin; place < end; place += CHUNK) {
                    const uint count = (uint)min((ulong)CHUNK, end - place);
                    fill_chunk(chunk, from + place * 2, masses + place, count, CHUNK, pitch, axes);
                    if (get_local_size(0) == 1) {
                        scatter(to, chunk, axes);
                    } else {
                        scatter_together(to, chunk, axes);
                    }
                    barrier_everywhere();
                }
            }
            if (is_around) {
                load_columns(data, grid, column - here * strip, n, width, bands);
            } else if (phase == 0 && !is_idle) {
                load_meridians(data, even, even + row_reals, pole, n, turns);
            }
            barrier_everywhere();
            fft_transform(is_last ? spectrum : own, 2 * LANES, is_last ? half_rings : middle,
                          is_idle   ? no_radices
                          : is_last ? ring_radices
                                    : radices,
                          is_last ? ring_twiddles : twiddles);
            for (uint tile = get_local_id(0); is_around && tile < 2 * pairs;
                 tile += get_local_size(0)) {
                turn_orders(data, position, middle, L, around_gains,
                            tile / 2 * 2 * LANES + tile % 2,
                            rows + tile * row_reals + (size_t)column * 2 * LANES);
            }
            if (!is_around && !is_last && !is_idle) {
                copy_spectrum(spectrum, half_rings, own, position, middle, L, parity, along_gains);
            }
            const ring_target target = {values + (first_value + r) * 4 * (size_t)ring_pitch,
                                        value_sets * 4 * (size_t)ring_pitch, 2 * (size_t)ring_pitch,
                                        L};
            const uint blocks = is_last ? ring_pitch / (LANES / 2) : 0;
            for (uint block = get_local_id(0); block < blocks; block += get_local_size(0)) {
                write_some_rings(spectrum, ring_position, half_rings, num_rings,
                                 block * (LANES / 2), parity, ring_turns, target, pair * 2 * LANES);
            }
            barrier_everywhere();
        }
    }
}
