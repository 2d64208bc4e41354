#include "engines/pairs/pairs_bins.h"

#include "math/pi.h"

#include <math.h>

static const double sqrt2 = 1.4142135623730951;

/* moments[k] >= sum_j a_j |max_degree - 2 j|^k for k <= K: see pairs_bins.h. Those of odd k lie
 * between their neighbours. */
static void find_moments_of_orders(int32_t max_degree, double *moments) {
    double even[PS_PAIRS_MOMENTS / 2 + 1] = {0};
    double first = 1, last = 1; /* binom(2j, j) / 4^j for j and max_degree - j */
    for (int32_t j = 1; j <= max_degree; j++) {
        last *= (2.0 * j - 1) / (2.0 * j);
    }
    for (int32_t j = 0; j <= max_degree; j++) {
        const double order = max_degree - 2.0 * j;
        double term = first * last;
        for (size_t i = 0; i <= PS_PAIRS_MOMENTS / 2; i++, term *= order * order) {
            even[i] += term;
        }
        const double rest = (double)max_degree - j;
        first *= (2.0 * j + 1) / (2.0 * j + 2);
        last *= rest > 0 ? 2 * rest / (2 * rest - 1) : 1;
    }
    for (size_t k = 0; k <= PS_PAIRS_MOMENTS; k++) {
        moments[k] = k % 2 == 0 ? even[k / 2] : sqrt(even[k / 2] * even[k / 2 + 1]);
    }
}

/* |d^K/ds^K cos(2 n asin s)| <= sum_k factors[k] (2 n)^k at s = 1 / sqrt 2. */
static void find_factors(double *factors) {
    enum { K = PS_PAIRS_MOMENTS };
    double table[K + 1][K + 1] = {{1}, {0, 1}};
    table[1][1] = sqrt2; /* 1 / sqrt(1 - s^2) */
    const double s = sqrt2 / 2, cosine_square = 0.5;
    for (size_t n = 0; n + 2 <= K; n++) {
        const double d = (double)n;
        for (size_t k = 0; k <= K; k++) {
            const double lower = k >= 2 ? table[n][k - 2] : 0;
            table[n + 2][k] =
                ((2 * d + 1) * s * table[n + 1][k] + d * d * table[n][k] + lower) / cosine_square;
        }
    }
    for (size_t k = 0; k <= K; k++) {
        factors[k] = table[K][k];
    }
}

/* The bound divided by h^K, to the power 1 / K, which no degree makes overflow. */
static double find_slope(int32_t max_degree) {
    double moments[PS_PAIRS_MOMENTS + 1], factors[PS_PAIRS_MOMENTS + 1];
    double sum = 0, rest = 2; /* 2 / (4^K K!): (1/2)^K / (K! 2^(K-1)) */
    find_moments_of_orders(max_degree, moments);
    find_factors(factors);
    for (size_t k = 0; k <= PS_PAIRS_MOMENTS; k++) {
        sum += factors[k] * ldexp(moments[k], (int)k - PS_PAIRS_MOMENTS); /* r = 2 s */
    }
    for (size_t k = 1; k <= PS_PAIRS_MOMENTS; k++) {
        rest /= 4 * (double)k;
    }
    return pow(sum * rest, 1.0 / PS_PAIRS_MOMENTS);
}

double ps_pairs_bins_bound(int32_t max_degree, size_t num_bins) {
    return pow(find_slope(max_degree) * sqrt2 / (double)num_bins, PS_PAIRS_MOMENTS);
}

size_t ps_pairs_bins_choose(int32_t max_degree, double bound) {
    return (size_t)ceil(find_slope(max_degree) * sqrt2 / pow(bound, 1.0 / PS_PAIRS_MOMENTS));
}

static double node(size_t j) {
    return cos(PS_PI * ((double)j + 0.5) / PS_PAIRS_MOMENTS);
}

void ps_pairs_bins_nodes(size_t num_bins, double *nodes) {
    const size_t num = num_bins * PS_PAIRS_MOMENTS;
    double *sides = nodes + 2 * num;
    const double width = sqrt2 / (double)num_bins;
    for (size_t i = 0; i < num; i++) {
        const double place = (double)(i / PS_PAIRS_MOMENTS) + (1 + node(i % PS_PAIRS_MOMENTS)) / 2;
        const double chord = place * width;
        nodes[i] = nodes[num + i] = chord * chord / 2;
        sides[i] = 1;
        sides[num + i] = -1;
    }
}

void ps_pairs_bins_matrix(double *matrix) {
    for (size_t j = 0; j < PS_PAIRS_MOMENTS; j++) {
        for (size_t k = 0; k < PS_PAIRS_MOMENTS; k++) {
            const double angle = PS_PI * ((double)j + 0.5) / PS_PAIRS_MOMENTS;
            matrix[j * PS_PAIRS_MOMENTS + k] =
                (k == 0 ? 1.0 : 2.0) / PS_PAIRS_MOMENTS * cos((double)k * angle);
        }
    }
}
