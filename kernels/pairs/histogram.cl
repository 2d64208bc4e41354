/* The chords of all pairs in a histogram with MOMENTS Chebyshev moments in each bin: nearly all the
 * work of pairs_histogram.
 *
 * A pair (u, v), or (u, -v) where u.v < 0, has the chord r = |u -+ v| in [0, sqrt 2]; bin b of
 * either sign covers b <= r / width < b + 1, where x goes from -1 to 1, and its moments are sum w_i
 * w_j T_k(x), k < MOMENTS. Chords need a root where angles would need an arc tangent, too, and come
 * from differences: nothing is lost where points are close.
 *
 * One work-item owns a run of pairs and a histogram of its own. Launch: (runs, realizations) in
 * work-groups of one item, since local memory belongs to one.
 *
 *   points, counts  as in pairs/sums.cl
 *   partials        [realization][run of this launch][side +, side -][bin][MOMENTS]
 *   run_vectors     of lanes of pairs, in a run
 */
#include "shared/real.h"
#include "shared/lanes.h"
#include "pairs/layout.h"
#include "pairs/rows.h"

/* Kernels of the same program (docs/developer/decisions.md). */
#include "pairs/fold.cl"
#include "pairs/nodes.cl"
#include "pairs/nodes_sums.cl"

/* Vectors of pairs at a time: chords, their places, which wait for roots, and adding, which waits
 * for memory, are loops of their own, short enough that rounds overlap. */
#define HELD 32

/* Moments of LANES pairs of places x, T_k(x) weight: T_(k+2) = 2 T_2 T_k - T_(k-2) waits for half
 * as many products as the recurrence by one. */
PAIRS_INLINE void find_moments(const realv weight, const realv x, realv *a) {
    const realv twice = x + x;
    const realv second = fma(twice, x, (realv)-1);
    const realv twice_second = second + second;
    a[0] = weight;
    a[1] = weight * x;
    a[2] = weight * second;
    a[3] = fma(twice, a[2], -a[1]);
    a[4] = fma(twice_second, a[2], -a[0]);
    a[5] = fma(twice_second, a[3], -a[1]);
    a[6] = fma(twice_second, a[4], -a[2]);
    a[7] = fma(twice_second, a[5], -a[3]);
}

/* Weights of a vector of pairs, and squares of their chords, negative (-0, too) where u.v < 0. */
PAIRS_INLINE void find_squares(const pair_place *at, __local real *weights, __local real *squares) {
    const realv side = side_of_pair(at);
    store_local(weights, 0, weight_of_pair(at));
    store_local(squares, 0, square_of_pair(at, side) * side);
}

/* Squares become places in bins, and rows of the histogram, where they begin. Bins are found as
 * integers of 32 bits in either precision: doubles would become integers of their own width one by
 * one, and floor() is long. */
PAIRS_INLINE void find_places(__local real *squares, __local int *rows, const real per_chord,
                              const real num_bins) {
    const realv square = load_local(squares, 0);
    const realv place = sqrt(fabs(square)) * (realv)per_chord;
    const realv bin = TO_REALV(TO_INTV(min(place, (realv)(num_bins - 1))));
    const realv first = AS_SWORDV(square) < (swordv)0 ? (realv)num_bins : (realv)0;
    store_local(squares, 0, (realv)2 * (place - bin) - (realv)1);
    STOREV(TO_INTV(first + bin) * MOMENTS, 0, rows);
}

__kernel __attribute__((reqd_work_group_size(1, 1, 1))) void
pairs_histogram(__global const real *restrict points, __global const ulong *restrict counts,
                __global real *restrict partials, const ulong stride, const ulong first_run,
                const ulong run_vectors, const uint num_bins, __global const real *restrict scale) {
    __local real weights[HELD * LANES], places[HELD * LANES];
    __local int rows[HELD * LANES];
    const size_t realization = get_group_id(1);
    const ulong num_points = counts[realization];
    const ulong all = pair_vectors(num_points);
    const ulong begin = (first_run + get_group_id(0)) * run_vectors;
    const ulong end = min(begin + run_vectors, all);
    const ulong num_moments = 2 * num_bins * MOMENTS;
    __global real *sums =
        partials + (realization * get_num_groups(0) + get_group_id(0)) * num_moments;
    for (ulong i = 0; i < num_moments; i++) {
        sums[i] = 0;
    }
    if (begin >= all) {
        return;
    }
    pair_place at;
    pair_begin(&at, points + realization * POINT_ARRAYS * stride, stride, num_points, begin);
    const real per_chord = scale[0];
    for (ulong from = begin; from < end; from += HELD) {
        const size_t num_vectors = min(end - from, (ulong)HELD);
        for (size_t v = 0; v < num_vectors; v++) {
            find_squares(&at, weights + v * LANES, places + v * LANES);
            pair_next(&at);
        }
        for (size_t v = 0; v < num_vectors; v++) {
            find_places(places + v * LANES, rows + v * LANES, per_chord, (real)num_bins);
        }
        for (size_t v = 0; v < num_vectors; v++) {
            realv numbers[MOMENTS];
            find_moments(load_local(weights, v), load_local(places, v), numbers);
            add_rows(numbers, rows + v * LANES, sums);
        }
    }
}
