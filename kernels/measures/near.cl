/* Pairs of near points: the nearest neighbour of every point, how many pairs there are at each
 * distance, and what windows have of them. Launch: one work-item for each NEAR_BLOCK points.
 *
 * Points lie in the order of cells, NEAR_SPAN of which are as long as the largest distance that
 * counts, the reach: neighbours are in the same cell or no further than that from it. Cells that
 * follow each other on the last axis are a run, of which what the reach does not come to is left
 * out. With PERIODIC=1 space is the unit torus and a distance that to the nearest image, else there
 * is nothing beyond the cells.
 *
 * A window is a ball of radius R, anywhere: of the centres that have one of two points at the
 * distance r in it, a share alpha(r / 2R) has the other, too (docs/user/measure.md).
 *
 *   sizes, lengths  of measures/near.h; their names are used here
 *   given    points [DIMENSION][capacity], and behind them, words: the first point of each cell, then
 *            num_points; the last axis is the innermost
 *   found    [point]: the squared distance of its nearest neighbour among those that are looked at;
 *            behind it shares [item][WINDOWS][high, low]: alpha over pairs; then words, [item][NEAR_COUNTS]:
 *            ordered pairs by distance, those beyond the last bin at the end
 */
#ifndef PRECISION
#define PRECISION 64
#endif
#include "measures/near.h"
#include "shared/lanes.h"
#include "shared/pair.h"

#ifndef DIMENSION
#define DIMENSION 2
#endif
#ifndef PERIODIC
#define PERIODIC 1
#endif
#ifndef WINDOWS
#define WINDOWS NEAR_WINDOWS /* or 0: none are looked at */
#endif

#define SPAN NEAR_SPAN(DIMENSION)
#define LAST (DIMENSION - 1)

/* Of one point. */
typedef struct near_point {
    real x[DIMENSION];
    real image[DIMENSION]; /* -1, 0 or 1: of what the cells at hand are an image, to be added */
    ulong index;
    realv least;
} near_point;

typedef struct near_shares {
    realv high[NEAR_WINDOWS], low[NEAR_WINDOWS];
} near_shares;

/* The share of a ball that another of the same radius has, their centres x diameters apart. */
static inline realv alpha(const realv apart) {
    const realv x = fmin(apart, (realv)1);
#if DIMENSION == 1
    return 1 - x;
#elif DIMENSION == 2
    return (acos(x) - x * sqrt(1 - x * x)) * (real)M_2_PI;
#else
    return (1 - x) * (1 - x) * (1 + x * (real)0.5);
#endif
}

/* Infinite for points of LANES from `first` on that do not count: those from `end` on, and those
 * before `begin`. */
static inline realv leave_out(const ulong first, const ulong begin, const ulong end) {
    real lanes[LANES];
    for (uint i = 0; i < LANES; i++) {
        lanes[i] = first + i >= begin && first + i < end ? 0 : INFINITY;
    }
    return LOADV(0, lanes);
}

/* Where all points are looked at, each of them has an image of its own. */
static inline realv square_to(const near_point *of, const near_sizes sizes,
                              __global const real *points, const ulong first, const bool all) {
    realv square = 0;
    for (uint axis = 0; axis < DIMENSION; axis++) {
        realv apart = load_global(points + axis * sizes.capacity + first, 0) - of->x[axis];
        if (PERIODIC) {
            apart = all ? apart - rint(apart) : apart + of->image[axis];
        }
        square = square + apart * apart;
    }
    return square;
}

/* Windows have equal steps, and the diameter of the last is the end of the last bin. */
static inline void add_shares(near_shares *shares, const near_lengths *lengths,
                              const realv distance) {
    real lanes[LANES];
    real shortest = NEAR_BINS;
    STOREV(distance * lengths->bins, 0, lanes);
    for (uint i = 0; i < LANES; i++) {
        shortest = fmin(shortest, lanes[i]);
    }
    for (uint w = (uint)(shortest * WINDOWS / NEAR_BINS); w < WINDOWS; w++) {
        pair_add(&shares->high[w], &shares->low[w], alpha(distance * lengths->per_diameter[w]));
    }
}

