#include "engines/pairs/pairs_isotropic.h"

#include "base/memory.h"
#include "engines/pairs/pairs_bins.h"
#include "engines/pairs/pairs_histogram.h"
#include "math/neumaier.h"

#include <math.h>
#include <stdlib.h>

/* Terms of the polynomial below rho: as many derivatives as the remainder of a bin asks for. */
enum { TERMS = PS_PAIRS_MOMENTS };

/* Degrees of the histogram at least: few pairs are nearer than some of its bins then. */
enum { LEAST_DEGREES = 64 };

typedef struct sums_of_pairs {
    ps_device *device;
    const pspec_pattern *pattern;
    int exponent;
    double tolerance;
    ps_frequencies degrees;
    ps_problem problem;
    double weight_sum, weight_size, weight_square; /* W, sum |w|, sum w^2 */
    double *q;                                     /* [L + 1] */
    size_t num_bins;
    double *nodes, *weights; /* t and side, [2][num_nodes]; [num_nodes] */
    double rounding, bound;  /* of Q(l), in (sum |w|)^2: without and with what bins lose */
} sums_of_pairs;

/* ---- weights ----------------------------------------------------------------------------- */

static double weight_of(const sums_of_pairs *of, size_t j) {
    return of->pattern->weights != NULL ? ldexp(of->pattern->weights[j], -of->exponent)
                                        : ldexp(1, -of->exponent);
}

static void add_weights(sums_of_pairs *of) {
    ps_neumaier sum = {0, 0}, size = {0, 0}, square = {0, 0};
    for (size_t j = 0; j < of->pattern->num_points; j++) {
        const double weight = weight_of(of, j);
        ps_neumaier_add(&sum, weight);
        ps_neumaier_add(&size, fabs(weight));
        ps_neumaier_add(&square, weight * weight);
    }
    of->weight_sum = ps_neumaier_value(&sum);
    of->weight_size = ps_neumaier_value(&size);
    of->weight_square = ps_neumaier_value(&square);
}

/* ---- the histogram ----------------------------------------------------------------------- */

/* What a kernel makes of an error of Q(l). */
static double size_of_kernel(const ps_isotropic_kernel *kernel) {
    double sum = kernel->num_coefficients == 0 ? pow(4, kernel->power) : 0;
    for (size_t l = 0; l < kernel->num_coefficients; l++) {
        sum += fabs(kernel->coefficients[l]);
    }
    return sum;
}

static pspec_status make_problem(sums_of_pairs *of, const ps_isotropic_kernel *kernels,
                                 size_t num_kernels, ps_error *error) {
    const double share = 0.5; /* of the tolerance; the other half is for what is below rho */
    const double root = sqrt((double)of->pattern->num_points);
    int64_t last = root > LEAST_DEGREES ? (int64_t)root : LEAST_DEGREES;
    double largest = 1;
    for (size_t k = 0; k < num_kernels; k++) {
        const int64_t num = (int64_t)kernels[k].num_coefficients;
        last = num - 1 > last ? num - 1 : last;
        largest = fmax(largest, size_of_kernel(&kernels[k]));
    }
    PS_TRY(ps_frequencies_degrees(&of->degrees, last, false, error));
    PS_TRY(ps_frequencies_enumerate(&of->degrees, error));
    of->problem =
        (ps_problem){.frequencies = &of->degrees,
                     .num_points = of->pattern->num_points,
                     .num_realizations = 1,
                     .has_weights = true,
                     .measure = PS_OF_PAIR_SUMS,
                     .tolerance = fmin(share * of->tolerance / largest, 1),
                     .weight_share = of->weight_square / (of->weight_size * of->weight_size)};
    return PSPEC_OK;
}

static pspec_status allocate(sums_of_pairs *of, ps_error *error) {
    void *memory = NULL;
    const size_t num_nodes = 2 * of->num_bins * PS_PAIRS_MOMENTS;
    const size_t num_degrees = (size_t)of->degrees.max_frequency + 1;
    PS_TRY(ps_allocate(&memory, num_degrees + 3 * num_nodes, sizeof(double), "a histogram", error));
    of->q = memory;
    of->nodes = of->q + num_degrees;
    of->weights = of->nodes + 2 * num_nodes;
    ps_pairs_bins_nodes(of->num_bins, of->nodes);
    return PSPEC_OK;
}

static pspec_status run_engine(sums_of_pairs *of, void *state, ps_precision precision,
                               ps_error *error) {
    const double scale = 1;
    const ps_batch batch = {
        .num_patterns = 1, .patterns = of->pattern, .scales = &scale, .exponents = &of->exponent};
    const int32_t last = of->degrees.max_frequency;
    ps_rows rows;
    of->num_bins = ps_pairs_histogram_num_bins(state);
    PS_TRY(allocate(of, error));
    PS_TRY(ps_pairs_histogram.run(state, &batch, &rows, error));
    PS_TRY(ps_pairs_histogram_weights(state, of->weights, error));
    of->q[0] = of->weight_sum * of->weight_sum;
    double mean_power = 0;
    for (int32_t l = 1; l <= last; l++) {
        of->q[l] = rows.host[l - 1];
        mean_power += of->q[l] / of->weight_square / last;
    }
    of->bound = ps_pairs_histogram_error(&of->problem, ps_device_get_limits(of->device), precision,
                                         mean_power);
    of->rounding = of->bound - ps_pairs_bins_bound(last, of->num_bins);
    return PSPEC_OK;
}

