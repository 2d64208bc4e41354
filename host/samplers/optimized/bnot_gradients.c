/* Conjugate gradients for a Newton step on weights. The matrix is the Laplacian of the graph of
 * neighbouring cells; its null space, equal weights, is orthogonal to the right side since areas
 * sum to 1. Sums have a fixed order, so that they are the same on any machine. */
#include "samplers/optimized/bnot.h"

/* A step converges in about sqrt(N) of them; more than this many times that is no convergence. */
enum { MOST_PER_ROOT = 20, LEAST_LIMIT = 100 };

/* Four partial sums: additions need not wait for each other. */
static double dot(const double *a, const double *b, size_t num) {
    double sum[4] = {0, 0, 0, 0};
    size_t i = 0;
    for (; i + 4 <= num; i += 4) {
        for (unsigned k = 0; k < 4; k++) {
            sum[k] += a[i + k] * b[i + k];
        }
    }
    for (; i < num; i++) {
        sum[0] += a[i] * b[i];
    }
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/* out = L in; the sum of in L in. */
static double multiply(const ps_bnot_edges *edges, const double *in, double *out, size_t num) {
    for (size_t i = 0; i < num; i++) {
        out[i] = 0;
    }
    for (size_t i = 0; i < num; i++) {
        double sum = out[i];
        for (uint32_t e = edges->first[i]; e < edges->first[i + 1]; e++) {
            const uint32_t j = edges->to[e];
            const double flow = edges->slope[e] * (in[i] - in[j]);
            sum += flow;
            out[j] -= flow;
        }
        out[i] = sum;
    }
    return dot(in, out, num);
}

static void fill_diagonal(const ps_bnot_edges *edges, double *diagonal, size_t num) {
    for (size_t i = 0; i < num; i++) {
        diagonal[i] = 0;
    }
    for (size_t i = 0; i < num; i++) {
        for (uint32_t e = edges->first[i]; e < edges->first[i + 1]; e++) {
            diagonal[i] += edges->slope[e];
            diagonal[edges->to[e]] += edges->slope[e];
        }
    }
    for (size_t i = 0; i < num; i++) { /* a cell of a point has neighbours, but for rounding */
        diagonal[i] = diagonal[i] > 0 ? 1 / diagonal[i] : 1;
    }
}

/* sum of r^2 / diagonal */
static double weighted_square(const double *r, const double *inverse, size_t num) {
    double sum[4] = {0, 0, 0, 0};
    size_t i = 0;
    for (; i + 4 <= num; i += 4) {
        for (unsigned k = 0; k < 4; k++) {
            sum[k] += r[i + k] * r[i + k] * inverse[i + k];
        }
    }
    for (; i < num; i++) {
        sum[0] += r[i] * r[i] * inverse[i];
    }
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/* The null space out of a vector. */
static void centre(double *v, size_t num) {
    double sum = 0;
    for (size_t i = 0; i < num; i++) {
        sum += v[i];
    }
    const double mean = sum / (double)num;
    for (size_t i = 0; i < num; i++) {
        v[i] -= mean;
    }
}

static void begin(ps_bnot *b, size_t num) {
    const double mean = 1 / (double)num;
    fill_diagonal(&b->edges, b->diagonal, num);
    for (size_t i = 0; i < num; i++) {
        b->residual[i] = mean - b->area[i];
        b->step[i] = 0;
    }
    centre(b->residual, num);
    for (size_t i = 0; i < num; i++) {
        b->direction[i] = b->diagonal[i] * b->residual[i];
    }
}

static unsigned most_iterations(size_t num) {
    unsigned root = 1;
    while ((size_t)root * root < num) {
        root++;
    }
    return MOST_PER_ROOT * root + LEAST_LIMIT;
}

pspec_status ps_bnot_newton_step(ps_bnot *b, double fraction, ps_error *error) {
    const size_t num = b->cells.num;
    const unsigned most = most_iterations(num);
    begin(b, num);
    double square = weighted_square(b->residual, b->diagonal, num);
    const double enough = fraction * fraction * square;
    for (unsigned k = 0; k < most && square > enough; k++) {
        PS_TRY(ps_bnot_go_on(b, error));
        const double curvature = multiply(&b->edges, b->direction, b->product, num);
        if (!(curvature > 0)) {
            break;
        }
        const double length = square / curvature;
        for (size_t i = 0; i < num; i++) {
            b->step[i] += length * b->direction[i];
            b->residual[i] -= length * b->product[i];
        }
        const double before = square;
        square = weighted_square(b->residual, b->diagonal, num);
        const double turn = square / before;
        for (size_t i = 0; i < num; i++) {
            b->direction[i] = b->diagonal[i] * b->residual[i] + turn * b->direction[i];
        }
    }
    centre(b->step, num);
    return PSPEC_OK;
}
