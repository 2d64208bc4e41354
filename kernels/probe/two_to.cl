/* Maps two_to over an array, so that the device can be compared with the same text compiled as C
 * (tests/kernels/shared_cases.h). Launch: (num / LANES), rounded up at will.
 *
 *   exponents, powers   [num], num a multiple of LANES
 */
#include "shared/real.h"
#include "shared/two_to.h"

__kernel void probe_two_to(__global const real *restrict exponents, __global real *restrict powers,
                           const ulong num) {
    const size_t i = get_global_id(0);
    if (i < num / LANES) {
        STOREV(two_to(LOADV(i, exponents)), i, powers);
    }
}
