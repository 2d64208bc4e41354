/* Sums of powers in one pass over the rows: over realizations for every frequency, and over bins
 * (rings, shells) for every realization. Launch: (work-items of one group, blocks, groups of
 * at_once realizations), which are one where there are frequencies.
 *
 * A block is BLOCK slots of a row. A work-group walks through its realizations in order, LANES at a
 * time. Frequencies are lanes at first and are added to the state, in the order
 * of accumulate/sums.h. The square of LANES realizations and LANES slots is turned, so that
 * realizations are lanes, and goes to local memory, where the members of each bin are added up: a
 * piece of the bin, which accumulate/fold.cl puts together. Every sum has a fixed order, so results
 * do not depend on work-group sizes or on the batch.
 *
 *   numbers  of accumulate/blocks.h; their names are used here
 *   power    [realization][stride]
 *   blocks   [block + 1]: first ring of every block
 *   rings    members of one bin in one block, and the piece that they make
 *   members  slots within their block
 *   sums     [group of LANES realizations][piece][high, low][LANES]
 *   sum, sum_low, square, square_low
 *            [1 + level][stride] each, continued: the open block, and behind it whole ones; the
 *            last two are not touched without SQUARES
 *   block    local, [BLOCK][LANES]
 */
#include "accumulate/blocks.h"
#include "accumulate/rows.h"
#include "accumulate/state.h"
#include "shared/lanes.h"
#include "shared/transpose.h"

/* Kernels of the same program (docs/developer/decisions.md). */
#include "accumulate/fold.cl"
#include "accumulate/weighted.cl"

typedef struct ring {
    uint first, end; /* members */
    uint piece;
} ring;

/* Realizations first .. end - 1 of them, all of one block. */
static inline void add_to_open(const state sums, const size_t slot, const realv *powers,
                               const ulong stride, const uint first, const uint end) {
    block_sums block;
    if ((sums.done + first) % SUM_BLOCK > 0) {
        block = load_sums(sums, slot);
    } else {
        block.sum = block.sum_low = block.square = block.square_low = 0;
    }
#pragma unroll
    for (uint i = 0; i < LANES; i++) {
        if (i >= first && i < end) {
            add_to_block(&block, powers[i]);
        }
    }
    if ((sums.done + end) % SUM_BLOCK == 0) {
        carry(sums, slot, stride, (sums.done + end) / SUM_BLOCK - 1, block);
    } else {
        store_sums(sums, slot, block);
    }
}

/* The first `count` of LANES realizations; they are of two blocks at most. */
static inline void add_to_state(const state sums, const size_t slot, const realv *powers,
                                const ulong stride, const uint count) {
    const uint left = SUM_BLOCK - (uint)(sums.done % SUM_BLOCK);
    const uint end = min(count, left);
    add_to_open(sums, slot, powers, stride, 0, end);
    if (end < count) {
        add_to_open(sums, slot, powers, stride, end, count);
    }
}

/* LANES realizations of a block that begins at first_slot. */
static inline void load_block(__local real *block, __global const real *rows, const state sums,
                              const ulong stride, const size_t first_slot, const uint num_slots,
                              const uint count) {
    for (uint i = get_local_id(0); i < num_slots / LANES; i += get_local_size(0)) {
        const size_t slot = first_slot + i * LANES;
        realv powers[LANES];
        load_rows(powers, rows + slot, stride, count);
        if (sums.sum != 0) {
            add_to_state(sums, slot, powers, stride, count);
        }
        transpose(powers);
#pragma unroll
        for (uint lane = 0; lane < LANES; lane++) {
            store_local(block, i * LANES + lane, powers[lane]);
        }
    }
}

static inline void add_rings(__global real *sums, __local const real *block,
                             __global const ring *rings, __global const ushort *members,
                             const uint first_ring, const uint end_ring) {
    for (uint i = first_ring + get_local_id(0); i < end_ring; i += get_local_size(0)) {
        const ring own = rings[i];
        realv high = 0, low = 0;
        for (uint member = own.first; member < own.end; member++) {
            pair_add(&high, &low, load_local(block, members[member]));
        }
        store_global(sums, 2 * (size_t)own.piece, high);
        store_global(sums, 2 * (size_t)own.piece + 1, low);
    }
}

static inline void add_block(const blocks_numbers numbers, __global const real *power,
                             __global const uint *blocks, __global const ring *rings,
                             __global const ushort *members, __global real *sums, state frequencies,
                             __local real *block) {
    const uint begin = (uint)get_global_id(2) * numbers.at_once;
    const uint end = min(begin + numbers.at_once, numbers.num_realizations);
    const ulong stride = numbers.stride, num_pieces = numbers.num_pieces;
    const size_t index = get_global_id(1), first_slot = index * BLOCK;
    const uint num_slots = (uint)min((ulong)BLOCK, stride - first_slot);
    for (uint first = begin; first < end; first += LANES) {
        load_block(block, power + first * stride, frequencies, stride, first_slot, num_slots,
                   min((uint)LANES, end - first));
        barrier(CLK_LOCAL_MEM_FENCE);
        add_rings(sums + first * num_pieces * 2, block, rings, members, blocks[index],
                  blocks[index + 1]);
        barrier(CLK_LOCAL_MEM_FENCE);
        frequencies.done += LANES;
    }
}

__kernel void accumulate_bins(const blocks_numbers numbers, __global const real *restrict power,
                              __global const uint *restrict blocks,
                              __global const ring *restrict rings,
                              __global const ushort *restrict members, __global real *restrict sums,
                              __local real *block) {
    const state none = {0, 0, 0, 0, 0};
    add_block(numbers, power, blocks, rings, members, sums, none, block);
}

__kernel void accumulate_bins_and_frequencies(
    const blocks_numbers numbers, __global const real *restrict power,
    __global const uint *restrict blocks, __global const ring *restrict rings,
    __global const ushort *restrict members, __global real *restrict sums, __global real *sum,
    __global real *sum_low, __global real *square, __global real *square_low, __local real *block) {
    const state frequencies = {sum, sum_low, square, square_low, numbers.done};
    add_block(numbers, power, blocks, rings, members, sums, frequencies, block);
}
