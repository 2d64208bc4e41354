/* Sums over points y of a set, for every point x of it, of products over axes:
 *
 *     star       1 - max(x, y)
 *     periodic   1/2 - |x - y| (1 - |x - y|)
 *
 * of which L2 discrepancies are made (docs/user/measure.md). Products are the same for x and y
 * exchanged: x has the points y of its own vector, and those behind them twice. Launch: one
 * work-item for each LANES points x, rounded up at will. Sums are plain over DISCREPANCY_RUN points
 * y, then pairs.
 *
 *   sizes   of measures/discrepancy.h; its names are used here
 *   points  [DIMENSION][capacity]
 *   found   [star high, star low, periodic high, periodic low][capacity]
 */
#ifndef PRECISION
#define PRECISION 64
#endif
#include "measures/discrepancy.h"
#include "shared/lanes.h"
#include "shared/pair.h"

#ifndef DIMENSION
#define DIMENSION 2
#endif

typedef struct discrepancy_sums {
    realv star, star_low, periodic, periodic_low;
} discrepancy_sums;

/* factor times the points y from `first` to `end`. */
static inline void add_points(discrepancy_sums *sums, const realv *x, const discrepancy_sizes sizes,
                              __global const real *points, const ulong first, const ulong end,
                              const real factor) {
    realv star = 0, periodic = 0;
    for (ulong j = first; j < end; j++) {
        realv product = 1, periodic_product = 1;
        for (uint axis = 0; axis < DIMENSION; axis++) {
            const realv y = points[axis * sizes.capacity + j];
            const realv apart = fabs(x[axis] - y);
            product *= 1 - fmax(x[axis], y);
            periodic_product *= (real)0.5 - apart * (1 - apart);
        }
        star += product;
        periodic += periodic_product;
    }
    pair_add(&sums->star, &sums->star_low, star * factor);
    pair_add(&sums->periodic, &sums->periodic_low, periodic * factor);
}

__kernel void measure_discrepancy(const discrepancy_sizes sizes,
                                  __global const real *restrict points,
                                  __global real *restrict found) {
    const ulong v = get_global_id(0);
    const ulong num = sizes.num_points;
    if (v * LANES >= num) {
        return;
    }
    realv x[DIMENSION];
    discrepancy_sums sums = {0, 0, 0, 0};
    for (uint axis = 0; axis < DIMENSION; axis++) {
        x[axis] = load_global(points + axis * sizes.capacity, v);
    }
    add_points(&sums, x, sizes, points, v * LANES, min((v + 1) * LANES, num), 1);
    for (ulong first = (v + 1) * LANES; first < num; first += DISCREPANCY_RUN) {
        add_points(&sums, x, sizes, points, first, min(first + DISCREPANCY_RUN, num), 2);
    }
    store_global(found, v, sums.star);
    store_global(found + sizes.capacity, v, sums.star_low);
    store_global(found + 2 * sizes.capacity, v, sums.periodic);
    store_global(found + 3 * sizes.capacity, v, sums.periodic_low);
}
