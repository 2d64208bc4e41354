#include "engines/nufft/window.h"

#include "math/pi.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

/* sum (x^2/4)^j / j!^2: all terms are positive, and beta stays below 16 pi. */
static long double bessel_i0(long double x) {
    const long double quarter = x * x / 4;
    long double term = 1;
    long double sum = 1;
    for (int j = 1; term > sum * 1e-21L; j++) {
        term *= quarter / ((long double)j * j);
        sum += term;
    }
    return sum;
}

/* beta = pi w (1 - K/n) would put the edge of the main lobe on the nearest alias of K. With the
 * alias this far beyond the edge (the first zero is at pi) the largest frequency loses no more than
 * the others: sets that are regular along an axis may have all their power there. Best values for
 * the mean plus the largest of the squares of aliases, 1.7 to 2, were 2.5 .. 2.9 for w = 2 .. 16
 * and sigma = 1.2 .. 4; the optimum is flat. */
static const double beyond_edge = 2.7;

double ps_nufft_window_beta(unsigned width, int32_t max_frequency, uint32_t n) {
    const double alias = PS_PI * width * (1 - (double)max_frequency / (double)n);
    return sqrt(alias * alias - beyond_edge * beyond_edge);
}

ps_nufft_window ps_nufft_window_make(unsigned width, int32_t max_frequency, uint32_t n) {
    const double beta = ps_nufft_window_beta(width, max_frequency, n);
    return (ps_nufft_window){.width = width, .beta = beta, .peak = bessel_i0(beta)};
}

static long double value(const ps_nufft_window *window, long double t) {
    const long double x = 2 * t / window->width;
    const long double square = 1 - x * x;
    return square < 0 ? 0 : bessel_i0(window->beta * sqrtl(square)) / window->peak;
}

double ps_nufft_window_value(const ps_nufft_window *window, double t) {
    return (double)value(window, t);
}

/* The constant factor w / I_0(beta) is left out: only ratios are taken of these numbers. */
static double relative_transform(const ps_nufft_window *window, double f) {
    const double z = PS_PI * window->width * f;
    const double square = window->beta * window->beta - z * z;
    const double root = sqrt(fabs(square));
    return root == 0 ? 1 : (square > 0 ? sinh(root) : sin(root)) / root;
}

/* Long double: sinh(40) in double is off by 40 roundings of its argument. */
double ps_nufft_window_transform(const ps_nufft_window *window, long double f) {
    const long double z = PS_PI_L * window->width * f;
    const long double square = (long double)window->beta * window->beta - z * z;
    const long double root = sqrtl(fabsl(square));
    const long double ratio = root == 0 ? 1 : (square > 0 ? sinhl(root) : sinl(root)) / root;
    return (double)(window->width * ratio / window->peak);
}

ps_nufft_aliases ps_nufft_window_aliases(const ps_nufft_window *window, double f, int num) {
    const double wanted = relative_transform(window, f);
    double squares = 0;
    double sum = 0;
    for (int m = 1; m <= num; m++) {
        const double above = fabs(relative_transform(window, f + m) / wanted);
        const double below = fabs(relative_transform(window, f - m) / wanted);
        squares += above * above + below * below;
        sum += above + below;
    }
    return (ps_nufft_aliases){squares, sum * sum};
}

enum { ALIASES = 3 }; /* more aliases add 2 % of the error */

double ps_nufft_window_least_worst(const ps_nufft_window *window, int32_t max_frequency,
                                   uint32_t n) {
    return ps_nufft_window_aliases(window, (double)max_frequency / n, ALIASES).in_step;
}

/* Beyond the main lobe, where all aliases are, no transform is larger. */
static double transform_bound(const ps_nufft_window *window, double f) {
    const double z = PS_PI * window->width * f;
    return 1 / sqrt(z * z - window->beta * window->beta);
}

/* Says whether aliases of a frequency may be worse in step than that, without their sines. Few
 * frequencies but the largest may. */
static bool may_be_worse(const ps_nufft_window *window, double f, double worst) {
    const double roundings = 1 + 1e-12;
    const double rest = 2 * ALIASES - 1; /* are farther than the two nearest */
    const double sum = transform_bound(window, f - 1) + rest * transform_bound(window, f + 1);
    const double most = sum / relative_transform(window, f);
    return most * most * roundings > worst;
}

/* The frequencies that means are taken over: every one, if so few; else dense near the largest. */
enum { ALL = 24, SAMPLES = 24 };

typedef struct sample {
    double f, share;
} sample;

static int num_samples(int32_t max_frequency) {
    return max_frequency <= ALL ? max_frequency + 1 : SAMPLES;
}

static sample sample_of(int i, int32_t max_frequency, uint32_t n) {
    if (max_frequency <= ALL) {
        return (sample){(double)i / n, (i == 0 ? 1.0 : 2.0) / (2 * max_frequency + 1)};
    }
    const double at = (i + 0.5) / SAMPLES;
    const double largest = max_frequency + 0.5;
    return (sample){(1 - at * at) * largest / n, 2 * at / SAMPLES};
}

double ps_nufft_window_amplification(const ps_nufft_window *window, int32_t max_frequency,
                                     uint32_t n) {
    double inverse = 0;
    double grid = 0;
    for (int i = 0; i < num_samples(max_frequency); i++) {
        const sample one = sample_of(i, max_frequency, n);
        const double wanted = relative_transform(window, one.f);
        inverse += one.share / (wanted * wanted);
    }
    for (int i = 0; i < SAMPLES; i++) {
        const double any = relative_transform(window, (i + 0.5) / SAMPLES / 2);
        grid += any * any / SAMPLES;
    }
    return sqrt(grid * inverse);
}

