/* Sums of powers in one pass over the rows: over realizations for every frequency, and over bins (rings,
 * shells) for every realization. Launch: (work-items of one group, blocks).
 *
 * A block is BLOCK slots of a row. A work-group walks through the realizations of the batch in order,
 * LANES at a time. Frequencies are lanes at first and are added to the state. The square of LANES
 * realizations and LANES slots is turned, so that realizations are lanes, and goes to local memory, where
 * the members of each bin are added up: a piece of the bin, which accumulate/fold.cl puts together.
 * Every sum has a fixed order, so results do not depend on work-group sizes or on the batch.
 *
 *   power    [realization][stride], stride a multiple of LANES
 *   blocks   [block + 1]: first ring of every block
 *   rings    members of one bin in one block, and the piece that they make
 *   members  slots within their block
 *   sums     [group of LANES realizations][piece][high, low][LANES]
 *   state    [sum high, sum low, square sum high, square sum low][stride], continued; the first two rows
 *            alone without SQUARES
 *   block    local, [BLOCK][LANES]
 */
#include "shared/lanes.h"
#include "shared/pair.h"
#include "shared/transpose.h"

/* Fixed: sums depend on it. Long enough that pieces are few, short enough for the local memory of any
 * device and for the nearest cache of a core. host/analysis/accumulate_device.c knows it too. */
#define BLOCK 512

/* 0: sums alone, nobody asks for standard errors of frequencies. */
#ifndef SQUARES
#define SQUARES 1
#endif

typedef struct ring {
    uint first, end; /* members */
    uint piece;
} ring;

/* The first `count` of LANES realizations; the others are left out of the state and are 0 in bins. */
static inline void load_rows(realv *powers, __global const real *rows, const ulong stride,
                             const uint count) {
#pragma unroll
    for (uint i = 0; i < LANES; i++) {
        powers[i] = i < count ? load_global(rows + i * stride, 0) : (realv)0;
    }
}

static inline void add_to_state(__global real *state, const ulong stride, const realv *powers,
                                const uint count) {
    realv sum = load_global(state, 0), sum_low = load_global(state + stride, 0);
#if SQUARES
    realv square = load_global(state + 2 * stride, 0);
    realv square_low = load_global(state + 3 * stride, 0);
#endif
#pragma unroll
    for (uint i = 0; i < LANES; i++) {
        if (i < count) {
            pair_add(&sum, &sum_low, powers[i]);
#if SQUARES
            pair_add_square(&square, &square_low, powers[i]);
#endif
        }
    }
    store_global(state, 0, sum);
    store_global(state + stride, 0, sum_low);
#if SQUARES
    store_global(state + 2 * stride, 0, square);
    store_global(state + 3 * stride, 0, square_low);
#endif
}

/* LANES realizations of a block: rows begin at its first slot, and so does the state, if any. */
static inline void load_block(__local real *block, __global const real *rows, __global real *state,
                              const ulong stride, const uint num_slots, const uint count) {
    for (uint i = get_local_id(0); i < num_slots / LANES; i += get_local_size(0)) {
        realv powers[LANES];
        load_rows(powers, rows + i * LANES, stride, count);
        if (state != 0) {
            add_to_state(state + i * LANES, stride, powers, count);
        }
        transpose(powers);
#pragma unroll
        for (uint slot = 0; slot < LANES; slot++) {
            store_local(block, i * LANES + slot, powers[slot]);
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

/* state 0: nobody asks for frequencies. */
static inline void add_block(__global const real *power, const uint num_realizations,
                             const ulong stride, __global const uint *blocks,
                             __global const ring *rings, __global const ushort *members,
                             __global real *sums, const ulong num_pieces, __global real *state,
                             __local real *block) {
    const size_t index = get_global_id(1), first_slot = index * BLOCK;
    const uint num_slots = (uint)min((ulong)BLOCK, stride - first_slot);
    for (uint first = 0; first < num_realizations; first += LANES) {
        load_block(block, power + first * stride + first_slot, state != 0 ? state + first_slot : 0,
                   stride, num_slots, min((uint)LANES, num_realizations - first));
        barrier(CLK_LOCAL_MEM_FENCE);
        add_rings(sums + first * num_pieces * 2, block, rings, members, blocks[index],
                  blocks[index + 1]);
        barrier(CLK_LOCAL_MEM_FENCE);
    }
}

__kernel void accumulate_bins(__global const real *restrict power, const uint num_realizations,
                              const ulong stride, __global const uint *restrict blocks,
                              __global const ring *restrict rings,
                              __global const ushort *restrict members, __global real *restrict sums,
                              const ulong num_pieces, __local real *block) {
    add_block(power, num_realizations, stride, blocks, rings, members, sums, num_pieces, 0, block);
}

__kernel void accumulate_bins_and_frequencies(__global const real *restrict power,
                                              const uint num_realizations, const ulong stride,
                                              __global const uint *restrict blocks,
                                              __global const ring *restrict rings,
                                              __global const ushort *restrict members,
                                              __global real *restrict sums, const ulong num_pieces,
                                              __global real *restrict state, __local real *block) {
    add_block(power, num_realizations, stride, blocks, rings, members, sums, num_pieces, state,
              block);
}