static pspec_status make_histogram(sums_of_pairs *of, ps_precision precision, ps_error *error) {
    void *state = NULL;
    PS_TRY(ps_pairs_histogram.create(&state, &of->problem, precision, 1, of->device, error));
    const pspec_status status = run_engine(of, state, precision, error);
    ps_pairs_histogram.destroy(state);
    return status;
}

/* In the cheapest precision whose error is within the tolerance, also with the powers that are measured. */
static pspec_status fill_histogram(sums_of_pairs *of, ps_error *error) {
    const ps_device_limits *const limits = ps_device_get_limits(of->device);
    double best = INFINITY;
    for (int p = PS_SINGLE; p <= PS_DOUBLE; p++) {
        const ps_precision precision = (ps_precision)p;
        if (ps_pairs_histogram.survey(&of->problem, limits, precision).why_not != NULL) {
            continue;
        }
        const double expected = ps_pairs_histogram_error(&of->problem, limits, precision, 0);
        best = fmin(best, expected);
        if (!(expected <= of->problem.tolerance)) {
            continue;
        }
        free(of->q);
        of->q = NULL;
        PS_TRY(make_histogram(of, precision, error));
        if (of->bound <= of->problem.tolerance) {
            return PSPEC_OK;
        }
        best = of->bound;
    }
    return ps_fail(error, PSPEC_ERROR_TOLERANCE,
                   "sums over pairs by a histogram have an error of %.2g here, and these kernels "
                   "need %.2g",
                   best, of->problem.tolerance);
}

/* ---- chords ------------------------------------------------------------------------------ */

/* The kernel r^(2 power), and what takes its place below rho. */
typedef struct chord {
    double power, rho_square;
    double binomials[TERMS];
    double bound; /* of what bins lose */
} chord;

static double chord_at(const chord *of, double square) {
    return square > 0 ? pow(square, of->power) : 0;
}

static double below_rho(const chord *of, double square) {
    const double x = square / of->rho_square - 1;
    double sum = 0;
    for (int k = TERMS; k-- > 0;) {
        sum = sum * x + of->binomials[k];
    }
    return sum * pow(of->rho_square, of->power);
}

/* |x (x - 1) .. (x - k + 1)| */
static double falling(double x, int k) {
    double out = 1;
    for (int i = 0; i < k; i++) {
        out *= fabs(x - i);
    }
    return out;
}

