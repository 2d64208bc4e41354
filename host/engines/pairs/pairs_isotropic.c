#include "engines/pairs/pairs_isotropic.h"

#include "base/memory.h"
#include "engines/pairs/pairs_bins.h"
#include "engines/pairs/pairs_chord.h"
#include "engines/pairs/pairs_histogram.h"
#include "math/neumaier.h"

#include <math.h>
#include <stdlib.h>

/* Degrees of the histogram at least: few pairs are nearer than some of its bins then. */
enum { LEAST_DEGREES = 64 };

typedef struct sums_of_pairs {
    ps_device *device;
    const pspec_pattern *pattern;
    int exponent;
    double tolerance;
    const ps_watch *watch; /* or NULL */
    uint64_t num_slabs;    /* that the engine has begun */
    ps_frequencies degrees;
    ps_problem problem;
    double weight_sum, weight_size, weight_square; /* W, sum |w|, sum w^2 */
    double *q;                                     /* [L + 1] */
    size_t num_bins;
    double *nodes, *weights; /* t and side, [2][num_nodes]; [num_nodes] */
    double rounding, bound;  /* of Q(l), in (sum |w|)^2: without and with what bins lose */
} sums_of_pairs;

/* ---- weights ----------------------------------------------------------------------------- */

static double weight_of(const sums_of_pairs *self, size_t j) {
    return self->pattern->weights != NULL ? ldexp(self->pattern->weights[j], -self->exponent)
                                          : ldexp(1, -self->exponent);
}

