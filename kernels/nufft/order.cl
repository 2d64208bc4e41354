/* The order of the points of sets by keys, as GPUs want it: a counting sort, stable, in parallel
 * and without atomics, so that it is the order of nufft/sort.cl whatever the sizes below. A set of
 * one tile is ordered by order_tiles alone, a batch of them in one launch; a larger one digit by
 * digit, the lowest first, by order_tiles, order_segments, order_sums and order_scatter, and
 * order_starts at the end. order_move puts the points into that order.
 *
 * Of a digit, first[tile][b] is the number of keys below b in a tile, which needs no counters: the
 * tile is sorted. Its sum over all tiles is where digit b begins in the set, so that sums are taken
 * over tiles alone, each b by itself.
 *
 *   numbers  order_numbers of nufft/numbers.h
 *   offsets  set s has the points offsets[s] .. offsets[s + 1], and its orders there
 *   keys     [point]
 *   before   [point] the order so far, from the beginning of the set; not looked at for the first digit
 *   tiles    [point] digit << ORDER_PLACE_BITS | place in the tile, each tile in the order of digits
 *   firsts   [set][tile][row]; after order_sums the sums over the tiles up to this one
 *   sums     [set][ORDER_SEGMENTS][row]: over the tiles of a segment
 *   starts   [set][row]: the points of key m are starts[m] .. starts[m + 1] of the order
 */
#include "shared/real.h"
#include "nufft/numbers.h"

#ifndef DIMENSION
#define DIMENSION 2
#endif

/* Digits that tiles are sorted by in local memory. */
#define DIGIT_BITS 4
#define DIGITS 16

/* Neighbours of each worker lie in other banks. Device arrays of n have room for AT(n). */
#define AT(i) ((i) + ((i) >> 4))

/* ---- tiles ------------------------------------------------------------------------------- */

