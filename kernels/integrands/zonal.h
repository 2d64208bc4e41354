/* A function of z alone from a file: linear between its nodes, 0 outside. The table has the nodes,
 * which rise, and then a value for each. */
#ifndef PS_INTEGRANDS_ZONAL_H
#define PS_INTEGRANDS_ZONAL_H

#include "integrands/table.h"

enum { ZONAL_NODES = 0 }; /* place among the numbers, of how many there are */
#define zonal_has_table 1

static inline real zonal_at(TABLE *table, const unsigned num, const real z) {
    unsigned low = 0, high = num - 1;
    if (!(z >= table[low] && z <= table[high])) {
        return 0;
    }
    while (high - low > 1) {
        const unsigned middle = (low + high) / 2;
        if (table[middle] <= z) {
            low = middle;
        } else {
            high = middle;
        }
    }
    const real share = (z - table[low]) / (table[high] - table[low]);
    return table[num + low] + share * (table[num + high] - table[num + low]);
}

static inline realv zonal_value(const realv *x, const unsigned dimension, const real *numbers,
                                TABLE *table) {
    const unsigned num = (unsigned)numbers[ZONAL_NODES];
    (void)dimension;
#ifdef __OPENCL_C_VERSION__
    real at[LANES];
    STOREV(x[2], 0, at);
    FOR_AXES(uint i = 0; i < LANES; i++) {
        at[i] = zonal_at(table, num, at[i]);
    }
    return LOADV(0, at);
#else
    return zonal_at(table, num, x[2]);
#endif
}

#endif
