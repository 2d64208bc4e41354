/* Sums over the JOBS work-items of a group, by way of local memory, in one order whatever the
 * device. Device only.
 *
 *   of_items  local, [num][JOBS + 1]: one more, so that items of a part read other banks
 *   of_parts  local, [JOBS]
 */
#ifndef PS_SHARED_GROUP_SUMS_H
#define PS_SHARED_GROUP_SUMS_H

#include "shared/real.h"

/* Each item has `num` numbers, which divides JOBS: item i < num returns the sum of number i, the
 * others 0. All items call it; between two calls nothing has to wait. */
static inline __attribute__((always_inline)) real
group_sum(__local real *of_items, __local real *of_parts, const real *own, const uint num) {
    const uint item = get_local_id(0), parts = JOBS / num; /* of the items, added up side by side */
    real sum = 0, total = 0;
#pragma unroll
    for (uint i = 0; i < num; i++) {
        of_items[i * (JOBS + 1) + item] = own[i];
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint j = 0; j < JOBS / parts; j++) {
        sum += of_items[item / parts * (JOBS + 1) + item % parts * (JOBS / parts) + j];
    }
    of_parts[item] = sum;
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint j = 0; item < num && j < parts; j++) {
        total += of_parts[item * parts + j];
    }
    return total;
}

#endif
