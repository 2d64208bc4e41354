/* Phases of one point per work-item for LANES frequencies, so that the device can be compared with
 * the same text compiled as C (tests/kernels/shared_cases.h). Launch: (points), rounded up at will.
 *
 *   points       [num][DIMENSION] fixed point
 *   frequencies  [DIMENSION][LANES] two's complement words
 *   phases       [num][LANES]
 */
#include "shared/real.h"
#include "torus/layout.h"
#include "torus/phase.h"

__kernel void probe_phase(__global const ulong *restrict points,
                          __global const word *restrict frequencies, __global word *restrict phases,
                          const ulong num) {
    const size_t i = get_global_id(0);
    if (i >= num) {
        return;
    }
    wordv k[DIMENSION];
    realv k_real[DIMENSION];
    for (int axis = 0; axis < DIMENSION; axis++) {
        k[axis] = LOADV(axis, frequencies);
        k_real[axis] = TO_REALV(AS_SWORDV(k[axis]));
    }
    STOREV(phase_of_point(k, k_real, points + i * DIMENSION, 0, DIMENSION), i, phases);
}
