/* Sums of weights times values of an integrand over points that are moved, for every trial: sum_j
 * w_j F(x_j + tau mod 1), with ROTATE sum_j w_j F(R u_j). Launch: (trials, pieces of sets), the
 * first extent rounded up at will.
 *
 * One work-item goes through a piece of a set for one trial, LANES points at a time; the lanes are
 * added in their order at the end, and the host adds the pieces in theirs (host/trials). So sums
 * depend on LANES, and on nothing else of a launch.
 *
 *   sizes    of integrands/values.h; its names are used here
 *   of       the numbers of the integrand
 *   points   [DIMENSION][capacity], every set filled up to whole vectors
 *   weights  [capacity], 0 behind the points of a set
 *   pieces   [piece]
 *   moves    [set][trial][MOVE_NUMBERS]: tau in [0,1), or R row by row
 *   table    of the integrand where NAME_has_table is 1; else anything
 *   sums     [piece][trial][high, low]
 *
 * INTEGRAND=ball takes ball_value of integrands/ball.h. A new integrand is an #include here. Where
 * ball_folds is 1 there, points are x + tau in [0,2), else in [0,1). With
 * FOLD a point of the lower half of the sphere becomes its opposite, after the rotation.
 *
 * In single precision a coordinate is off by up to 6e-8, half of it from the point and half from
 * the sum with tau, and that is how far the jump of an indicator is off: of N white points some N A
 * 6e-8 are on the wrong side of a jump of area A. What is smooth is off by some 1e-7 of its height
 * at each point, with either sign; the sum itself has twice the digits.
 */
#include "integrands/ball.h"
#include "integrands/box.h"
#include "integrands/cap.h"
#include "integrands/constant.h"
#include "integrands/diffuse.h"
#include "integrands/gaussian.h"
#include "integrands/glossy.h"
#include "integrands/half_plane.h"
#include "integrands/harmonic.h"
#include "integrands/lobe.h"
#include "integrands/map.h"
#include "integrands/phong.h"
#include "integrands/pixels.h"
#include "integrands/sphere_series.h"
#include "integrands/square.h"
#include "integrands/torus_map.h"
#include "integrands/torus_series.h"
#include "integrands/wave.h"
#include "integrands/zonal.h"

#include "integrands/fold.h"
#include "integrands/values.h"
#include "shared/lanes.h"
#include "shared/pair.h"

#ifndef INTEGRAND
#define INTEGRAND ball
#endif
#ifndef ROTATE
#define ROTATE 0
#endif
#ifndef FOLD
#define FOLD 0
#endif
#ifndef DIMENSION
#if ROTATE
#define DIMENSION 3
#else
#define DIMENSION 2
#endif
#endif

#define MOVE_NUMBERS (ROTATE ? 9 : DIMENSION)
#define VALUE PS_JOIN(INTEGRAND, _value)
#define FOLDS PS_JOIN(INTEGRAND, _folds) /* 0 where it is not defined */
#define HAS_TABLE PS_JOIN(INTEGRAND, _has_table)
#if HAS_TABLE
#define VALUE_AT(x, numbers, table) VALUE(x, DIMENSION, numbers, table)
#else
#define VALUE_AT(x, numbers, table) ((void)(table), VALUE(x, DIMENSION, numbers))
#endif

#if PRECISION == 64
typedef values_doubles integrand_numbers;
#else
typedef values_singles integrand_numbers;
#endif

#if ROTATE
static inline __attribute__((always_inline)) void move_points(realv *x, const real *move) {
    realv to[3];
    FOR_AXES(uint i = 0; i < 3; i++) {
        to[i] = x[0] * move[3 * i] + x[1] * move[3 * i + 1] + x[2] * move[3 * i + 2];
    }
    const realv side = FOLD ? (to[2] < (realv)0 ? (realv)-1 : (realv)1) : (realv)1;
    FOR_AXES(uint i = 0; i < 3; i++) {
        x[i] = to[i] * side;
    }
}
#else
static inline __attribute__((always_inline)) void move_points(realv *x, const real *move) {
    FOR_AXES(uint i = 0; i < DIMENSION; i++) {
        x[i] += move[i];
#if !FOLDS
        x[i] -= x[i] >= (realv)1 ? (realv)1 : (realv)0;
#if PRECISION == 32 /* numbers may have been rounded to 1, and their sum to 2 */
        x[i] -= x[i] >= (realv)1 ? (realv)1 : (realv)0;
#endif
#endif
    }
}
#endif

/* All lanes of high and low into one pair, in their order. */
static inline void store_sum(__global real *sum, const realv high, const realv low) {
    real highs[LANES], lows[LANES];
    realv all = 0, rest = 0;
    STOREV(high, 0, highs);
    STOREV(low, 0, lows);
    FOR_AXES(uint i = 0; i < LANES; i++) {
        pair_add(&all, &rest, (realv)highs[i]);
        rest += (realv)lows[i];
    }
    STOREV(all, 0, highs);
    STOREV(rest, 0, lows);
    sum[0] = highs[0];
    sum[1] = lows[0];
}

__kernel void integrand_values(const values_sizes sizes, const integrand_numbers of,
                               __global const real *restrict points,
                               __global const real *restrict weights,
                               __global const values_piece *restrict pieces,
                               __global const real *restrict moves,
                               __global const real *restrict table, __global real *restrict sums) {
    const size_t trial = get_global_id(0), piece = get_global_id(1);
    if (trial >= sizes.num_trials) {
        return;
    }
    const values_piece own = pieces[piece];
    real move[MOVE_NUMBERS];
    FOR_AXES(uint i = 0; i < MOVE_NUMBERS; i++) {
        move[i] = moves[(own.set * sizes.num_trials + trial) * MOVE_NUMBERS + i];
    }
    realv high = 0, low = 0;
    for (uint v = 0; v < own.num_vectors; v++) {
        realv x[DIMENSION];
        FOR_AXES(uint i = 0; i < DIMENSION; i++) {
            x[i] = load_global(points + i * sizes.capacity, own.first + v);
        }
        move_points(x, move);
        pair_add(&high, &low, load_global(weights, own.first + v) * VALUE_AT(x, of.numbers, table));
    }
    store_sum(sums + 2 * (piece * sizes.num_trials + trial), high, low);
}
