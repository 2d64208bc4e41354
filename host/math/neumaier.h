/* Sums whose rounding errors are carried along (A. Neumaier 1974). */
#ifndef PS_MATH_NEUMAIER_H
#define PS_MATH_NEUMAIER_H

#include <math.h>

/* {0, 0} is the empty sum. */
typedef struct ps_neumaier {
    double sum, lost;
} ps_neumaier;

static inline void ps_neumaier_add(ps_neumaier *total, double term) {
    const double sum = total->sum + term;
    total->lost +=
        fabs(total->sum) >= fabs(term) ? (total->sum - sum) + term : (term - sum) + total->sum;
    total->sum = sum;
}

static inline double ps_neumaier_value(const ps_neumaier *total) {
    return total->sum + total->lost;
}

#endif
