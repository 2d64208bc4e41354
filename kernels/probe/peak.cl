/* The device's peak of fused multiply-adds: 16 independent chains of LANES numbers per work-item,
 * long enough to hide latency. Launch: (any); result keeps the compiler from dropping the work.
 */
#include "shared/real.h"

#ifndef STEPS
#define STEPS 4096
#endif

__kernel void probe_peak(__global real *restrict result, const uint seed) {
    const realv factor = (realv)((real)1 - (real)1e-6);
    const realv offset = (realv)((real)seed * (real)1e-6);
    realv chain[16];
#pragma unroll
    for (int i = 0; i < 16; i++) {
        chain[i] = (realv)((real)(get_global_id(0) + (size_t)i));
    }
    for (int step = 0; step < STEPS; step++) {
#pragma unroll
        for (int i = 0; i < 16; i++) {
            chain[i] = fma(chain[i], factor, offset);
        }
    }
    realv sum = (realv)0;
#pragma unroll
    for (int i = 0; i < 16; i++) {
        sum += chain[i];
    }
    STOREV(sum, get_global_id(0), result);
}
