/* Where windows begin on an axis of a fine grid, as kernels/nufft/cells.h has it, in all bits. */
#ifndef TEST_WINDOW_CELLS_H
#define TEST_WINDOW_CELLS_H

#include "harness.h"

#include "engines/nufft/axis.h"

__extension__ typedef unsigned __int128 wide;

/* The first of the cells that the window of x covers, and where it stands between cells. */
static inline uint32_t first_cell(const ps_nufft_axis *axis, uint64_t x, double *fraction) {
    const wide half = (wide)1 << 63;
    const wide y = (wide)x * axis->n + half * (2 * (wide)axis->n + 2 - axis->window.width);
    *fraction = (double)(uint64_t)y * 0x1p-64;
    return (uint32_t)(y >> 64) % axis->n;
}

/* The least x whose window begins in the cell. */
static inline uint64_t first_in_cell(const ps_nufft_axis *axis, uint32_t cell) {
    const wide half = (wide)1 << 63;
    const wide y = half * (2 * ((wide)cell + axis->n) + axis->window.width - 2);
    return (uint64_t)((y + axis->n - 1) / axis->n); /* what is above 1 falls off */
}

static inline uint64_t random_u64(uint64_t *seed) {
    const uint64_t high = (uint64_t)(test_uniform(seed) * 0x1p32);
    return high << 32 | (uint64_t)(test_uniform(seed) * 0x1p32);
}

#endif