/* The number of keys below `key` in a sorted tile. */
static inline uint count_below(__local const uint *data, const uint count, const uint key) {
    uint low = 0, high = count;
    while (low < high) {
        const uint middle = (low + high) / 2;
        if (data[AT(middle)] >> ORDER_PLACE_BITS < key) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

/* Each worker counts the digits of its neighbours, [digit][worker]. */
static inline void count_digits(__local const uint *data, __local ushort *counters,
                                const uint workers, const uint count, const uint shift) {
    const uint run = (count + workers - 1) / workers;
    for (uint worker = get_local_id(0); worker < workers; worker += get_local_size(0)) {
        for (uint digit = 0; digit < DIGITS; digit++) {
            counters[AT(digit * workers + worker)] = 0;
        }
        const uint end = min(count, (worker + 1) * run);
        for (uint q = worker * run; q < end; q++) {
            counters[AT((data[AT(q)] >> shift & (DIGITS - 1)) * workers + worker)]++;
        }
    }
    barrier(CLK_LOCAL_MEM_FENCE);
}

/* Counters become the sums of those before: of DIGITS counters each, of DIGITS of these sums, and
 * from there down again. Behind the sums is room for theirs. */
static inline void sum_counters(__local ushort *counters, __local ushort *sums,
                                const uint workers) {
    __local ushort *const tops = sums + workers;
    for (uint i = get_local_id(0); i < workers; i += get_local_size(0)) {
        ushort sum = 0;
        for (uint j = 0; j < DIGITS; j++) {
            sum += counters[AT(i * DIGITS + j)];
        }
        sums[i] = sum;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint i = get_local_id(0); i < workers / DIGITS; i += get_local_size(0)) {
        ushort sum = 0;
        for (uint j = 0; j < DIGITS; j++) {
            sum += sums[i * DIGITS + j];
        }
        tops[i] = sum;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint i = get_local_id(0); i < workers; i += get_local_size(0)) {
        ushort sum = 0;
        for (uint j = 0; j < i / DIGITS; j++) {
            sum += tops[j];
        }
        for (uint j = i / DIGITS * DIGITS; j < i; j++) {
            sum += sums[j];
        }
        for (uint j = 0; j < DIGITS; j++) {
            const ushort own = counters[AT(i * DIGITS + j)];
            counters[AT(i * DIGITS + j)] = sum;
            sum += own;
        }
    }
    barrier(CLK_LOCAL_MEM_FENCE);
}

static inline void place_digits(__local const uint *from, __local uint *to,
                                __local ushort *counters, const uint workers, const uint count,
                                const uint shift) {
    const uint run = (count + workers - 1) / workers;
    for (uint worker = get_local_id(0); worker < workers; worker += get_local_size(0)) {
        const uint end = min(count, (worker + 1) * run);
        for (uint q = worker * run; q < end; q++) {
            const uint own = AT((from[AT(q)] >> shift & (DIGITS - 1)) * workers + worker);
            const uint place = counters[own]++;
            to[AT(place)] = from[AT(q)];
        }
    }
    barrier(CLK_LOCAL_MEM_FENCE);
}

/* Launch: (items of one group, tiles, sets).
 *
 *   data      local, twice AT(tile)
 *   counters  local, AT(DIGITS workers)
 *   tops      local, workers and a DIGITS-th of them
 */
__kernel void order_tiles(const order_numbers numbers, __global const ulong *restrict offsets,
                          __global const uint *restrict keys, __global const uint *restrict before,
                          __global uint *restrict tiles, __global uint *restrict firsts,
                          __local uint *data, __local ushort *counters, __local ushort *tops) {
    const uint set = get_group_id(2), tile = get_group_id(1), pitch = AT(numbers.tile);
    const size_t begin = offsets[set], end = offsets[set + 1];
    const size_t first = min(begin + tile * (size_t)numbers.tile, end);
    const uint count = (uint)min(end - first, (size_t)numbers.tile);
    for (uint q = get_local_id(0); q < count; q += get_local_size(0)) {
        const size_t at = numbers.is_first ? first + q : begin + before[first + q];
        const uint digit = keys[at] >> numbers.shift & ((1u << numbers.bits) - 1);
        data[AT(q)] = digit << ORDER_PLACE_BITS | q;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    uint from = 0; /* the half that has the keys */
    for (uint shift = ORDER_PLACE_BITS; shift < ORDER_PLACE_BITS + numbers.bits;
         shift += DIGIT_BITS) {
        count_digits(data + from, counters, numbers.workers, count, shift);
        sum_counters(counters, tops, numbers.workers);
        place_digits(data + from, data + (pitch - from), counters, numbers.workers, count, shift);
        from = pitch - from;
    }
    for (uint q = get_local_id(0); q < count; q += get_local_size(0)) {
        tiles[first + q] = data[from + AT(q)];
    }
    __global uint *const row = firsts + ((size_t)set * numbers.tiles + tile) * numbers.row;
    for (uint b = get_local_id(0); b < numbers.row; b += get_local_size(0)) {
        row[b] = count_below(data + from, count, b);
    }
}

/* ---- sums over tiles --------------------------------------------------------------------- */

/* The first tile of a segment; behind the last one all tiles. */
static inline uint first_tile(const order_numbers numbers, const uint segment) {
    const uint each = (numbers.tiles + ORDER_SEGMENTS - 1) / ORDER_SEGMENTS;
    return min(numbers.tiles, segment * each);
}

/* Launch of both: (row, ORDER_SEGMENTS, sets), the row rounded up at will. */
__kernel void order_segments(const order_numbers numbers, __global const uint *restrict firsts,
                             __global uint *restrict sums) {
    const uint b = get_global_id(0), segment = get_global_id(1), set = get_global_id(2);
    const uint end = first_tile(numbers, segment + 1);
    if (b >= numbers.row) {
        return;
    }
    uint sum = 0;
    for (uint tile = first_tile(numbers, segment); tile < end; tile++) {
        sum += firsts[((size_t)set * numbers.tiles + tile) * numbers.row + b];
    }
    sums[((size_t)set * ORDER_SEGMENTS + segment) * numbers.row + b] = sum;
}

__kernel void order_sums(const order_numbers numbers, __global const uint *restrict sums,
                         __global uint *restrict firsts) {
    const uint b = get_global_id(0), segment = get_global_id(1), set = get_global_id(2);
    const uint end = first_tile(numbers, segment + 1);
    if (b >= numbers.row) {
        return;
    }
    uint sum = 0;
    for (uint before = 0; before < segment; before++) {
        sum += sums[((size_t)set * ORDER_SEGMENTS + before) * numbers.row + b];
    }
    for (uint tile = first_tile(numbers, segment); tile < end; tile++) {
        __global uint *const first =
            firsts + ((size_t)set * numbers.tiles + tile) * numbers.row + b;
        sum += *first;
        *first = sum;
    }
}

/* ---- places ------------------------------------------------------------------------------ */

/* Where digit b of a tile begins in the set, less where it begins in the tile: behind all smaller
 * digits, and behind b in the tiles in front of it. Numbers wrap around, the result does not. */
static inline uint shift_of(__global const uint *sums, const order_numbers numbers, const uint tile,
                            const uint b) {
    const size_t row = numbers.row;
    const uint smaller = sums[(numbers.tiles - 1) * row + b];
    const uint to_next = tile > 0 ? sums[(tile - 1) * row + b + 1] : 0;
    return smaller + to_next - sums[tile * row + b];
}

/* Launch: (points of the largest set, rounded up at will, 1, sets). after: [point] */
__kernel void order_scatter(const order_numbers numbers, __global const ulong *restrict offsets,
                            __global const uint *restrict before,
                            __global const uint *restrict tiles, __global const uint *restrict sums,
                            __global uint *restrict after) {
    const uint set = get_global_id(2), i = get_global_id(0);
    const size_t begin = offsets[set];
    if (i >= offsets[set + 1] - begin) {
        return;
    }
    const uint tile = i / numbers.tile, first = tile * numbers.tile;
    const uint own = tiles[begin + i], source = first + (own & ((1u << ORDER_PLACE_BITS) - 1));
    const uint shift = shift_of(sums + (size_t)set * numbers.tiles * numbers.row, numbers, tile,
                                own >> ORDER_PLACE_BITS);
    after[begin + (uint)(shift + (i - first))] = numbers.is_first ? source : before[begin + source];
}

/* Launch: (row, rounded up at will, 1, sets). */
__kernel void order_starts(const uint row, __global const ulong *restrict offsets,
                           __global const uint *restrict keys, __global const uint *restrict order,
                           __global uint *restrict starts) {
    const uint set = get_global_id(2), key = get_global_id(0);
    const size_t begin = offsets[set];
    if (key >= row) {
        return;
    }
    uint low = 0, high = (uint)(offsets[set + 1] - begin);
    while (low < high) {
        const uint middle = low + (high - low) / 2;
        if (keys[begin + order[begin + middle]] < key) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    starts[(size_t)set * row + key] = low;
}

/* Launch: (places of the largest set, rounded up at will, 1, sets).
 *
 *   points, weights  [point][DIMENSION], [point]; all weights are 1 without has_weights
 *   places, sorted, heights  of nufft/sort.cl; the offsets for the sphere, whose places have no unit
 *   mask             of the bits of an order that are the place
 */
__kernel void order_move(const uint mask, const uint has_weights,
                         __global const ulong *restrict offsets,
                         __global const ulong *restrict places, __global const uint *restrict order,
                         __global const ulong *restrict points,
                         __global const real *restrict weights, __global ulong *restrict sorted,
                         __global real *restrict heights) {
    const uint set = get_global_id(2), i = get_global_id(0);
    const size_t begin = offsets[set], to = places[set] + i;
    const uint count = (uint)(offsets[set + 1] - begin);
    if (to >= places[set + 1]) {
        return;
    }
    const size_t from = begin + (order[begin + min(i, count - 1)] & mask);
#pragma unroll
    for (uint axis = 0; axis < DIMENSION; axis++) {
        sorted[to * DIMENSION + axis] = points[from * DIMENSION + axis];
    }
    heights[to] = i >= count ? 0 : has_weights ? weights[from] : 1;
}
