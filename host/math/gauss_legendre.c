#include "math/gauss_legendre.h"

#include "math/pi.h"

#include <math.h>

/* P_num and its derivative at x, |x| < 1. */
static long double legendre(size_t num, long double x, long double *derivative) {
    long double before = 1;
    long double value = x;
    for (size_t l = 1; l < num; l++) {
        const long double next =
            ((long double)(2 * l + 1) * x * value - (long double)l * before) / (long double)(l + 1);
        before = value;
        value = next;
    }
    *derivative = (long double)num * (before - x * value) / (1 - x * x);
    return value;
}

/* Node i from the right end, by Newton's method from Tricomi's approximation, which is near enough
 * for every i. */
static long double find_node(size_t num, size_t i, long double *derivative) {
    enum { MOST_STEPS = 12 }; /* four or five are needed */
    const long double n = (long double)num;
    const long double angle = PS_PI_L * (4 * (long double)i + 3) / (4 * n + 2);
    long double x = (1 - (n - 1) / (8 * n * n * n)) * cosl(angle);
    for (int step = 0; step < MOST_STEPS; step++) {
        const long double last = x;
        x -= legendre(num, x, derivative) / *derivative;
        if (fabsl(x - last) < 1e-18L) {
            break;
        }
    }
    legendre(num, x, derivative);
    return x;
}

void ps_gauss_legendre(size_t num, double *nodes, double *weights) {
    if (num == 1) {
        nodes[0] = 0.5;
        weights[0] = 1;
        return;
    }
    for (size_t i = 0; i < (num + 1) / 2; i++) {
        long double derivative = 0;
        const long double x = find_node(num, i, &derivative);
        const double weight = (double)(1 / ((1 - x * x) * derivative * derivative));
        nodes[i] = (double)((1 - x) / 2);
        nodes[num - 1 - i] = (double)((1 + x) / 2);
        weights[i] = weight;
        weights[num - 1 - i] = weight;
    }
}
