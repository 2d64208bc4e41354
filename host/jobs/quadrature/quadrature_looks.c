#include "jobs/quadrature/quadrature_looks.h"

#include <stdio.h>

/* Degree l has 2l + 1 real coefficients, of which each counts half as much as a complex one. */
static double count_independent(size_t degree) {
    return (double)degree + 0.5;
}

/* E^2 is a sum over degrees. Its excess kurtosis is at most that of the lowest which has a part in
 * it, 1. */
static const double least_of_sum = 1.5;

static ps_mean finish(const ps_sums *sums, uint64_t num) {
    ps_mean out;
    ps_sums_finish(sums, num, &out.mean, &out.standard_error);
    return out;
}

ps_sequential_look ps_quadrature_look(const ps_quadrature_sums *sums, double least,
                                      uint64_t num_realizations) {
    ps_sequential_look look = {.bin = PS_LOOK_AT_NOTHING};
    const ps_mean squared = finish(sums->squared, num_realizations);
    if (squared.mean > least) {
        ps_sequential_look_at(&look, squared, least_of_sum, num_realizations, PS_LOOK_AT_E2);
    }
    for (size_t l = 0; l < sums->num_degrees; l++) {
        const ps_mean e2 = finish(&sums->degrees[l * sums->stride], num_realizations);
        if (e2.mean > least) {
            ps_sequential_look_at(&look, e2, count_independent(l), num_realizations, (int64_t)l);
        }
    }
    return look;
}

void ps_quadrature_look_name(char *text, size_t size, const ps_sequential_look *look) {
    if (look->bin < 0) {
        snprintf(text, size, "%s",
                 look->bin == PS_LOOK_AT_E2 ? "E^2" : "nothing above the tolerance");
    } else {
        snprintf(text, size, "e_l^2 of degree %lld", (long long)look->bin);
    }
}
