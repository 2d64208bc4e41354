/* Sums of a realization's powers over bins (rings, shells), for LANES realizations side by side.
 *
 * Two launches: pieces of at most a fixed number of frequencies first, then the pieces of a bin in
 * order, so that the result does not depend on work-group sizes or on the batch.
 *
 * The first extent of a launch is rounded up at will.
 *
 *   power    [realization][stride], rows padded to a multiple of LANES realizations
 *   members  slots of the power, bin by bin
 *   pieces   [piece]: first member, one past the last
 */
#include "shared/real.h"
#include "shared/pair.h"

/* Launch: (pieces, groups of LANES realizations). sums: [group][piece][high, low][LANES] */
__kernel void accumulate_bin_pieces(__global const real *restrict power,
                                    __global const uint *restrict members,
                                    __global const uint2 *restrict pieces,
                                    __global real *restrict sums, const ulong num_pieces,
                                    const ulong stride) {
    const size_t piece = get_global_id(0);
    const size_t group = get_global_id(1);
    if (piece >= num_pieces) {
        return;
    }
    __global const real *rows = power + group * LANES * stride;
    realv high = 0, low = 0;
    for (uint i = pieces[piece].x; i < pieces[piece].y; i++) {
        real column[LANES];
        for (int lane = 0; lane < LANES; lane++) {
            column[lane] = rows[lane * stride + members[i]];
        }
        pair_add(&high, &low, LOADV(0, column));
    }
    __global real *out = sums + (group * num_pieces + piece) * 2 * LANES;
    STOREV(high, 0, out);
    STOREV(low, 1, out);
}

/* Launch: (bins, groups). bins: [bin]: first piece, one past the last.
 * result: [group][bin][high, low][LANES] */
__kernel void accumulate_bin_fold(__global const real *restrict sums,
                                  __global const uint2 *restrict bins,
                                  __global real *restrict result, const ulong num_bins,
                                  const ulong num_pieces) {
    const size_t bin = get_global_id(0);
    const size_t group = get_global_id(1);
    if (bin >= num_bins) {
        return;
    }
    realv high = 0, low = 0;
    for (uint piece = bins[bin].x; piece < bins[bin].y; piece++) {
        __global const real *sum = sums + (group * num_pieces + piece) * 2 * LANES;
        pair_add(&high, &low, LOADV(0, sum));
        low += LOADV(1, sum);
    }
    __global real *out = result + (group * num_bins + bin) * 2 * LANES;
    STOREV(high, 0, out);
    STOREV(low, 1, out);
}
