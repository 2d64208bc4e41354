/* From values on rings to c_lm, on GPUs. A work-group has an order and SETS realizations. It has
 * RINGS rings at a time, a work-item each, which makes Lambda_lm of its ring in a run of DEGREES
 * degrees, into local memory; then each multiplies some degrees with some columns of the
 * realizations, real and imaginary parts. Rings are added in order, so that sums are the same
 * whatever RINGS and SETS are. Launch: (items of one group, orders, parts of
 * the realizations).
 *
 * Lambda_lm goes by differences (orders_states.h) on all rings, which keep most digits and need
 * nothing of other rings; for SETS realizations the recurrence is a fourth of the work.
 *
 *   numbers    of numbers.h
 *   values     [order][realization][even, odd l - m][ring_pitch][re, im]
 *   starts, start_scales, steps, step_scales, ratios, distances   of orders_sum.cl
 *   sums       [realization][order][degree from the order on][re, im]
 *   table      local, [DEGREES][TABLE_PITCH]
 *   columns    local, [even, odd l - m][RINGS][COLUMN_PITCH]
 *   coefficients  local, [3][DEGREES] of the recurrence
 *   alive      local, [1]: whether some ring may have more than zeros
 */
#define LANES 1
#include "shared/real.h"
#include "sphere/nufft/degrees.h"
#include "sphere/nufft/numbers.h"
#include "sphere/nufft/scales.h"

#pragma OPENCL EXTENSION cl_khr_fp64 : enable

#ifndef RINGS
#define RINGS 64
#endif
#ifndef SETS
#define SETS 8
#endif
#define DEGREES DEGREES_OF_RUN
/* One number more, for banks. */
#define TABLE_PITCH (RINGS + 1)
#define COLUMN_PITCH (2 * SETS + 1)

/* Degrees of one parity of l - m and columns of a job, which are sums in registers. */
#define OWN_DEGREES (SETS > 1 ? 2 : 1)
#define OWN_COLUMNS (SETS > 1 ? 4 : 1)
#define COLUMN_JOBS (2 * SETS / OWN_COLUMNS)
#define PARITY_JOBS (DEGREES / 2 / OWN_DEGREES * COLUMN_JOBS)

/* ---- Lambda_lm of a ring -------------------------------------------------------------------- */

/* Lambda_lm, and D of orders_states.h. */
typedef struct ring_state {
    double value, difference, t;
    int scale;
} ring_state;

/* Lambda_mm, of every `groups`-th order from a first one on. */
static inline void begin_ring(ring_state *state, const degrees_numbers *numbers,
                              __global const double *starts, __global const int *start_scales,
                              __global const double *steps, __global const int *step_scales,
                              __global const double *ratios, const uint m, const uint ring) {
    const uint first = m % numbers->groups;
    double value = starts[(size_t)first * numbers->ring_pitch + ring];
    int scale = start_scales[(size_t)first * numbers->ring_pitch + ring];
    for (uint order = first + numbers->groups; order <= m; order += numbers->groups) {
        value = value * steps[ring] * ratios[order];
        scale += step_scales[ring];
        normalize(&value, &scale);
    }
    state->value = value;
    state->scale = scale;
    state->difference = 0;
}

/* a_{l+1}, b_{l+1} and g_{l+1} of a run from `first` on. */
static inline void make_coefficients(__local double *to, const uint first, const uint m) {
    const double order = m;
    for (uint i = get_local_id(0); i < DEGREES; i += get_local_size(0)) {
        const double l = first + i, next = l + 1;
        const double g = sqrt((2 * l + 3) * (next + order) / ((2 * l + 1) * (next - order)));
        to[i] = g * (l - order) / (next + order);
        to[DEGREES + i] = -g * (2 * l + 1) / (next + order);
        to[2 * DEGREES + i] = g;
    }
}

static inline void advance(ring_state *state, __local const double *coefficients) {
    const double step = coefficients[DEGREES] * state->t;
    const double rest = coefficients[0] * state->difference;
    state->difference = fma(step, state->value, rest);
    state->value = fma(coefficients[2 * DEGREES], state->value, state->difference);
}

/* Those above 1 that are scaled down so far come up. */
static inline void look(ring_state *state) {
    const bool comes_up = state->scale > 0 && fabs(state->value) > 1;
    state->value *= comes_up ? SCALE_DOWN : 1;
    state->difference *= comes_up ? SCALE_DOWN : 1;
    state->scale -= comes_up ? 1 : 0;
}

static inline bool is_more_than_zero(const ring_state *state) {
    return state->scale <= 0 && (state->value != 0 || state->difference != 0);
}

/* The run of a ring; returns false only where it is zeros: leaving them out changes no bit. */
static inline bool make_run(ring_state *state, __local const double *coefficients,
                            __local real *table) {
    bool is_there = is_more_than_zero(state);
    for (uint i = 0; i < DEGREES; i++) {
        table[i * TABLE_PITCH] = (real)(state->scale > 0 ? 0 : state->value);
        advance(state, coefficients + i);
        if (i % DEGREES_BETWEEN_LOOKS == DEGREES_BETWEEN_LOOKS - 1) {
            look(state);
            is_there = is_there || is_more_than_zero(state);
        }
    }
    return is_there;
}

/* ---- products ------------------------------------------------------------------------------- */