static void add_weights(sums_of_pairs *self) {
    ps_neumaier sum = {0, 0}, size = {0, 0}, square = {0, 0};
    for (size_t j = 0; j < self->pattern->num_points; j++) {
        const double weight = weight_of(self, j);
        ps_neumaier_add(&sum, weight);
        ps_neumaier_add(&size, fabs(weight));
        ps_neumaier_add(&square, weight * weight);
    }
    self->weight_sum = ps_neumaier_value(&sum);
    self->weight_size = ps_neumaier_value(&size);
    self->weight_square = ps_neumaier_value(&square);
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

static pspec_status make_problem(sums_of_pairs *self, const ps_isotropic_kernel *kernels,
                                 size_t num_kernels, ps_error *error) {
    const double share = 0.5; /* of the tolerance; the other half is for what is below rho */
    const double root = sqrt((double)self->pattern->num_points);
    int64_t last = root > LEAST_DEGREES ? (int64_t)root : LEAST_DEGREES;
    double largest = 1;
    for (size_t k = 0; k < num_kernels; k++) {
        const int64_t num = (int64_t)kernels[k].num_coefficients;
        last = num - 1 > last ? num - 1 : last;
        largest = fmax(largest, size_of_kernel(&kernels[k]));
    }
    PS_TRY(ps_frequencies_degrees(&self->degrees, last, false, error));
    PS_TRY(ps_frequencies_enumerate(&self->degrees, error));
    self->problem =
        (ps_problem){.frequencies = &self->degrees,
                     .num_points = self->pattern->num_points,
                     .num_realizations = 1,
                     .has_weights = true,
                     .measure = PS_OF_PAIR_SUMS,
                     .tolerance = fmin(share * self->tolerance / largest, 1),
                     .weight_share = self->weight_square / (self->weight_size * self->weight_size)};
    return PSPEC_OK;
}

static pspec_status allocate(sums_of_pairs *self, ps_error *error) {
    const size_t num_nodes = 2 * self->num_bins * PS_PAIRS_MOMENTS;
    const size_t num_degrees = (size_t)self->degrees.max_frequency + 1;
    PS_TRY(PS_NEW(&self->q, num_degrees + 3 * num_nodes, "a histogram", error));
    self->nodes = self->q + num_degrees;
    self->weights = self->nodes + 2 * num_nodes;
    ps_pairs_bins_nodes(self->num_bins, self->nodes);
    return PSPEC_OK;
}

/* Of the engine's slabs, whose number is its own affair, those are counted that it asks for. */
static bool should_stop(void *payload) {
    sums_of_pairs *const self = payload;
    const bool stops = ps_watch_tell(self->watch, "slabs of pairs of points", self->num_slabs, 0,
                                     NULL, NULL) != PSPEC_OK;
    self->num_slabs += stops ? 0 : 1;
    return stops;
}

static pspec_status run_engine(sums_of_pairs *self, void *state, ps_precision precision,
                               ps_error *error) {
    const double scale = 1;
    const ps_batch batch = {.num_patterns = 1,
                            .patterns = self->pattern,
                            .scales = &scale,
                            .exponents = &self->exponent,
                            .should_stop = self->watch != NULL ? should_stop : NULL,
                            .payload = self};
    const int32_t last = self->degrees.max_frequency;
    pspec_status status = PSPEC_OK;
    ps_rows rows;
    self->num_bins = ps_pairs_histogram_num_bins(state);
    PS_TRY(allocate(self, error));
    PS_TRY_OUT(status, ps_pairs_histogram.run(state, &batch, &rows, error));
    PS_TRY_OUT(status, ps_rows_wait(&rows, error));
out:
    if (status == PSPEC_ERROR_CANCELLED) {
        return ps_fail(error, status, "interrupted after %llu slabs of pairs of points",
                       (unsigned long long)self->num_slabs);
    }
    PS_TRY(status);
    PS_TRY(ps_pairs_histogram_weights(state, self->weights, error));
    self->q[0] = self->weight_sum * self->weight_sum;
    double mean_power = 0;
    for (int32_t l = 1; l <= last; l++) {
        self->q[l] = rows.host[l - 1];
        mean_power += self->q[l] / self->weight_square / last;
    }
    self->bound = ps_pairs_histogram_error(&self->problem, ps_device_get_limits(self->device),
                                           precision, mean_power);
    self->rounding = self->bound - ps_pairs_bins_bound(last, self->num_bins);
    return PSPEC_OK;
}

static pspec_status make_histogram(sums_of_pairs *self, ps_precision precision, ps_error *error) {
    void *state = NULL;
    PS_TRY(ps_pairs_histogram.create(&state, &self->problem, precision, 1, self->device, error));
    const pspec_status status = run_engine(self, state, precision, error);
    ps_pairs_histogram.destroy(state);
    return status;
}

/* Fills the histogram in the cheapest precision whose error is within the tolerance, also with the
 * powers that are measured. */
static pspec_status fill_histogram(sums_of_pairs *self, ps_error *error) {
    const ps_device_limits *const limits = ps_device_get_limits(self->device);
    double best = INFINITY;
    for (int p = PS_SINGLE; p <= PS_DOUBLE; p++) {
        const ps_precision precision = (ps_precision)p;
        if (ps_pairs_histogram.survey(&self->problem, limits, precision).why_not != NULL) {
            continue;
        }
        const double expected = ps_pairs_histogram_error(&self->problem, limits, precision, 0);
        best = fmin(best, expected);
        if (!(expected <= self->problem.tolerance)) {
            continue;
        }
        free(self->q);
        self->q = NULL;
        PS_TRY(make_histogram(self, precision, error));
        if (self->bound <= self->problem.tolerance) {
            return PSPEC_OK;
        }
        best = self->bound;
    }
    return ps_fail(error, PSPEC_ERROR_TOLERANCE,
                   "sums over pairs by a histogram have an error of %.2g here, and these kernels "
                   "need %.2g",
                   best, self->problem.tolerance);
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

static void sort_directions(const sums_of_pairs *self, direction *all) {
    const size_t num = self->pattern->num_points;
    for (size_t j = 0; j < num; j++) {
        const double *const u = self->pattern->points + j * PS_SPHERE_DIMENSION;
        const long double x = u[0], y = u[1], z = u[2];
        const long double length = sqrtl(x * x + y * y + z * z);
        all[j] = (direction){{x / length, y / length, z / length}, weight_of(self, j), j};
    }
    qsort(all, num, sizeof *all, by_height);
}

/* Adds what ps_chord_below_rho is off by, over pairs nearer than rho, each once. */
static pspec_status add_near(const ps_chord *shape, size_t num, const direction *all,
                             const ps_watch *watch, ps_neumaier *total, ps_error *error) {
    enum { PAIRS_AT_A_TIME = 1 << 22 }; /* some hundredths of a second */
    const double rho = sqrt(shape->rho_square);
    ps_neumaier sum = {0, 0};
    uint64_t pairs = 0;
    for (size_t i = 0; i < num; i++) {
        if (pairs >= PAIRS_AT_A_TIME) {
            PS_TRY(ps_watch_tell(watch, "points with their neighbours", i, num, NULL, error));
            pairs = 0;
        }
        for (size_t j = i + 1; j < num && all[j].u[2] - all[i].u[2] < rho; j++, pairs++) {
            long double square = 0;
            for (int axis = 0; axis < PS_SPHERE_DIMENSION; axis++) {
                const long double step = all[j].u[axis] - all[i].u[axis];
                square += step * step;
            }
            if ((double)square < shape->rho_square) {
                const double off = ps_chord_power(shape, (double)square) -
                                   ps_chord_below_rho(shape, (double)square);
                ps_neumaier_add(&sum, all[i].weight * all[j].weight * off);
            }
        }
    }
    ps_neumaier_add(total, ps_neumaier_value(&sum));
    return PSPEC_OK;
}

/* ---- kernels ----------------------------------------------------------------------------- */

static pspec_status sum_chords(const sums_of_pairs *self, double power, double *sum, double *bound,
                               ps_error *error) {
    const double share = 0.5; /* of the tolerance; rounding has the other half */
    const size_t num_nodes = 2 * self->num_bins * PS_PAIRS_MOMENTS;
    const ps_chord kernel = ps_chord_make(power, self->num_bins, share * self->tolerance);
    ps_neumaier total = {0, 0};
    direction *directions = NULL;
    for (size_t i = 0; i < num_nodes; i++) {
        const double t = self->nodes[i];
        const double side = self->nodes[num_nodes + i];
        const double square = side > 0 ? 2 * t : 4 - 2 * t;
        ps_neumaier_add(&total, self->weights[i] * (square < kernel.rho_square
                                                        ? ps_chord_below_rho(&kernel, square)
                                                        : ps_chord_power(&kernel, square)));
    }
    PS_TRY(PS_NEW(&directions, self->pattern->num_points, "directions", error));
    sort_directions(self, directions);
    const pspec_status status =
        add_near(&kernel, self->pattern->num_points, directions, self->watch, &total, error);
    free(directions);
    *sum = 2 * ps_neumaier_value(&total);
    *bound = kernel.bound + pow(4, power) * self->rounding;
    return status;
}

static void sum_zonal(const sums_of_pairs *self, const ps_isotropic_kernel *kernel, double *sum,
                      double *bound) {
    ps_neumaier total = {0, 0};
    for (size_t l = kernel->num_coefficients; l-- > 0;) {
        ps_neumaier_add(&total, kernel->coefficients[l] * self->q[l]);
    }
    *sum = ps_neumaier_value(&total);
    *bound = size_of_kernel(kernel) * self->bound;
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

static pspec_status sum_kernels(sums_of_pairs *self, const ps_isotropic_kernel *kernels,
                                size_t num_kernels, double *sums, double *bounds, ps_error *error) {
    PS_TRY(make_problem(self, kernels, num_kernels, error));
    PS_TRY(fill_histogram(self, error));
    for (size_t k = 0; k < num_kernels; k++) {
        if (kernels[k].num_coefficients > 0) {
            sum_zonal(self, &kernels[k], &sums[k], &bounds[k]);
        } else {
            PS_TRY(sum_chords(self, kernels[k].power, &sums[k], &bounds[k], error));
        }
    }
    return PSPEC_OK;
}

pspec_status ps_pairs_isotropic_sums(ps_device *device, const pspec_pattern *pattern, int exponent,
                                     const ps_isotropic_kernel *kernels, size_t num_kernels,
                                     double tolerance, double *sums, double *bounds,
                                     const ps_watch *watch, ps_error *error) {
    sums_of_pairs self = {.device = device,
                          .pattern = pattern,
                          .exponent = exponent,
                          .tolerance = tolerance,
                          .watch = watch};
    PS_TRY(check_kernels(kernels, num_kernels, error));
    add_weights(&self);
    const pspec_status status = sum_kernels(&self, kernels, num_kernels, sums, bounds, error);
    free(self.q);
    ps_frequencies_free(&self.degrees);
    return status;
}
