#include "engines/pairs/pairs_chord.h"

#include <math.h>

double ps_chord_power(const ps_chord *shape, double square) {
    return square > 0 ? pow(square, shape->power) : 0;
}

double ps_chord_below_rho(const ps_chord *shape, double square) {
    const double x = square / shape->rho_square - 1;
    double sum = 0;
    for (int k = PS_CHORD_TERMS; k-- > 0;) {
        sum = sum * x + shape->binomials[k];
    }
    return sum * pow(shape->rho_square, shape->power);
}

/* |x (x - 1) .. (x - k + 1)| */
static double falling(double x, int k) {
    double out = 1;
    for (int i = 0; i < k; i++) {
        out *= fabs(x - i);
    }
    return out;
}

/* Bounds g'''''''' below rho, in units of rho^(2 power - 8). */
static double bound_below(const ps_chord *shape) {
    double sum = 0;
    for (int j = PS_PAIRS_MOMENTS / 2; j < PS_CHORD_TERMS; j++) {
        double c = 0;
        double ways = 1; /* binom(k, j) (-1)^(k - j) */
        for (int k = j; k < PS_CHORD_TERMS; k++) {
            c += shape->binomials[k] * ways;
            ways *= -(double)(k + 1) / (double)(k + 1 - j);
        }
        sum += fabs(c) * falling(2 * j, PS_PAIRS_MOMENTS);
    }
    return sum;
}

static double bound_opposite(double power) {
    enum { K = PS_PAIRS_MOMENTS };
    const double nearest = 2 - sqrt(2);
    double sum = 0;
    double ways = 1;
    for (int i = 0; i <= K; i++) {
        sum += ways * falling(power, i) * falling(power, K - i) * pow(nearest, power - i) *
               pow(2, power - K + i);
        ways *= (double)(K - i) / (double)(i + 1);
    }
    return sum;
}

/* Sets rho to so many bins of the histogram. */
static void set_rho(ps_chord *shape, size_t num_bins, size_t near_bins) {
    enum { K = PS_PAIRS_MOMENTS };
    const double width = sqrt(2) / (double)num_bins;
    const double rho = width * (double)near_bins;
    double rest = 2; /* 2 (1/4)^K / K!: (1/2)^K / (K! 2^(K-1)) */
    for (int k = 1; k <= K; k++) {
        rest /= 4 * (double)k;
    }
    shape->rho_square = rho * rho;
    const double near = fmax(falling(2 * shape->power, K), bound_below(shape));
    const double scaled = near * pow(rho, 2 * shape->power) * pow((double)near_bins, -K);
    shape->bound = rest * fmax(scaled, bound_opposite(shape->power) * pow(width, K));
}

ps_chord ps_chord_make(double power, size_t num_bins, double tolerance) {
    ps_chord out = {.power = power, .binomials = {1}};
    size_t near_bins = 1;
    for (int k = 1; k < PS_CHORD_TERMS; k++) {
        out.binomials[k] = out.binomials[k - 1] * (power - k + 1) / k;
    }
    set_rho(&out, num_bins, near_bins);
    while (out.bound > tolerance && near_bins < num_bins) {
        set_rho(&out, num_bins, ++near_bins);
    }
    return out;
}
