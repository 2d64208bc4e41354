#include "analysis/sums.h"

#define PRECISION 64
#include "shared/pair.h"

#include <math.h>

void ps_sums_add(ps_sums *sums, double x) {
    pair_add(&sums->sum, &sums->sum_low, x);
    pair_add_square(&sums->square, &sums->square_low, x);
}

/* (high, low) of the exact product of two doubles. */
static void multiply(double a, double b, double *high, double *low) {
    *high = a * b;
    *low = fma(a, b, -*high);
}

void ps_sums_finish(const ps_sums *sums, uint64_t count, double *mean, double *standard_error) {
    const double n = (double)count;
    *mean = (sums->sum + sums->sum_low) / n;
    *standard_error = NAN;
    if (count < 2) {
        return;
    }
    /* n sum x^2 - (sum x)^2 in pairs: about 100 bits, so the difference keeps its digits. */
    double left = 0;
    double left_low = 0;
    double right = 0;
    double right_low = 0;
    multiply(n, sums->square, &left, &left_low);
    left_low += n * sums->square_low;
    multiply(sums->sum, sums->sum, &right, &right_low);
    right_low += 2 * sums->sum * sums->sum_low;
    const double difference = (left - right) + (left_low - right_low);
    const double variance = difference > 0 ? difference / n / (n - 1) : 0;
    *standard_error = sqrt(variance / n);
}
