/* Sums over realizations of every frequency's power and of its square.
 *
 * One work-item owns LANES slots and walks through the realizations of the batch in order, so the
 * result does not depend on how realizations were cut into batches. Launch: (stride / LANES),
 * rounded up at will.
 *
 *   power  [realization][stride]
 *   state  [sum high, sum low, square sum high, square sum low][stride], continued
 */
#include "shared/real.h"
#include "shared/pair.h"

__kernel void accumulate_modes(__global const real *restrict power, __global real *restrict state,
                               const uint num_realizations, const ulong stride) {
    const size_t i = get_global_id(0);
    if (i >= stride / LANES) {
        return;
    }
    realv sum = LOADV(i, state), sum_low = LOADV(i, state + stride);
    realv square = LOADV(i, state + 2 * stride), square_low = LOADV(i, state + 3 * stride);
    for (uint r = 0; r < num_realizations; r++) {
        const realv p = LOADV(i, power + r * stride);
        pair_add(&sum, &sum_low, p);
        pair_add_square(&square, &square_low, p);
    }
    STOREV(sum, i, state);
    STOREV(sum_low, i, state + stride);
    STOREV(square, i, state + 2 * stride);
    STOREV(square_low, i, state + 3 * stride);
}
