/* A pass of transforms of lines: read, transformed (stockham.h) and left. Before it stand
 *
 *   line_data     a type for what lines are read from and left in
 *   load_number   (const line_data *, line, i): number i of a line, in front of its transform
 *   store_number  (const line_data *, line, q, z): result q behind it
 *
 * Device only.
 */
#ifndef PS_NUFFT_GRID_LINE_PASS_H
#define PS_NUFFT_GRID_LINE_PASS_H

#include "nufft/grid/stockham.h"

/* The group's LINES lines from first_line on, of num_lines. */
static inline void pass_lines(const line_data *data, const size_t first_line,
                              const size_t num_lines, __global const real *roots,
                              __local real *lines) {
    held x;
#pragma unroll
    for (int round = 0; round < ROUNDS(RADIX_0); round++) {
        const uint job = get_local_id(0) + round * ITEMS, t = place_of_job(job, RADIX_0);
        const size_t line = min(first_line + line_of_job(job, RADIX_0), num_lines - 1);
        if (job < JOBS(RADIX_0)) {
#pragma unroll
            for (int i = 0; i < RADIX_0; i++) {
                const complexv z = load_number(data, line, t + i * (N / RADIX_0));
                x.re[round * RADIX_0 + i] = z.re;
                x.im[round * RADIX_0 + i] = z.im;
            }
        }
    }
    transform_lines(&x, lines, roots);
#pragma unroll
    for (int round = 0; round < ROUNDS(LAST_RADIX); round++) {
        const uint job = get_local_id(0) + round * ITEMS, t = place_of_job(job, LAST_RADIX);
        const size_t line = first_line + line_of_job(job, LAST_RADIX);
        if (job < JOBS(LAST_RADIX) && line < num_lines) {
#pragma unroll
            for (int i = 0; i < LAST_RADIX; i++) {
                const uint held = round * LAST_RADIX + i;
                store_number(data, line, result_of(t, i, LAST_RADIX, BEFORE_LAST),
                             (complexv){x.re[held], x.im[held]});
            }
        }
    }
}

#endif
