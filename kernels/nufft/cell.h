/* Where a coordinate falls on a fine grid of n cells. Device only.
 *
 * x is in units of 2^-64. Of the `width` cells that a window centred at n x covers, the first is
 * floor(y), y = n x + 1 - width/2, and the fraction f = y - floor(y) places the window: cell i of them is
 * i + 1 - width/2 - f away from n x. Integers throughout, so nothing is rounded and nothing falls out of the grid.
 */
#ifndef PS_NUFFT_CELL_H
#define PS_NUFFT_CELL_H

/* The first cell, in 0 .. n - 1; *fraction in units of 2^-64. width in 2 .. n, n below 2^31. */
static inline uint first_cell(const ulong x, const uint n, const uint width, ulong *fraction) {
    const ulong half_cell = width % 2 != 0 ? (ulong)1 << 31 : 0;
    const ulong low = (x & 0xFFFFFFFF) * n;
    const ulong high = (x >> 32) * n + (low >> 32) + half_cell; /* of n x, in units of 2^-32 */
    const uint cell = (uint)(high >> 32) + 1 - (width + 1) / 2;
    *fraction = high << 32 | (low & 0xFFFFFFFF);
    return min(cell, cell + n); /* below 0 is far above n */
}

#endif