/* Rings of some realizations, zeros where there are fewer. */
static inline void fill_columns(__local real *columns, __global const real *values,
                                const size_t ring_pitch, const uint rings, const uint sets) {
    for (uint i = get_local_id(0); i < 2 * 2 * SETS * rings; i += get_local_size(0)) {
        const uint part = i % 2, ring = i / 2 % rings, row = i / 2 / rings, odd = row % 2;
        columns[(odd * RINGS + ring) * COLUMN_PITCH + row / 2 * 2 + part] =
            row / 2 < sets ? values[(row * ring_pitch + ring) * 2 + part] : 0;
    }
}

/* Degrees of a run, from the first on, and their place in the sums of the realization that is the
 * group's first. */
typedef struct run_place {
    __global real *sums;
    size_t set_apart;
    uint degrees, sets;
    bool is_first; /* of the blocks of rings */
} run_place;

/* Job `job` of a parity: adds `rings` rings. */
static inline void multiply(const run_place place, __local const real *table,
                            __local const real *columns, const uint job, const uint odd,
                            const uint rings) {
    const uint degree = 2 * OWN_DEGREES * (job / COLUMN_JOBS) + odd;
    const uint column = job % COLUMN_JOBS * OWN_COLUMNS;
    __local const real *const row = table + degree * TABLE_PITCH;
    __local const real *const own = columns + odd * RINGS * COLUMN_PITCH + column;
    __global real *const to = place.sums + column / 2 * place.set_apart + 2 * degree;
    real sum[OWN_DEGREES][OWN_COLUMNS];
#pragma unroll
    for (uint i = 0; i < OWN_DEGREES * OWN_COLUMNS; i++) {
        const uint d = i / OWN_COLUMNS, c = i % OWN_COLUMNS;
        const bool is_there =
            degree + 2 * d < place.degrees && (column + c) / 2 < place.sets && !place.is_first;
        sum[d][c] =
            is_there ? to[(column % 2 + c) / 2 * place.set_apart + 4 * d + (column + c) % 2] : 0;
    }
    for (uint ring = 0; ring < rings; ring++) {
        real value[OWN_COLUMNS];
#pragma unroll
        for (uint c = 0; c < OWN_COLUMNS; c++) {
            value[c] = own[ring * COLUMN_PITCH + c];
        }
#pragma unroll
        for (uint d = 0; d < OWN_DEGREES; d++) {
            const real lambda = row[2 * d * TABLE_PITCH + ring];
#pragma unroll
            for (uint c = 0; c < OWN_COLUMNS; c++) {
                sum[d][c] = fma(lambda, value[c], sum[d][c]);
            }
        }
    }
#pragma unroll
    for (uint i = 0; i < OWN_DEGREES * OWN_COLUMNS; i++) {
        const uint d = i / OWN_COLUMNS, c = i % OWN_COLUMNS;
        if (degree + 2 * d < place.degrees && (column + c) / 2 < place.sets) {
            to[(column % 2 + c) / 2 * place.set_apart + 4 * d + (column + c) % 2] = sum[d][c];
        }
    }
}

static inline void multiply_run(const run_place place, __local const real *table,
                                __local const real *columns, const uint rings, const uint parities,
                                const uint first_parity) {
    for (uint job = get_local_id(0); job < parities * PARITY_JOBS; job += get_local_size(0)) {
        multiply(place, table, columns, job % PARITY_JOBS, first_parity + job / PARITY_JOBS, rings);
    }
}

/* ---- all ------------------------------------------------------------------------------------ */

__kernel void
sphere_degrees(const degrees_numbers numbers, __global const real *restrict values,
               __global const double *restrict starts, __global const int *restrict start_scales,
               __global const double *restrict steps, __global const int *restrict step_scales,
               __global const double *restrict ratios, __global const double *restrict distances,
               __global real *restrict sums, __local real *table, __local real *columns,
               __local double *coefficients, __local uint *alive) {
    const uint L = numbers.L, m = get_global_id(1), id = get_local_id(0);
    const uint set = get_global_id(2) * SETS, sets = min((uint)SETS, numbers.num_sets - set);
    const size_t ring_pitch = numbers.ring_pitch, set_apart = 2 * (size_t)coefficients_of(L, L + 1);
    __global const real *const own = values + m * numbers.order_apart + set * 4 * ring_pitch;
    __global real *const to = sums + set * set_apart + 2 * (size_t)coefficients_of(L, m);
    ring_state state;
    for (uint ring = 0; ring < numbers.num_rings; ring += numbers.block) {
        const uint rings = min(numbers.num_rings - ring, numbers.block);
        const uint at = ring + min(id, rings - 1);
        begin_ring(&state, &numbers, starts, start_scales, steps, step_scales, ratios, m, at);
        state.t = distances[at];
        fill_columns(columns, own + 2 * ring, ring_pitch, rings, sets);
        for (uint first = m; first <= L; first += DEGREES) {
            const run_place place = {to + 2 * (first - m), set_apart,
                                     min(L + 1 - first, (uint)DEGREES), sets, ring == 0};
            make_coefficients(coefficients, first, m);
            alive[0] = 0;
            barrier(CLK_LOCAL_MEM_FENCE);
            if (id < RINGS && make_run(&state, coefficients, table + id)) {
                atomic_or(alive, 1);
            }
            barrier(CLK_LOCAL_MEM_FENCE);
            if (alive[0] != 0 || ring == 0) {
                multiply_run(place, table, columns, rings, numbers.only_even != 0 ? 1 : 2,
                             numbers.only_even != 0 ? m % 2 : 0);
            }
            barrier(CLK_LOCAL_MEM_FENCE);
        }
    }
}
