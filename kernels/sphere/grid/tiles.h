/* Sums of an order and parity by tiles, for GPUs: the work-group has TILE_SETS realizations, and a
 * run of the table and their values at TILE_ANGLES angles in local memory at a time. A work-item
 * has a vector of degrees of OWN_SETS realizations in registers, 8 LANES sums, and reads three
 * vectors for them. Angles are added in order, so that the sums are those of lanes.h, to the
 * bit. Device only.
 */
#ifndef PS_SPHERE_GRID_TILES_H
#define PS_SPHERE_GRID_TILES_H

#include "sphere/grid/rows.h"
#include "sphere/nufft/numbers.h"

#define OWN_SETS 4
#define JOBS (RUN_VECTORS * TILE_SETS / OWN_SETS)
/* Vectors from one angle to the next: one more than there are, so that angles are in other banks.
 */
#define COLUMN_VECTORS (2 * TILE_SETS / LANES + 1)

/* table [angle][RUN_VECTORS], of angles first .. end - 1; zeros in front of the run's first angle,
 * and behind its `here` vectors. */
static inline void fill_table(__local realv *table, const table_rows rows, const uint here,
                              const uint first, const uint end) {
    for (uint i = own_item(); i < (end - first) * RUN_VECTORS; i += num_items()) {
        const uint angle = first + i / RUN_VECTORS, v = i % RUN_VECTORS;
        table[i] = angle >= rows.begin && v < here
                       ? load_global(rows.table + angle * (size_t)here * LANES, v)
                       : (realv)0;
    }
}

/* columns [angle][COLUMN_VECTORS]: [realization][re, im]. What lies in front of the run's first
 * angle was not written; `first` is a multiple of LANES. */
static inline void fill_columns(__local realv *columns, const set_values from, const uint begin,
                                const uint first, const uint end) {
    const uint parts = (end - first + LANES - 1) / LANES * 2;
    for (uint i = own_item(); i < TILE_SETS * parts; i += num_items()) {
        const uint set = i / parts, part = i % parts, angle = part / 2 * LANES;
        __local real *const to =
            (__local real *)(columns + angle * COLUMN_VECTORS) + 2 * set + part % 2;
        __global const real *const at = from.values + set * from.apart + first / LANES * 2 * LANES;
        const realv values = set < from.num ? load_global(at, part) : (realv)0;
        real lanes[LANES];
        *(unaligned_realv *)lanes = values;
#pragma unroll
        for (uint lane = 0; lane < LANES; lane++) {
            const uint here = first + angle + lane;
            if (here < end) {
                to[lane * COLUMN_VECTORS * LANES] = here >= begin ? lanes[lane] : 0;
            }
        }
    }
}

typedef struct tile_sums {
    realv re[OWN_SETS], im[OWN_SETS];
} tile_sums;

/* num angles. table: the job's vector of the first; columns: its realizations of the first. */
static inline void add_angles(tile_sums *sums, __local const realv *table,
                              __local const realv *columns, const uint num) {
    for (uint i = 0; i < num; i++) {
        const realv lambda = table[i * RUN_VECTORS];
        real own[2 * OWN_SETS];
#pragma unroll
        for (uint j = 0; j < 2 * OWN_SETS / LANES; j++) {
            *(unaligned_realv *)(own + j * LANES) = columns[i * COLUMN_VECTORS + j];
        }
#pragma unroll
        for (uint set = 0; set < OWN_SETS; set++) {
            sums->re[set] = fma(lambda, (realv)own[2 * set], sums->re[set]);
            sums->im[set] = fma(lambda, (realv)own[2 * set + 1], sums->im[set]);
        }
    }
}

static inline void finish_tile(const tile_sums *sums, const table_rows rows, const uint num,
                               __global double *powers, const size_t powers_apart) {
#pragma unroll
    for (uint set = 0; set < OWN_SETS; set++) {
        if (set < num) {
            finish_sums(powers + (KEEP ? 0 : set * powers_apart), powers_apart, rows.weight,
                        rows.is_lowest, TO_DOUBLEV(sums->re[set]), TO_DOUBLEV(sums->im[set]));
        }
    }
}

/* One run of `here` vectors. A smaller work-group does it in rounds. */
static inline void sum_run(const table_rows rows, const uint here, const set_values from,
                           __global double *powers, const size_t powers_apart, __local realv *table,
                           __local realv *columns) {
    for (uint round = 0; round < JOBS; round += num_items()) {
        const uint job = round + own_item(), v = job % RUN_VECTORS;
        const uint set = job / RUN_VECTORS * OWN_SETS;
        tile_sums sums;
        uint at = rows.begin / LANES * LANES;
#pragma unroll
        for (uint i = 0; i < OWN_SETS; i++) {
            sums.re[i] = sums.im[i] = (realv)0;
        }
        do { /* once at least: PoCL 3.1 loses what is stored behind a loop with barriers */
            const uint end = min(at + TILE_ANGLES, rows.num_angles);
            fill_table(table, rows, here, at, end);
            fill_columns(columns, from, rows.begin, at, end);
            GROUP_BARRIER(CLK_LOCAL_MEM_FENCE);
            if (job < JOBS) {
                add_angles(&sums, table + v, columns + 2 * set / LANES, end - at);
            }
            at = end;
            if (at == rows.num_angles && v < here && set < from.num && job < JOBS) {
                finish_tile(&sums, rows, from.num - set,
                            powers + (KEEP ? 0 : set * powers_apart) + v * LANES, powers_apart);
            }
            GROUP_BARRIER(CLK_LOCAL_MEM_FENCE);
        } while (at < rows.num_angles);
    }
}

#endif
