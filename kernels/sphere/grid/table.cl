/* The table of sphere_grid: what a cell of the grid counts in c_lm (docs/engines/sphere_grid.md).
 * Lambda_lm on rings, as orders_sum.cl makes it, times filters from rings to angles of the grid,
 * which undo the window. In double precision whatever the precision of the table, so that its
 * numbers are rounded once, or once for each block of rings.
 *
 * Launch: (1, groups) in work-groups of one item, which has the orders that are its number modulo
 * the number of groups.
 *
 *   numbers  of numbers.h; their names are used here
 *   starts ... squares, states ... diagonal_scales, coefficients, begins  of orders_sum.cl, rows its table
 *   filters  [order modulo 2][even, odd l - m][num_rings][angle_pitch], angle_pitch a multiple of ANGLES
 *   offsets  [order][even, odd l - m]: table.h
 *   table    float or double, as TARGET_PRECISION says
 *
 * LANES divides TARGET_LANES, and that RUN_VECTORS LANES: vectors of the table are whole in a run.
 */
#include "sphere/nufft/orders_work.h"
#include "sphere/grid/table.h"
#include "sphere/nufft/numbers.h"

#ifndef TARGET_PRECISION
#define TARGET_PRECISION 32
#endif
#ifndef TARGET_LANES
#define TARGET_LANES 16
#endif
#ifndef TARGET_VECTORS
#define TARGET_VECTORS 4
#endif
#if TARGET_PRECISION == 64
#define TARGET double
#else
#define TARGET float
#endif
#define TO_TARGETV(x) PS_JOIN(convert_, PS_VECTOR(TARGET))(x)
typedef TARGET target;
typedef PS_VECTOR(TARGET) targetv __attribute__((aligned(sizeof(target))));

/* Angles that share a vector of Lambda_lm. */
#define ANGLES 8

/* A block of rings, and where its products go. */
typedef struct make_rows {
    uint begin, here;
    bool is_first;                /* else to what lower rings left */
    __local const real *rows;     /* [ring][TABLE_ROW] */
    __local const double *alphas; /* of the degrees of the run */
    __global const double *filters;
    uint angle_pitch, num_angles;
} make_rows;

/* LANES degrees of ANGLES angles: vector v of the run. to, of the first of these angles; others
 * `apart` further. */
static inline void make_angles(const make_rows from, const uint v, const uint angle,
                               __global target *to, const size_t apart) {
    doublev sums[ANGLES];
#pragma unroll
    for (int j = 0; j < ANGLES; j++) {
        sums[j] = (doublev)0;
    }
    for (uint i = from.begin; i < from.here; i++) {
        const doublev lambda = TO_DOUBLEV(load_local(from.rows + i * TABLE_ROW, v));
        __global const double *filter = from.filters + i * (size_t)from.angle_pitch + angle;
#pragma unroll
        for (int j = 0; j < ANGLES; j++) {
            sums[j] = fma(lambda, (doublev)filter[j], sums[j]);
        }
    }
    const doublev alpha = load_doubles(from.alphas + v * LANES);
#pragma unroll
    for (uint j = 0; j < ANGLES; j++) {
        if (angle + j < from.num_angles) {
            __global targetv *at = (__global targetv *)(to + j * apart);
            const targetv sum = TO_TARGETV(alpha * sums[j]);
            *at = from.is_first ? sum : *at + sum;
        }
    }
}

/* Where a run of LANES degrees of an order and parity goes. */
typedef struct make_target {
    __global target *table;
    __global const ulong *offsets;
    uint m, odd, first; /* vectors of the table in front of the run */
    uint vectors;       /* of the order and parity in the table */
} make_target;