ps_nufft_loss ps_nufft_window_loss(const ps_nufft_window *window, int32_t max_frequency,
                                   uint32_t n) {
    ps_nufft_loss loss = {
        .worst = ps_nufft_window_least_worst(window, max_frequency, n),
        .amplification = ps_nufft_window_amplification(window, max_frequency, n),
        .edge =
            relative_transform(window, 0) / relative_transform(window, (double)max_frequency / n),
    };
    for (int i = 0; i < num_samples(max_frequency); i++) {
        const sample one = sample_of(i, max_frequency, n);
        loss.aliasing += one.share * ps_nufft_window_aliases(window, one.f, ALIASES).squares;
    }
    for (int i = 0; i < SAMPLES; i++) {
        const double at = (i + 0.5) / SAMPLES;
        const double f = (1 - at * at) * max_frequency / n;
        if (may_be_worse(window, f, loss.worst)) {
            loss.worst = fmax(loss.worst, ps_nufft_window_aliases(window, f, ALIASES).in_step);
        }
    }
    return loss;
}

/* ---- polynomials ------------------------------------------------------------------------- */

enum { NODES = PS_NUFFT_MAX_DEGREE + 8 };

/* T_k at the nodes of T_NODES: row 1 has the nodes themselves. All bins of a window share them,
 * for the cosines took most of the time of planning a question of few points. */
typedef struct node_cosines {
    long double cosine[NODES][NODES]; /* [k][j] */
} node_cosines;

static void fill_nodes(node_cosines *self) {
    for (int k = 0; k < NODES; k++) {
        for (int j = 0; j < NODES; j++) {
            self->cosine[k][j] = cosl(PS_PI_L * k * (j + 0.5L) / NODES);
        }
    }
}

/* Chebyshev coefficients of bin i in u. */
static void chebyshev(const ps_nufft_window *window, const node_cosines *nodes, unsigned bin,
                      long double series[NODES]) {
    long double values[NODES];
    for (int j = 0; j < NODES; j++) {
        const long double t = bin + 1 - window->width / 2.0L - (nodes->cosine[1][j] + 1) / 2;
        values[j] = value(window, t);
    }
    for (int k = 0; k < NODES; k++) {
        series[k] = 0;
        for (int j = 0; j < NODES; j++) {
            series[k] += values[j] * nodes->cosine[k][j];
        }
        series[k] *= (k == 0 ? 1.0L : 2.0L) / NODES;
    }
}

unsigned ps_nufft_window_degree(const ps_nufft_window *window, double error) {
    unsigned degree = 0;
    node_cosines nodes;
    fill_nodes(&nodes);
    for (unsigned bin = 0; bin < window->width; bin++) {
        long double series[NODES];
        long double rest = 0;
        chebyshev(window, &nodes, bin, series);
        unsigned needed = NODES - 1;
        while (needed > 0 && rest + fabsl(series[needed]) <= error) {
            rest += fabsl(series[needed]);
            needed--;
        }
        degree = needed > degree ? needed : degree;
    }
    return degree < PS_NUFFT_MAX_DEGREE ? degree | 1 : PS_NUFFT_MAX_DEGREE;
}

/* Powers of u of a Chebyshev series, by T_(k+1) = 2 u T_k - T_(k-1). */
static void powers_of_series(const long double series[NODES], unsigned degree,
                             long double powers[NODES]) {
    long double before[NODES] = {1}; /* T_0 */
    long double current[NODES] = {0, 1};
    memset(powers, 0, NODES * sizeof *powers);
    for (unsigned k = 0; k <= degree; k++) {
        long double next[NODES] = {0};
        const long double *polynomial = k == 0 ? before : current;
        for (unsigned i = 0; i <= k; i++) {
            powers[i] += series[k] * polynomial[i];
        }
        if (k == 0) {
            continue;
        }
        for (unsigned i = 0; i + 1 < NODES; i++) {
            next[i + 1] = 2 * current[i];
        }
        for (unsigned i = 0; i < NODES; i++) {
            next[i] -= before[i];
        }
        memcpy(before, current, sizeof before);
        memcpy(current, next, sizeof current);
    }
}

/* Bin i is bin width - 1 - i at -u: made once, so that it is to the bit. */
void ps_nufft_window_polynomials(const ps_nufft_window *window, unsigned degree, unsigned bins,
                                 double *coefficients) {
    node_cosines nodes;
    fill_nodes(&nodes);
    memset(coefficients, 0, (degree + 1) * (size_t)bins * sizeof *coefficients);
    for (unsigned bin = 0; 2 * bin < window->width; bin++) {
        const unsigned mirror = window->width - 1 - bin;
        long double series[NODES];
        long double powers[NODES];
        chebyshev(window, &nodes, bin, series);
        powers_of_series(series, degree, powers);
        for (unsigned i = 0; i <= degree; i++) {
            const double power = bin == mirror && i % 2 != 0 ? 0 : (double)powers[i];
            coefficients[i * bins + bin] = power;
            coefficients[i * bins + mirror] = i % 2 != 0 ? -power : power;
        }
    }
}