/* LANES points from `first` on, but for those from `end` on, and the point itself. Windows have
 * every pair once, with the later of its points. */
static inline void look_at(near_point *of, near_shares *shares, const near_sizes sizes,
                           const near_lengths *lengths, __global const real *points,
                           const ulong first, const ulong end, const bool all, uint *counts) {
    real bins[LANES];
    const ulong next = first + LANES;
    const bool has_self = of->index >= first && of->index < next;
    realv square = square_to(of, sizes, points, first, all);
    if (next > end) {
        square += leave_out(first, 0, end);
    }
    if (has_self) {
        square = fmax(square,
                      fmin(leave_out(first, of->index + 1, end), leave_out(first, 0, of->index)));
    }
    of->least = fmin(of->least, square);
    const realv distance = sqrt(square);
    STOREV(fmin(distance * lengths->bins, (realv)NEAR_BINS), 0, bins);
    for (uint i = 0; i < LANES; i++) {
        const uint bin = (uint)(int)bins[i];
        counts[bin < NEAR_BINS ? bin : NEAR_BINS + i]++; /* additions in one place would wait */
    }
    if (WINDOWS > 0 && next > of->index) {
        add_shares(shares, lengths,
                   has_self ? distance + leave_out(first, of->index + 1, end) : distance);
    }
}

/* The cell of a place, by which the host has sorted, on one axis. */
static inline uint cell_of(const real x, const near_sizes sizes, const near_lengths *lengths) {
    const uint cell = (uint)((x - lengths->first) * lengths->cells);
    return min(cell, (uint)sizes.side - 1);
}

/* Number n of the runs about a point: the first cell of its row, and the square of the distance of
 * the row. False: there is none. */
static inline bool find_row(ulong *row, real *square, near_point *of, const uint *own, const uint n,
                            const near_sizes sizes, const near_lengths *lengths) {
    const long side = (long)sizes.side;
    uint rest = n;
    *row = 0;
    *square = 0;
    for (uint axis = 0; axis < LAST; axis++) {
        const uint others = rest / (2 * SPAN + 1);
        const int step = (int)(rest - (2 * SPAN + 1) * others) - SPAN;
        const long at = (long)own[axis] + step;
        const real place = (of->x[axis] - lengths->first) * lengths->cells - (real)own[axis];
        const real gap = step > 0 ? step - place : step < 0 ? place - (step + 1) : 0;
        rest = others;
        if (!PERIODIC && (at < 0 || at >= side)) {
            return false;
        }
        of->image[axis] = at < 0 ? -1 : at >= side ? 1 : 0;
        *row = *row * sizes.side + (ulong)(at < 0 ? at + side : at >= side ? at - side : at);
        *square += gap > 0 ? gap * gap : 0;
    }
    *row *= sizes.side;
    return true;
}

/* Cells from `from` to `to` of a row, as many as there are. */
static inline void look_at_cells(near_point *of, near_shares *shares, const near_sizes sizes,
                                 const near_lengths *lengths, __global const real *points,
                                 __global const uint *offsets, const ulong row, const long from,
                                 const long to, const real image, uint *counts) {
    const long first = max(from, (long)0);
    const long last = min(to, (long)sizes.side - 1);
    of->image[LAST] = image;
    if (first <= last) {
        const ulong end = offsets[row + (ulong)last + 1];
        for (ulong j = offsets[row + (ulong)first]; j < end; j += LANES) {
            look_at(of, shares, sizes, lengths, points, j, end, false, counts);
        }
    }
}

/* The points of a run that may be within the reach. */
static inline void look_at_run(near_point *of, near_shares *shares, const near_sizes sizes,
                               const near_lengths *lengths, __global const real *points,
                               __global const uint *offsets, const ulong row, const real square,
                               const long own, uint *counts) {
    const real rounding = 1e-6; /* of an edge: places have 1e-16 of 2^32 edges */
    const long side = (long)sizes.side;
    const real apart = sqrt(fmax((real)(SPAN * SPAN) - square, (real)0)) + rounding;
    const real place = (of->x[LAST] - lengths->first) * lengths->cells;
    const long from = max((long)floor(place - apart), own - SPAN);
    const long to = min((long)floor(place + apart), own + SPAN);
    look_at_cells(of, shares, sizes, lengths, points, offsets, row, from, to, 0, counts);
    if (PERIODIC && from < 0) {
        look_at_cells(of, shares, sizes, lengths, points, offsets, row, from + side, side - 1, -1,
                      counts);
    }
    if (PERIODIC && to >= side) {
        look_at_cells(of, shares, sizes, lengths, points, offsets, row, 0, to - side, 1, counts);
    }
}

