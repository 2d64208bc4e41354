/* From moments of the bins of a histogram to weights of their Chebyshev nodes:
 *
 *     W_j = sum_k (2 - [k = 0]) / MOMENTS T_k(x_j) M_k,   x_j = cos(pi (j + 1/2) / MOMENTS)
 *
 * so that sum_j W_j f(x_j) is the sum over pairs of the polynomial that agrees with f at the nodes.
 *
 * One work-item owns a bin of one realization. Launch: (bins of both sides, realizations), bins
 * rounded up at will; no local memory.
 *
 *   moments  [realization][high, low][bin][MOMENTS]
 *   matrix   [j][k]
 *   weights  [realization][capacity]: node j of bin b at b MOMENTS + j; what is behind the last bin is cleared
 */
#include "shared/real.h"

#define MOMENTS 8

__kernel void pairs_nodes(__global const real *restrict moments,
                          __global const real *restrict matrix, __global real *restrict weights,
                          const ulong num_bins, const ulong capacity) {
    const size_t bin = get_global_id(0);
    const size_t realization = get_global_id(1);
    if (bin * MOMENTS >= capacity) {
        return;
    }
    __global const real *high = moments + realization * 2 * num_bins * MOMENTS + bin * MOMENTS;
    __global const real *low = high + num_bins * MOMENTS;
    __global real *to = weights + realization * capacity + bin * MOMENTS;
    for (int j = 0; j < MOMENTS; j++) {
        real sum = 0;
        for (int k = 0; k < MOMENTS && bin < num_bins; k++) {
            sum = fma(matrix[j * MOMENTS + k], high[k] + low[k], sum);
        }
        to[j] = sum;
    }
}
