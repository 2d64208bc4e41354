/* From the sums of nufft/grid/lines.cl to values on rings, on GPUs. S(m, k) = sum over points of
 * w exp(-i (m phi + k theta)), so that with Lambda_lm = sum_k a_k exp(i k theta)
 *
 *     c_lm = sum_k a_k S(m, -k) = 1 / rings sum_i Lambda_lm(theta_i) sum_k S(m, k) exp(i k theta_i),
 *
 * theta_i = 2 pi i / rings, rings > 2L. Rings behind the poles are those in front of them times the
 * parity of m, and Lambda_lm has the parity of l - m under north <-> south: what counts is
 *
 *     sum over k of one parity of U(k) exp(i k theta_i),   U(k) = S(m, k) + (-1)^m S(m, -k),
 *
 * which is a transform of half the length, on the rings of the northern quarter. Even k make the
 * values of even l - m for even orders and of odd l - m for odd ones, odd k the rest; even degrees
 * need even k alone. Launch: (ITEMS, groups of LINES lines, sets); a line is an order and a parity
 * of k.
 *
 *   numbers  ring_lines_numbers of numbers.h
 *   sums     [set][m + L][k = 0 .. L] complex
 *   roots    [N][cosine, sine] of -2 pi i / N, N = rings / 2
 *   turns    [num_rings][cosine, sine] of -2 pi i / rings
 *   values   [order][set][even, odd l - m][ring_pitch][re, im], sets from first_value on
 *   lines    local, [LINES][LINE_REALS]
 */
#define LANES 1
#include "nufft/grid/stockham.h"
#include "sphere/nufft/numbers.h"

typedef struct line_data {
    const ring_lines_numbers *numbers;
    __global const real *sums, *turns;
    __global real *values;
} line_data;

static inline uint order_of(const line_data *all, const size_t line) {
    return (uint)line / (all->numbers->only_even != 0 ? 1 : 2);
}

static inline uint parity_of(const line_data *all, const size_t line) {
    return all->numbers->only_even != 0 ? 0 : (uint)line % 2;
}

static inline complexv load_number(const line_data *all, const size_t line, const uint i) {
    const uint L = all->numbers->L, m = order_of(all, line), parity = parity_of(all, line);
    const bool is_above = 2 * i + parity <= L;
    const uint k = is_above ? 2 * i + parity : 2 * (N - i) - parity; /* its size */
    const real sign = m % 2 == 0 ? 1 : -1, of_below = is_above ? 1 : sign;
    if (k > L) {
        return (complexv){0, 0};
    }
    __global const real *const here = all->sums + 2 * ((L + m) * (size_t)(L + 1) + k);
    __global const real *const mirrored = all->sums + 2 * ((L - m) * (size_t)(L + 1) + k);
    return (complexv){of_below * fma(sign, mirrored[0], here[0]),
                      of_below * fma(-sign, mirrored[1], here[1])};
}

/* A ring counts twice, once where it is its own mirror image. */
static inline void store_number(const line_data *all, const size_t line, const uint i,
                                const complexv z) {
    const ring_lines_numbers *numbers = all->numbers;
    const uint m = order_of(all, line), parity = parity_of(all, line);
    if (i >= numbers->num_rings) {
        return;
    }
    const real weight = (i == 0 || 2 * i == N ? 1 : 2) * (m % 2 == 0 ? 1 : -1) / (real)(2 * N);
    const complexv value =
        parity == 0 ? z : complex_multiply(z, all->turns[2 * i], all->turns[2 * i + 1]);
    __global real *const to = all->values + m * numbers->order_apart +
                              2 * ((size_t)((m + parity) % 2) * numbers->ring_pitch + i);
    to[0] = value.re * weight;
    to[1] = value.im * weight;
}

#include "nufft/grid/line_pass.h"

__kernel void sphere_ring_lines(const ring_lines_numbers numbers,
                                __global const real *restrict sums,
                                __global const real *restrict roots,
                                __global const real *restrict turns, __global real *restrict values,
                                __local real *lines) {
    const size_t set = get_global_id(2), L = numbers.L;
    const line_data all = {&numbers, sums + set * 2 * (2 * L + 1) * (L + 1), turns,
                           values + (numbers.first_value + set) * 4 * (size_t)numbers.ring_pitch};
    pass_lines(&all, get_global_id(1) * LINES, numbers.num_lines, roots, lines);
}
