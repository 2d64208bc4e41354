/* Lambda_lm of the orders of a work-group, for all rings: from order to order, and block by block.
 * Device only. */
#ifndef PS_SPHERE_ORDERS_WORK_H
#define PS_SPHERE_ORDERS_WORK_H

#include "sphere/nufft/orders_table.h"

/* Degrees m and m + 1 of a ring, from Lambda_mm. By differences they are Lambda_mm and nothing. */
static inline void begin_ring(const ring_work work, const uint i, const double value,
                              const int scale, const double second) {
    const ring_states states = work.states;
    const bool is_difference = i < work.angles.polar || i >= work.angles.equatorial;
    work.diagonal[i] = states.value[i] = value;
    states.value[states.parity_apart + i] = is_difference ? 0 : value * second;
    states.before[i] = states.before[states.parity_apart + i] = 0;
    work.diagonal_scales[i] = states.scale[i] = states.scale[states.parity_apart + i] = scale;
}

/* Degrees m and m + 1 of all rings up to ring_pitch, the first order of a group or from the one
 * before. */
static inline void begin_order(const ring_work work, const order_starts from, const uint m,
                               const uint group, const uint ring_pitch) {
    const double second = sqrt(2 * (double)m + 3);
    for (uint i = work.alive; i < ring_pitch; i++) {
        double value = m == group ? from.starts[group * ring_pitch + i]
                                  : work.diagonal[i] * from.steps[i] * from.ratios[m];
        int scale = m == group ? from.start_scales[group * ring_pitch + i]
                               : work.diagonal_scales[i] + from.step_scales[i];
        normalize(&value, &scale);
        begin_ring(work, i, value, scale, second * from.cosines[i]);
    }
}

/* The table of a block of rings; the first ring of it that is more than zeros, `here` if there is
 * none. */
static inline uint make_block(const ring_work work, const uint ring, const uint here,
                              __local const double *coefficients, __local real *table,
                              __local uint *begins, const uint vectors) {
    const uint from = work.alive > ring ? work.alive - ring : 0;
    uint begin = here;
    for (uint i = from; i < here; i += RING_UNIT) {
        begins[i / RING_UNIT] =
            make_run(work.states, work.angles, ring + i, coefficients, table + i * TABLE_ROW,
                     table + (work.block + i) * TABLE_ROW, vectors)
                ? i
                : here;
    }
    for (uint i = from; i < here; i += RING_UNIT) {
        begin = min(begin, begins[i / RING_UNIT]);
    }
    return begin;
}

#endif
