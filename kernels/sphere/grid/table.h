/* The table of sphere_grid: what a cell of the grid counts in c_lm (docs/engines/sphere_grid.md).
 * Numbers of the precision that is summed, [order][even, odd l - m][run][angle][vector of
 * degrees][TARGET_LANES]; a run is at most TARGET_VECTORS vectors. Device only.
 */
#ifndef PS_SPHERE_GRID_TABLE_H
#define PS_SPHERE_GRID_TABLE_H

/* Vectors of the degrees m + odd, m + odd + 2, ..., L; there is one at least. */
static inline uint table_vectors(const uint m, const uint odd, const uint L, const uint lanes) {
    return ((L - m - odd) / 2 + lanes) / lanes;
}

/* Vectors of all runs but the last: as few runs as hold them, about as long. */
static inline uint table_run(const uint vectors, const uint most) {
    const uint runs = (vectors + most - 1) / most;
    return (vectors + runs - 1) / runs;
}

/* Where the run that begins with vector `first` begins, in vectors. offsets: [order][even, odd l -
 * m] */
static inline size_t table_place(__global const ulong *offsets, const uint m, const uint odd,
                                 const uint first, const uint num_angles) {
    return offsets[2 * m + odd] + (size_t)first * num_angles;
}

#endif
