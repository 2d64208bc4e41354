#include "shared/lanes.h"
#include "sphere/grid/table.h"

/* Vectors of degrees in a run of the table. */
#ifndef RUN_VECTORS
#define RUN_VECTORS 4
#endif

/* 2^-34 and 2^-62: below, no cell counts beside the rounding of others. */
#if PRECISION == 64
#define NEGLIGIBLE_CELL 2.168404344971009e-19
#else
#define NEGLIGIBLE_CELL 5.820766091346741e-11f
#endif

static inline bool is_nothing(__global const real *angle, const uint vectors) {
    bool is_more = false;
    for (uint v = 0; v < vectors; v++) {
        is_more = is_more || any(fabs(load_global(angle, v)) > (realv)NEGLIGIBLE_CELL) != 0;
    }
    return !is_more;
}

/* Where angles begin that are more than nothing, run by run; [order][even, odd l - m][most_runs].
 * LANES is that of the table. Launch: (orders, 2). */
__kernel void sphere_grid_begins(__global const real *restrict table,
                                 __global const ulong *restrict offsets,
                                 __global uint *restrict begins, const uint most_runs, const uint L,
                                 const uint num_angles, const uint only_even) {
    const uint m = get_global_id(0), odd = get_global_id(1);
    if (m + odd > L || (only_even != 0 && (m + odd) % 2 != 0)) {
        return;
    }
    const uint vectors = table_vectors(m, odd, L, LANES);
    const uint whole = table_run(vectors, RUN_VECTORS);
    for (uint first = 0; first < vectors; first += whole) {
        const uint here = min(vectors - first, whole);
        __global const real *run = table + table_place(offsets, m, odd, first, num_angles) * LANES;
        uint begin = 0;
        while (begin < num_angles && is_nothing(run + begin * (size_t)here * LANES, here)) {
            begin++;
        }
        begins[(2 * m + odd) * most_runs + first / whole] = begin;
    }
}