static inline void make_run_of_table(const make_rows from, const make_target to,
                                     const uint vectors) {
    const uint groups = (from.num_angles + ANGLES - 1) / ANGLES;
    for (uint job = 0; job < vectors * groups; job++) {
        const uint v = job % vectors, angle = job / vectors * ANGLES;
        const uint degree = to.first * TARGET_LANES + v * LANES;
        const uint vector = degree / TARGET_LANES;
        const uint whole = table_run(to.vectors, TARGET_VECTORS);
        const uint run = vector / whole * whole;
        const uint in_run = min(to.vectors - run, whole);
        const size_t place = table_place(to.offsets, to.m, to.odd, run, from.num_angles) +
                             (size_t)angle * in_run + (vector - run);
        make_angles(from, v, angle, to.table + place * TARGET_LANES + degree % TARGET_LANES,
                    (size_t)in_run * TARGET_LANES);
    }
}

__kernel void sphere_grid_table(
    const grid_table_numbers numbers, __global const double *restrict starts,
    __global const int *restrict start_scales, __global const double *restrict steps,
    __global const int *restrict step_scales, __global const double *restrict ratios,
    __global const double *restrict cosines, __global const double *restrict distances,
    __global const double *restrict squares, __global double *restrict all_states,
    __global int *restrict all_scales, __global double *restrict all_diagonals,
    __global int *restrict all_diagonal_scales, __global const double *restrict filters,
    __global const ulong *restrict offsets, __global target *restrict table, __local real *rows,
    __local double *coefficients, __local uint *begins) {
    const ring_numbers rings = numbers.rings;
    const uint L = rings.L, only_even = rings.only_even;
    const uint num_rings = rings.num_rings, ring_pitch = rings.ring_pitch, block = rings.block;
    const uint num_angles = numbers.num_angles, angle_pitch = numbers.angle_pitch;
    const uint group = get_global_id(1), groups = get_global_size(1);
    __global double *states = all_states + group * 4 * (size_t)ring_pitch;
    const ring_work work = {{states, states + 2 * (size_t)ring_pitch,
                             all_scales + group * 2 * (size_t)ring_pitch, ring_pitch},
                            {distances, squares, rings.polar, rings.crossing, rings.equatorial},
                            all_diagonals + group * (size_t)ring_pitch,
                            all_diagonal_scales + group * (size_t)ring_pitch,
                            num_rings,
                            block,
                            0};
    const order_starts from_order = {starts, start_scales, steps, step_scales, ratios, cosines};
    for (uint m = group; m <= L; m += groups) {
        begin_order(work, from_order, m, group, ring_pitch);
        for (uint first = m; first <= L; first += RUN_DEGREES) {
            const uint degrees = min(L + 1 - first, (uint)RUN_DEGREES);
            const uint whole = (degrees + 2 * TARGET_LANES - 1) / (2 * TARGET_LANES);
            const uint vectors = whole * TARGET_LANES / LANES;
            make_coefficients(coefficients, first, m, 2 * LANES * vectors);
            for (uint ring = 0; ring < num_rings; ring += block) {
                const uint here = min(num_rings - ring, block);
                const uint begin =
                    make_block(work, ring, here, coefficients, rows, begins, vectors);
                for (uint odd = 0; odd < 2 && m + odd <= L; odd++) {
                    const make_rows from = {
                        begin,
                        here,
                        ring == 0,
                        rows + odd * block * TABLE_ROW,
                        coefficients + OF_ALPHA + odd * (RUN_DEGREES / 2),
                        filters + ((m % 2 * 2 + odd) * (size_t)num_rings + ring) * angle_pitch,
                        angle_pitch,
                        num_angles};
                    const make_target to = {table,
                                            offsets,
                                            m,
                                            odd,
                                            (first - m) / 2 / TARGET_LANES,
                                            table_vectors(m, odd, L, TARGET_LANES)};
                    if (to.first < to.vectors && (only_even == 0 || (m + odd) % 2 == 0)) {
                        make_run_of_table(
                            from, to,
                            min(vectors, (to.vectors - to.first) * (TARGET_LANES / LANES)));
                    }
                }
            }
        }
    }
}
