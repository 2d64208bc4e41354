/* One point in each stratum of a grid, at random or in its centre. Needs doubles.
 */
#ifndef PS_SAMPLERS_STRATA_H
#define PS_SAMPLERS_STRATA_H

#include "samplers/numbers.h"
#include "shared/fixed_point.h"

#ifndef __OPENCL_C_VERSION__
#include <math.h>
#endif

/* The few points that rounding could carry over an edge. fma has the exact sign of x m - i. */
static inline double stratum_near_edge(const double i, const double offset, const double m) {
    double x = (i + offset) / m;
    while (fma(x, m, -i) < 0) {
        x = nextafter(x, 1.0);
    }
    while (x * m >= i + 1) {
        x = nextafter(x, 0.0);
    }
    return x;
}

/* (i + offset)/m within [i/m, (i+1)/m), exactly: rounding never carries a point out of its stratum,
 * neither in exact arithmetic nor for a reader who computes floor(x * m). i < m <= 2^40. */
static inline double stratum_point(const double i, const double offset, const double m) {
    /* Sum, quotient and the reader's product are each off by at most m 2^-53 in units of a stratum;
     * 4 m 2^-53 leaves room to spare. */
    const double margin = 4 * 0x1p-53 * m;
    return offset > margin && offset < 1 - margin ? (i + offset) / m
                                                  : stratum_near_edge(i, offset, m);
}

/* The stratum of point j: the last axis moves fastest. */
SAMPLER_INLINE void stratum_cell(const sampler_numbers *of, const ps_u32 dimension, ps_u64 j,
                                 ps_u64 *cell) {
    SAMPLER_FOR(ps_u32 k = 0; k < dimension; k++) {
        const ps_u32 i = dimension - 1 - k;
        cell[i] = j % of->counts[i];
        j /= of->counts[i];
    }
}

/* Of axis i, where words are those of the axis before. */
SAMPLER_INLINE double jittered_coordinate(const sampler_numbers *of, const philox_stream stream,
                                          const ps_u32 dimension, const ps_u64 j, const ps_u32 i,
                                          const ps_u64 cell, ps_u32 *words) {
    const ps_u64 digits = philox_next(stream, j * dimension + i, i == 0, words);
    return stratum_point((double)cell, (double)digits * 0x1p-53, (double)of->counts[i]);
}

SAMPLER_INLINE void jittered_places(const sampler_numbers *of, SAMPLER_TABLE table,
                                    const ps_u32 dimension, const ps_u64 realization,
                                    const ps_u64 j, ps_u64 *places) {
    const philox_stream stream = {of->seed, realization, PHILOX_COORDINATES};
    ps_u32 words[PHILOX_WORDS];
    ps_u64 cell[SAMPLER_AXES];
    (void)table;
    stratum_cell(of, dimension, j, cell);
    SAMPLER_FOR(ps_u32 i = 0; i < dimension; i++) {
        places[i] = fixed_point(jittered_coordinate(of, stream, dimension, j, i, cell[i], words));
    }
}

SAMPLER_INLINE void jittered_coordinates(const sampler_numbers *of, const ps_u64 realization,
                                         const ps_u64 j, double *x) {
    const philox_stream stream = {of->seed, realization, PHILOX_COORDINATES};
    ps_u32 words[PHILOX_WORDS];
    ps_u64 cell[SAMPLER_AXES];
    stratum_cell(of, SAMPLER_PLANE, j, cell);
    SAMPLER_FOR(ps_u32 i = 0; i < SAMPLER_PLANE; i++) {
        x[i] = jittered_coordinate(of, stream, SAMPLER_PLANE, j, i, cell[i], words);
    }
}

SAMPLER_INLINE void regular_places(const sampler_numbers *of, SAMPLER_TABLE table,
                                   const ps_u32 dimension, const ps_u64 realization, const ps_u64 j,
                                   ps_u64 *places) {
    ps_u64 cell[SAMPLER_AXES];
    (void)table;
    (void)realization;
    stratum_cell(of, dimension, j, cell);
    SAMPLER_FOR(ps_u32 i = 0; i < dimension; i++) {
        places[i] = fixed_point(stratum_point((double)cell[i], 0.5, (double)of->counts[i]));
    }
}

#endif