/* Of g'''''''' below rho, in units of rho^(2 power - 8). */
static double bound_below(const chord *of) {
    double sum = 0;
    for (int j = PS_PAIRS_MOMENTS / 2; j < TERMS; j++) {
        double c = 0;
        double ways = 1; /* binom(k, j) (-1)^(k - j) */
        for (int k = j; k < TERMS; k++) {
            c += of->binomials[k] * ways;
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
static void set_rho(chord *of, size_t num_bins, size_t near_bins) {
    enum { K = PS_PAIRS_MOMENTS };
    const double width = sqrt(2) / (double)num_bins;
    const double rho = width * (double)near_bins;
    double rest = 2; /* 2 (1/4)^K / K!: (1/2)^K / (K! 2^(K-1)) */
    for (int k = 1; k <= K; k++) {
        rest /= 4 * (double)k;
    }
    of->rho_square = rho * rho;
    const double near = fmax(falling(2 * of->power, K), bound_below(of));
    const double scaled = near * pow(rho, 2 * of->power) * pow((double)near_bins, -K);
    of->bound = rest * fmax(scaled, bound_opposite(of->power) * pow(width, K));
}

static chord make_chord(double power, size_t num_bins, double tolerance) {
    chord out = {.power = power, .binomials = {1}};
    size_t near_bins = 1;
    for (int k = 1; k < TERMS; k++) {
        out.binomials[k] = out.binomials[k - 1] * (power - k + 1) / k;
    }
    set_rho(&out, num_bins, near_bins);
    while (out.bound > tolerance && near_bins < num_bins) {
        set_rho(&out, num_bins, ++near_bins);
    }
    return out;
}

/* ---- pairs that are near each other ------------------------------------------------------- */

typedef struct direction {
    long double u[PS_SPHERE_DIMENSION];
    double weight;
    size_t index;
} direction;

static int by_height(const void *a, const void *b) {
    const direction *const x = a;
    const direction *const y = b;
    if (x->u[2] != y->u[2]) {
        return x->u[2] < y->u[2] ? -1 : 1;
    }
    return x->index < y->index ? -1 : x->index > y->index;
}

static void sort_directions(const sums_of_pairs *of, direction *all) {
    const size_t num = of->pattern->num_points;
    for (size_t j = 0; j < num; j++) {
        const double *const u = of->pattern->points + j * PS_SPHERE_DIMENSION;
        const long double x = u[0], y = u[1], z = u[2];
        const long double length = sqrtl(x * x + y * y + z * z);
        all[j] = (direction){{x / length, y / length, z / length}, weight_of(of, j), j};
    }
    qsort(all, num, sizeof *all, by_height);
}

/* What below_rho is off by, over pairs nearer than rho, each once. */
static double add_near(const chord *of, size_t num, const direction *all) {
    const double rho = sqrt(of->rho_square);
    ps_neumaier sum = {0, 0};
    for (size_t i = 0; i < num; i++) {
        for (size_t j = i + 1; j < num && all[j].u[2] - all[i].u[2] < rho; j++) {
            long double square = 0;
            for (int axis = 0; axis < PS_SPHERE_DIMENSION; axis++) {
                const long double step = all[j].u[axis] - all[i].u[axis];
                square += step * step;
            }
            if ((double)square < of->rho_square) {
                const double off = chord_at(of, (double)square) - below_rho(of, (double)square);
                ps_neumaier_add(&sum, all[i].weight * all[j].weight * off);
            }
        }
    }
    return ps_neumaier_value(&sum);
}

/* ---- kernels ----------------------------------------------------------------------------- */

static pspec_status sum_chords(const sums_of_pairs *of, double power, double *sum, double *bound,
                               ps_error *error) {
    const double share = 0.5; /* of the tolerance; rounding has the other half */
    const size_t num_nodes = 2 * of->num_bins * PS_PAIRS_MOMENTS;
    const chord kernel = make_chord(power, of->num_bins, share * of->tolerance);
    ps_neumaier total = {0, 0};
    void *memory = NULL;
    for (size_t i = 0; i < num_nodes; i++) {
        const double t = of->nodes[i];
        const double side = of->nodes[num_nodes + i];
        const double square = side > 0 ? 2 * t : 4 - 2 * t;
        ps_neumaier_add(&total,
                        of->weights[i] * (square < kernel.rho_square ? below_rho(&kernel, square)
                                                                     : chord_at(&kernel, square)));
    }
    PS_TRY(ps_allocate(&memory, of->pattern->num_points, sizeof(direction), "directions", error));
    sort_directions(of, memory);
    ps_neumaier_add(&total, add_near(&kernel, of->pattern->num_points, memory));
    free(memory);
    *sum = 2 * ps_neumaier_value(&total);
    *bound = kernel.bound + pow(4, power) * of->rounding;
    return PSPEC_OK;
}

static void sum_zonal(const sums_of_pairs *of, const ps_isotropic_kernel *kernel, double *sum,
                      double *bound) {
    ps_neumaier total = {0, 0};
    for (size_t l = kernel->num_coefficients; l-- > 0;) {
        ps_neumaier_add(&total, kernel->coefficients[l] * of->q[l]);
    }
    *sum = ps_neumaier_value(&total);
    *bound = size_of_kernel(kernel) * of->bound;
}

static pspec_status check_kernels(const ps_isotropic_kernel *kernels, size_t num_kernels,
                                  ps_error *error) {
    for (size_t k = 0; k < num_kernels; k++) {
        const ps_isotropic_kernel *const one = &kernels[k];
        const double size = size_of_kernel(one);
        if (one->num_coefficients == 0 && !(one->power > 0 && one->power <= 1)) {
            return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                           "kernel %zu: |u - v|^(2 p) with p = %g, which is not above 0 and at "
                           "most 1",
                           k + 1, one->power);
        }
        if (!isfinite(size)) {
            return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                           "kernel %zu has a coefficient that is not finite", k + 1);
        }
    }
    return PSPEC_OK;
}

static pspec_status sum_kernels(sums_of_pairs *of, const ps_isotropic_kernel *kernels,
                                size_t num_kernels, double *sums, double *bounds, ps_error *error) {
    PS_TRY(make_problem(of, kernels, num_kernels, error));
    PS_TRY(fill_histogram(of, error));
    for (size_t k = 0; k < num_kernels; k++) {
        if (kernels[k].num_coefficients > 0) {
            sum_zonal(of, &kernels[k], &sums[k], &bounds[k]);
        } else {
            PS_TRY(sum_chords(of, kernels[k].power, &sums[k], &bounds[k], error));
        }
    }
    return PSPEC_OK;
}

pspec_status ps_pairs_isotropic_sums(ps_device *device, const pspec_pattern *pattern, int exponent,
                                     const ps_isotropic_kernel *kernels, size_t num_kernels,
                                     double tolerance, double *sums, double *bounds,
                                     ps_error *error) {
    sums_of_pairs of = {
        .device = device, .pattern = pattern, .exponent = exponent, .tolerance = tolerance};
    PS_TRY(check_kernels(kernels, num_kernels, error));
    add_weights(&of);
    const pspec_status status = sum_kernels(&of, kernels, num_kernels, sums, bounds, error);
    free(of.q);
    ps_frequencies_free(&of.degrees);
    return status;
}
