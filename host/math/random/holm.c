#include "math/random/holm.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

static int by_value(const void *a, const void *b) {
    const double x = **(const double *const *)a;
    const double y = **(const double *const *)b;
    return (x > y) - (x < y);
}

/* The smallest of R probabilities counts R times, the next R - 1 times, and none is an alarm unless
 * those before it are. */
pspec_status ps_holm_adjust(size_t num, const double *p_values, double *adjusted, ps_error *error) {
    double largest = 0;
    const double **order = NULL;
    PS_TRY(PS_NEW(&order, num, "tests in order", error));
    for (size_t i = 0; i < num; i++) {
        order[i] = &p_values[i];
    }
    qsort(order, num, sizeof *order, by_value);
    for (size_t i = 0; i < num; i++) {
        largest = fmax(largest, fmin(1, (double)(num - i) * *order[i]));
        adjusted[order[i] - p_values] = largest;
    }
    free(order);
    return PSPEC_OK;
}
