/* f_0 + 2 sum_k re_k cos(2 pi k.x) - im_k sin(2 pi k.x), k of half of the lattice.
 *
 * The table has runs of frequencies that lie one behind the other along the last axis: the first k,
 * how many there are, and re and im of each; a run of none ends it. Phases go from one to the next
 * by a product, and so runs are short: TORUS_SERIES_RUN frequencies add as many roundings. */
#ifndef PS_INTEGRANDS_TORUS_SERIES_H
#define PS_INTEGRANDS_TORUS_SERIES_H

#include "integrands/phase.h"
#include "integrands/table.h"

enum { TORUS_SERIES_MEAN = 0, TORUS_SERIES_RUN = 64 }; /* place among the numbers; most of a run */
#define torus_series_has_table 1

static inline realv torus_series_value(const realv *x, const unsigned dimension,
                                       const real *numbers, TABLE *table) {
    const realv turn = x[dimension - 1] - nearest_whole(x[dimension - 1]);
    const realv step_cosine = phase_cosine(turn), step_sine = phase_sine(turn);
    realv sum = 0;
    int count = (int)table[dimension];
    while (count > 0) {
        realv turns = 0;
        FOR_AXES(unsigned i = 0; i < dimension; i++) {
            const realv own = table[i] * x[i];
            turns += own - nearest_whole(own);
        }
        turns -= nearest_whole(turns);
        realv cosine = phase_cosine(turns), sine = phase_sine(turns);
        table += dimension + 1;
        for (int j = 0; j < count; j++) {
            const realv next = cosine * step_cosine - sine * step_sine;
            sum += table[0] * cosine - table[1] * sine;
            sine = cosine * step_sine + sine * step_cosine;
            cosine = next;
            table += 2;
        }
        count = (int)table[dimension];
    }
    return numbers[TORUS_SERIES_MEAN] + 2 * sum;
}

#endif
