/* Maps turn_cosine_sine over an array, so that the device can be compared with the same text
 * compiled as C (tests/kernels/shared_cases.h). Launch: (num / LANES), rounded up at will.
 *
 *   words          [num] fractions of a turn, num a multiple of LANES
 *   cosine, sine   [num]
 */
#include "shared/real.h"
#include "shared/turn.h"

__kernel void probe_turn(__global const word *restrict words, __global real *restrict cosine,
                         __global real *restrict sine, const ulong num) {
    const size_t i = get_global_id(0);
    if (i >= num / LANES) {
        return;
    }
    realv c, s;
    turn_cosine_sine(LOADV(i, words), &c, &s);
    STOREV(c, i, cosine);
    STOREV(s, i, sine);
}