static inline void look_at_all(near_point *of, near_shares *shares, const near_sizes sizes,
                               const near_lengths *lengths, __global const real *points,
                               uint *counts) {
    for (ulong j = 0; j < sizes.num_points; j += LANES) {
        look_at(of, shares, sizes, lengths, points, j, sizes.num_points, true, counts);
    }
}

static inline void look_about(near_point *of, near_shares *shares, const near_sizes sizes,
                              const near_lengths *lengths, __global const real *points,
                              __global const uint *offsets, uint *counts) {
    uint own[DIMENSION];
    uint rows = 1;
    for (uint axis = 0; axis < DIMENSION; axis++) {
        own[axis] = cell_of(of->x[axis], sizes, lengths);
        rows *= axis < LAST ? 2 * SPAN + 1 : 1;
    }
    for (uint n = 0; n < rows; n++) {
        ulong row = 0;
        real square = 0;
        if (find_row(&row, &square, of, own, n, sizes, lengths)) {
            look_at_run(of, shares, sizes, lengths, points, offsets, row, square, own[LAST],
                        counts);
        }
    }
}

static inline void store_shares(const near_shares *shares, __global real *to) {
    for (uint w = 0; w < WINDOWS; w++) {
        real high[LANES], low[LANES];
        realv all = 0, rest = 0;
        STOREV(shares->high[w], 0, high);
        STOREV(shares->low[w], 0, low);
        for (uint i = 0; i < LANES; i++) {
            pair_add(&all, &rest, (realv)high[i]);
            rest += (realv)low[i];
        }
        STOREV(all, 0, high);
        STOREV(rest, 0, low);
        to[2 * w] = high[0];
        to[2 * w + 1] = low[0];
    }
}

__kernel void measure_near(const near_sizes sizes, const near_lengths lengths,
                           __global const real *restrict given, __global real *restrict found) {
    const ulong item = get_global_id(0);
    const ulong begin = item * NEAR_BLOCK;
    const ulong items = (sizes.num_points + NEAR_BLOCK - 1) / NEAR_BLOCK;
    if (begin >= sizes.num_points) {
        return;
    }
    __global const real *points = given;
    __global const uint *offsets = (__global const uint *)(given + DIMENSION * sizes.capacity);
    __global real *shares = found + sizes.num_points;
    __global uint *counts = (__global uint *)(shares + items * WINDOWS * 2);
    near_shares own_shares;
    uint own_counts[NEAR_COUNTS];
    for (uint i = 0; i < NEAR_COUNTS; i++) {
        own_counts[i] = 0;
    }
    for (uint w = 0; w < WINDOWS; w++) {
        own_shares.high[w] = 0;
        own_shares.low[w] = 0;
    }
    for (ulong i = begin; i < min(begin + NEAR_BLOCK, sizes.num_points); i++) {
        near_point of = {.index = i, .least = INFINITY};
        for (uint axis = 0; axis < DIMENSION; axis++) {
            of.x[axis] = points[axis * sizes.capacity + i];
        }
        if (sizes.side == 1) {
            look_at_all(&of, &own_shares, sizes, &lengths, points, own_counts);
        } else {
            look_about(&of, &own_shares, sizes, &lengths, points, offsets, own_counts);
        }
        real lanes[LANES];
        real least = INFINITY;
        STOREV(of.least, 0, lanes);
        for (uint l = 0; l < LANES; l++) {
            least = fmin(least, lanes[l]);
        }
        found[i] = least;
    }
    for (uint i = 0; i < NEAR_COUNTS; i++) {
        counts[item * NEAR_COUNTS + i] = own_counts[i];
    }
    store_shares(&own_shares, shares + 2 * WINDOWS * item);
}
