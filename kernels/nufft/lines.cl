/* From lines of real numbers (nufft/line.h) to powers at frequency 0 of axis 0. Lanes are
 * realizations here, in real parts; imaginary parts are 0, so that nothing depends on which
 * realizations are done together. What is real in space has the same power at opposite frequencies:
 * of the last axis 0 .. K are kept.
 *
 *   numbers    line_numbers of nufft/numbers.h
 *   lines      [realization][row][n]; one row where one axis has a transform
 *   radices, twiddles, position, gains  of nufft/transform/finish.h; last_gains [last_K + 1]
 *   scales     [realization]
 *   power      [realization][stride], there from first_power on [0 .. last_K][-K .. K], where one
 *              axis has a transform [0 .. K]
 *   grid       [group of LANES realizations][0 .. K of the last axis][row][re, im][LANES]
 *   row        local, [n][re, im][LANES]
 */
#include "nufft/transform/finish.h"
#include "nufft/numbers.h"

/* num lines, the others 0. apart: numbers from one line to the next */
static inline void load_lines(__local real *row, __global const real *from, const size_t apart,
                              const uint num, const uint n) {
    for (uint i = get_local_id(0); i < n; i += get_local_size(0)) {
        real cell[LANES];
        for (uint lane = 0; lane < LANES; lane++) {
            cell[lane] = lane < num ? from[lane * apart + i] : 0;
        }
        store_complex(row, i, (complexv){LOADV(0, cell), (realv)0});
    }
    barrier(CLK_LOCAL_MEM_FENCE);
}

/* Powers of num lanes, each to its row of powers, `stride` numbers apart. */
static inline void put_powers(const complexv z, const real gain, __global const real *scales,
                              const uint num, __global real *power, const size_t stride) {
    union {
        realv together;
        real x[LANES];
    } of = {fma(z.re, z.re, z.im * z.im)};
    for (uint lane = 0; lane < num; lane++) {
        power[lane * stride] = of.x[lane] * (gain * scales[lane]);
    }
}

static inline uint lanes_of_group(const line_numbers numbers, const uint group) {
    return min((uint)LANES, numbers.num_realizations - group * LANES);
}

/* Launch: (work-items of one group, groups of LANES realizations). */
__kernel void nufft_line_powers(const line_numbers numbers, __global const real *restrict lines,
                                __global const uint *restrict radices,
                                __global const real *restrict twiddles,
                                __global const uint *restrict position,
                                __global const real *restrict gains,
                                __global const real *restrict scales, __global real *restrict power,
                                __local real *row) {
    const uint n = numbers.transform.n, K = numbers.transform.K;
    const uint group = get_global_id(1), num = lanes_of_group(numbers, group);
    const size_t first_row = numbers.first_row + group * LANES;
    load_lines(row, lines + (size_t)group * LANES * n, n, num, n);
    fft_transform(row, 2 * LANES, n, radices, twiddles);
    for (uint q = get_local_id(0); q <= K; q += get_local_size(0)) {
        put_powers(load_complex(row, position[q]), gains[q], scales + first_row, num,
                   power + first_row * numbers.stride + numbers.first_power + q, numbers.stride);
    }
}

/* Launch: (work-items of one group, groups of LANES realizations * rows). */
__kernel void nufft_line_rows(const line_numbers numbers, __global const real *restrict lines,
                              __global const uint *restrict radices,
                              __global const real *restrict twiddles,
                              __global const uint *restrict position, __global real *restrict grid,
                              const uint num_rows, __local real *row) {
    const uint n = numbers.transform.n, K = numbers.transform.K;
    const uint group = get_global_id(1) / num_rows, m = get_global_id(1) % num_rows;
    const size_t apart = (size_t)num_rows * n;
    load_lines(row, lines + group * LANES * apart + m * n, apart, lanes_of_group(numbers, group),
               n);
    fft_transform(row, 2 * LANES, n, radices, twiddles);
    __global real *to = grid + ((size_t)group * (K + 1) * num_rows + m) * 2 * LANES;
    for (uint q = get_local_id(0); q <= K; q += get_local_size(0)) {
        store_global_complex(to, (size_t)q * num_rows, load_complex(row, position[q]));
    }
}

/* Launch: (work-items of one group, groups of LANES realizations * (last_K + 1)). transform: of the
 * axis across rows. */
__kernel void
nufft_line_columns(const line_numbers numbers, __global const real *restrict grid,
                   __global const uint *restrict radices, __global const real *restrict twiddles,
                   __global const uint *restrict position, __global const real *restrict gains,
                   __global const real *restrict last_gains, __global const real *restrict scales,
                   __global real *restrict power, const uint last_K, __local real *row) {
    const uint n = numbers.transform.n, K = numbers.transform.K;
    const uint group = get_global_id(1) / (last_K + 1), q = get_global_id(1) % (last_K + 1);
    const size_t first_row = numbers.first_row + group * LANES;
    const transform_axis axis = {radices, twiddles, position, gains, n, K};
    load_row(row, grid, get_global_id(1), n);
    fft_transform(row, 2 * LANES, n, radices, twiddles);
    for (uint i = get_local_id(0); i < 2 * K + 1; i += get_local_size(0)) {
        const real gain = gains[i >= K ? i - K : K - i] * last_gains[q];
        put_powers(kept_frequency(row, axis, i), gain, scales + first_row,
                   lanes_of_group(numbers, group),
                   power + first_row * numbers.stride + numbers.first_power + q * (2 * K + 1) + i,
                   numbers.stride);
    }
}
