#include "spectra/sequential.h"

#include <math.h>

/* The estimate of the standard error has an error of its own, of which so many are added
 * (sequential.h). Measured by tests/spectra/test_sequential.c: with 1, 4 % stop too soon, with 2,
 * 0.1 %, after 7 % more realizations than with this. */
static const double deviations = 1.5;

uint64_t ps_sequential_next_look(uint64_t done) {
    uint64_t look = PS_LEAST_REALIZATIONS;
    for (int half = 1; look <= done; half++) {
        const double exact = PS_LEAST_REALIZATIONS * pow(2, half / 2.0);
        look = 2 * (uint64_t)ceil(exact / 2);
    }
    return look;
}

/* Frequencies of a bin that are independent: k and -k are not, nor are the orders m and -m of a
 * degree. */
static double count_independent(const ps_bins *bins, size_t i) {
    const double modes = (double)ps_bin_num_computed(&bins->bins[i]);
    return modes > 2 ? modes / 2 : 1;
}

static double correction(double independent, double num_realizations) {
    const double kurtosis = 6 / independent;
    return 1 + deviations / 2 * sqrt((2 + kurtosis) / num_realizations);
}

void ps_sequential_look_at(ps_sequential_look *look, ps_mean mean, double independent,
                           uint64_t num_realizations, int64_t bin) {
    const double relative = mean.standard_error / mean.mean;
    const double corrected = relative * correction(independent, (double)num_realizations);
    if (!(corrected <= look->corrected)) {
        *look = (ps_sequential_look){relative, corrected, bin};
    }
}

ps_sequential_look ps_sequential_find(const ps_bins *bins, const ps_mean *means, double floor,
                                      uint64_t num_realizations) {
    ps_sequential_look look = {0};
    for (size_t i = 0; i < bins->num_reported; i++) {
        if (means[i].mean > 0 && !(means[i].mean <= floor)) {
            ps_sequential_look_at(&look, means[i], count_independent(bins, i), num_realizations,
                                  bins->bins[i].key);
        }
    }
    return look;
}

double ps_sequential_expected(double fewest_independent, double standard_error) {
    enum { ROUNDS = 8 }; /* of a correction that hardly changes any more */
    double num = PS_LEAST_REALIZATIONS;
    for (int i = 0; i < ROUNDS; i++) {
        const double error = correction(fewest_independent, num) / standard_error;
        num = fmax(PS_LEAST_REALIZATIONS, error * error / fewest_independent);
    }
    /* Nobody has so many; looks are counted in integers. */
    const double countless = 1e15;
    return num < countless ? (double)ps_sequential_next_look((uint64_t)ceil(num) - 1) : num;
}
