/* Transforms alone: one work-group for each LANES of them, so that tests can look at
 * nufft/transform/fft.h.
 * Launch: (work-items of one group, groups).
 *
 *   data    [group][length][re, im][LANES]
 *   result  [group][frequency][re, im][LANES]
 *   radices, twiddles, position  of host/engines/nufft/fft.c
 *   row     local, [length][re, im][LANES]
 */
#include "nufft/transform/fft.h"

__kernel void probe_fft(__global const real *restrict data, __global real *restrict result,
                        const uint length, __global const uint *restrict radices,
                        __global const real *restrict twiddles,
                        __global const uint *restrict position, __local real *row) {
    const size_t first = get_global_id(1) * length * (size_t)(2 * LANES);
    for (uint i = get_local_id(0); i < length; i += get_local_size(0)) {
        store_complex(row, i, load_global_complex(data + first, i));
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    fft_transform(row, 2 * LANES, length, radices, twiddles);
    for (uint k = get_local_id(0); k < length; k += get_local_size(0)) {
        store_global_complex(result + first, k, load_complex(row, position[k]));
    }
}
