/* Are the matrix units of torus/units.h what it says? One warp multiplies known numbers, of which
 * every sum is exact whatever the order, and compares; in single precision also numbers that are
 * cut, whose sum may be no lower than the model's and no higher than the exact one.
 *
 * Launch: one work-group of WARP.
 *
 *   wrong  one number, how many sums are wrong
 */
#include "shared/real.h"
#include "torus/units.h"

/* A factor is a whole number and another one times LOW, its lower part. */
#define LOW 0x1p-16f

/* For row or column `i` and point j: -2, -1, 1 or 2, of which both parts keep all digits. */
static inline int upper(const uint i, const uint j) {
    const int n = (int)((7 * i + 5 * j + i * j) % 4) - 2;
    return n < 0 ? n : n + 1;
}

static inline int lower(const uint i, const uint j) {
    return PRECISION == 32 ? (int)((i + 3 * j) % 5) - 2 : 0;
}

static inline real factor_of(const uint i, const uint j) {
    return (real)upper(i, j) + (real)lower(i, j) * (real)LOW;
}

static inline real exact_sum(const uint row, const uint column) {
    int high = 0, low = 0;
    for (uint j = 0; j < STEP_POINTS; j++) {
        high += upper(row, j) * upper(column, j);
        low += upper(row, j) * lower(column, j) + lower(row, j) * upper(column, j);
    }
    return (real)high + (real)low * (real)LOW;
}

#if WORD_POINTS == 2
#define POINTS_OF(value, i) ((float2)(value(i, j), value(i, j + 1)))
#else
#define POINTS_OF(value, i) value(i, j)
#endif

/* Of point 0, and of each of the others: their product is 1.5 units of the last place of 1. */
static inline real tiny_left(const uint i, const uint j) {
    (void)i;
    return j == 0 ? 1 : 0x1.8p-11f;
}

static inline real tiny_right(const uint i, const uint j) {
    (void)i;
    return j == 0 ? 1 : 0x1p-12f;
}

#define FILL(of_left, of_right)                                                                    \
    for (uint i = lane; i < UNIT_LEFT * STEP_POINTS / WORD_POINTS; i += WARP) {                    \
        const uint k = i % UNIT_LEFT, j = i / UNIT_LEFT * WORD_POINTS;                             \
        put_left(left, k, j, POINTS_OF(of_left, 2 * k), POINTS_OF(of_left, 2 * k + 1));            \
        if (k < UNIT_RIGHT) {                                                                      \
            put_right(right, k, j, POINTS_OF(of_right, 32 + 2 * k),                                \
                      POINTS_OF(of_right, 33 + 2 * k));                                            \
        }                                                                                          \
    }

__kernel __attribute__((reqd_work_group_size(WARP, 1, 1))) void probe_units(__global uint *wrong) {
    __local unit_word left[LEFT_WORDS] __attribute__((aligned(16)));
    __local unit_word right[RIGHT_WORDS] __attribute__((aligned(16)));
    __local uint found[WARP];
    const uint lane = (uint)get_local_id(0);
    const uint row = lane / 4 * 2, column = 32 + lane % 4 * 2; /* cosines of the lane */
    unit_sums sum = (unit_sums)1, cut = (unit_sums)0;
    FILL(factor_of, factor_of)
    barrier(CLK_LOCAL_MEM_FENCE);
    add_unit_tile(&sum, left, right, lane);
    barrier(CLK_LOCAL_MEM_FENCE);
    FILL(tiny_left, tiny_right)
    barrier(CLK_LOCAL_MEM_FENCE);
    add_unit_tile(&cut, left, right, lane);
    found[lane] =
        (sum.x != 1 + exact_sum(row, column)) + (sum.y != 1 + exact_sum(row, column + 1)) +
        (sum.z != 1 + exact_sum(row + 1, column)) + (sum.w != 1 + exact_sum(row + 1, column + 1));
    if (PRECISION == 32) {
        const unit_sums least = (unit_sums)(1 + 15 * 0x1p-23f),
                        most = (unit_sums)(1 + 23 * 0x1p-23f);
        found[lane] += !all(cut >= least) + !all(cut <= most);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    if (lane == 0) {
        uint total = 0;
        for (uint i = 0; i < WARP; i++) {
            total += found[i];
        }
        *wrong = total;
    }
}
