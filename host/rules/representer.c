#include "rules/representer.h"

#include "base/memory.h"
#include "base/wide.h"
#include "base/workers.h"
#include "math/neumaier.h"
#include "math/pi.h"
#include "math/sobolev.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

void ps_representer_destroy(ps_representer *representer) {
    free(representer->a);
    *representer = (ps_representer){0};
}

pspec_status ps_representer_check(const ps_representer *representer, size_t max_degree,
                                  ps_error *error) {
    return max_degree <= representer->max_degree
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "degree %zu was asked for of a lobe whose coefficients end at %zu",
                         max_degree, representer->max_degree);
}

/* ---- how many degrees ---------------------------------------------------------------------- */

/* The terms of kappa at the pole have changing signs: what is left is about as large as the largest
 * of the last ones. At the horizon, where lobes begin, even ones have one sign and add up: the
 * second half of them falls like a power of more than 2s + 1, so that what is left is less than 1 /
 * (2^(2s) - 1) of it. tests/rules/test_representer.c compares both with integrals. */
static double estimate_truncation(const ps_representer *representer) {
    const size_t last = representer->max_degree;
    double pole = 0;
    double horizon = 0;
    double legendre = 1; /* P_l(0) for even l */
    for (size_t l = 0; l <= last; l++) {
        const double degree = (double)l;
        if (l % 2 == 0) {
            legendre *= l > 0 ? -(degree - 1) / degree : 1;
            horizon += l > last / 2 ? representer->series[l] * legendre : 0;
        }
        pole = l >= last - last / 16 ? fmax(pole, fabs(representer->series[l])) : pole;
    }
    return fmax(pole, fabs(horizon) / (exp2(2 * representer->smoothness) - 1));
}

/* sum b_l^2 beyond the arrays, by subtraction. */
static double energy_left(const ps_representer *representer) {
    ps_neumaier sum = {representer->energy, 0};
    for (size_t l = 0; l <= representer->max_degree; l++) {
        ps_neumaier_add(&sum, -representer->b[l] * representer->b[l]);
    }
    return ps_neumaier_value(&sum);
}

double ps_representer_rest(const ps_representer *representer, size_t max_degree,
                           double *half_width) {
    /* Less than this is what rounding of the coefficients leaves: a smooth lobe has nothing
     * there. */
    const double rounding = 16 * DBL_EPSILON * representer->energy;
    const size_t last = representer->max_degree;
    const double left = energy_left(representer);
    const double most = representer->a[last + 1] * fmax(left, rounding);
    *half_width = left > rounding ? most / 2 : most;
    ps_neumaier sum = {left > rounding ? most / 2 : 0, 0};
    for (size_t l = last; l > max_degree; l--) { /* small ones first */
        ps_neumaier_add(&sum, representer->a[l] * representer->b[l] * representer->b[l]);
    }
    return ps_neumaier_value(&sum);
}

static void fill_series(ps_representer *representer) {
    for (size_t l = 0; l <= representer->max_degree + 1; l++) {
        const double degree = (double)l;
        const bool is_term = l <= representer->max_degree;
        representer->series[l] =
            is_term ? representer->a[l] * representer->b[l] * sqrt((2 * degree + 1) / PS_FOUR_PI)
                    : 0;
        representer->factors[2 * l] = degree / (degree + 1);
        representer->factors[2 * l + 1] = (2 * degree + 1) / (degree + 1);
    }
}

static pspec_status fill(ps_representer *representer, const ps_brdf *brdf, size_t max_degree,
                         ps_error *error) {
    enum { ARRAYS = 5 };
    double *block = NULL;
    PS_TRY(PS_NEW(&block, ARRAYS * (max_degree + 2), "coefficients of a BRDF", error));
    free(representer->a);
    representer->a = block;
    representer->b = representer->a + max_degree + 2;
    representer->series = representer->b + max_degree + 2;
    representer->factors = representer->series + max_degree + 2;
    representer->max_degree = max_degree;
    representer->num_terms = max_degree + 1;
    ps_sobolev_eigenvalues(representer->smoothness, max_degree + 1, representer->a);
    PS_TRY(ps_brdf_spherical(brdf, max_degree, representer->b, error));
    fill_series(representer);
    representer->kappa_estimate = estimate_truncation(representer);
    representer->kappa_0 = representer->a[0] * representer->b[0] * representer->b[0] +
                           ps_representer_rest(representer, 0, &representer->kappa_0_error);
    return PSPEC_OK;
}

pspec_status ps_representer_create(ps_representer *out, const ps_brdf *brdf, double smoothness,
                                   double tolerance, size_t min_degree, ps_error *error) {
    enum { FIRST = 64 };
    *out = (ps_representer){0};
    PS_TRY(ps_sobolev_check(smoothness, error));
    *out = (ps_representer){.smoothness = smoothness,
                            .constant = ps_sobolev_constant(smoothness),
                            .energy = ps_brdf_energy(brdf)};
    const bool is_closed = ps_brdf_mean_distance(brdf, smoothness, &out->d_0);
    size_t degree = min_degree > FIRST ? min_degree : FIRST;
    PS_TRY(fill(out, brdf, degree, error));
    while (degree < PS_MOST_REPRESENTER_DEGREE &&
           (out->kappa_estimate > tolerance || (!is_closed && out->kappa_0_error > tolerance))) {
        degree += degree / 2;
        degree = degree < PS_MOST_REPRESENTER_DEGREE ? degree : PS_MOST_REPRESENTER_DEGREE;
        PS_TRY(fill(out, brdf, degree, error));
    }
    if (is_closed) {
        out->kappa_0 = out->constant - out->d_0;
        out->kappa_0_error = 0;
    } else {
        out->d_0 = out->constant - out->kappa_0;
    }
    const double tail = ps_sobolev_tail(smoothness, degree, out->a[degree + 1]);
    double half_width = 0;
    const double rest = ps_representer_rest(out, degree, &half_width);
    out->kappa_bound = sqrt(tail * (rest + half_width));
    return PSPEC_OK;
}

/* ---- terms that kappa does not need ---------------------------------------------------------- */

/* Terms behind the last that is needed; what they are together is added to *dropped. */
static size_t count_needed(const double *series, size_t num, double error, double *dropped) {
    double sum = 0;
    while (num > 1 && sum + fabs(series[num - 1]) <= error) {
        sum += fabs(series[--num]);
    }
    *dropped = sum;
    return num;
}

static bool is_even_above_1(const ps_representer *representer) {
    bool is_even = true;
    for (size_t l = 3; l <= representer->max_degree; l += 2) {
        is_even = is_even && representer->b[l] == 0;
    }
    return is_even;
}

/* P_2k(z) is the Jacobi polynomial P_k^(0,-1/2)(2 z^2 - 1), whose recurrence of differences has the
 * form of that of P_l, with 2 (1 - z^2) for 1 - z: half as many steps. */
static void keep_even(ps_representer *representer) {
    const size_t num = representer->max_degree / 2 + 1;
    representer->only_even = true;
    representer->first = representer->series[1];
    for (size_t k = 0; k < num; k++) {
        const double n = (double)k;
        const double up = (n + 1) * (2 * n + 1) / ((2 * n + 0.5) * (2 * n + 1.5));
        const double down = k > 0 ? n * (2 * n - 1) / ((2 * n - 0.5) * (2 * n + 0.5)) : 0;
        representer->series[k] = representer->series[2 * k];
        representer->factors[2 * k] = down / up;
        representer->factors[2 * k + 1] = 1 / up;
    }
    representer->series[num] = 0; /* steps are taken in twos */
    representer->num_terms = num;
}

void ps_representer_skip(ps_representer *representer, double error) {
    double dropped = 0;
    if (is_even_above_1(representer)) {
        keep_even(representer);
    }
    const size_t num = count_needed(representer->series, representer->num_terms, error, &dropped);
    representer->series[num] = 0;
    representer->num_terms = num;
    representer->kappa_estimate += dropped;
    representer->kappa_bound += dropped;
}

/* ---- kappa --------------------------------------------------------------------------------- */

/* Points that go through the recurrence side by side. */
enum { LANES = 16 };

/* Degrees that are added up before they meet the sum: at the horizon thousands of small terms of
 * one sign would be rounded away one by one. Even. */
enum { RUN_DEGREES = 64 };

/* *sum += value, with what is rounded away in *low. */
static inline void add_two(double *sum, double *low, double value) {
    const double total = *sum + value;
    const double part = total - *sum;
    *low += (*sum - (total - part)) + (value - part);
    *sum = total;
}

/* sum_l series_l P_l(1 - t) over even and over odd l, in the difference form of
 * docs/mathematics/numerics.md#legendre-sums. Arrays of the function's own let the compiler see
 * that nothing overlaps. */
PS_WIDE_BODY(size_t, sum_series,
             (size_t num_degrees, const double *series, const double *factors,
              const double *heights, double *even_sums, double *odd_sums)) {
    double p[LANES];
    double d[LANES];
    double t[LANES];
    double even[LANES] = {0};
    double odd[LANES] = {0};
    double even_low[LANES] = {0};
    double odd_low[LANES] = {0};
    for (int i = 0; i < LANES; i++) {
        p[i] = 1;
        d[i] = 0;
        t[i] = heights[i];
    }
    for (size_t first = 0; first < num_degrees; first += RUN_DEGREES) {
        const size_t end = first + RUN_DEGREES < num_degrees ? first + RUN_DEGREES : num_degrees;
        double even_run[LANES] = {0};
        double odd_run[LANES] = {0};
        for (size_t l = first; l < end; l += 2) {
            const double *const keep = factors + 2 * l;
            for (int i = 0; i < LANES; i++) {
                even_run[i] += series[l] * p[i];
                d[i] = keep[0] * d[i] - keep[1] * t[i] * p[i];
                p[i] += d[i];
                odd_run[i] += series[l + 1] * p[i];
                d[i] = keep[2] * d[i] - keep[3] * t[i] * p[i];
                p[i] += d[i];
            }
        }
        for (int i = 0; i < LANES; i++) {
            add_two(&even[i], &even_low[i], even_run[i]);
            add_two(&odd[i], &odd_low[i], odd_run[i]);
        }
    }
    for (int i = 0; i < LANES; i++) {
        even_sums[i] = even[i] + even_low[i];
        odd_sums[i] = odd[i] + odd_low[i];
    }
    return num_degrees;
}

PS_WIDE(size_t, sum_series,
        (size_t num_degrees, const double *series, const double *factors, const double *heights,
         double *even_sums, double *odd_sums),
        (num_degrees, series, factors, heights, even_sums, odd_sums))

typedef struct kappa_work {
    const ps_representer *representer;
    size_t num;
    const double *points;
    double *kappa;
} kappa_work;

static void do_block(const kappa_work *work, size_t first) {
    const ps_representer *const representer = work->representer;
    double t[LANES] = {0};
    double even[LANES];
    double odd[LANES];
    const size_t num = work->num - first < LANES ? work->num - first : LANES;
    for (size_t i = 0; i < num; i++) {
        const double *const u = work->points + 3 * (first + i);
        const double square = u[0] * u[0] + u[1] * u[1];
        t[i] = representer->only_even ? 2 * square : square / (1 + fabs(u[2]));
    }
    sum_series(representer->num_terms, representer->series, representer->factors, t, even, odd);
    for (size_t i = 0; i < num; i++) {
        const double z = work->points[3 * (first + i) + 2];
        work->kappa[first + i] = representer->only_even ? even[i] + odd[i] + representer->first * z
                                 : z < 0                ? even[i] - odd[i]
                                                        : even[i] + odd[i];
    }
}

static void do_share(void *payload, unsigned index, unsigned count) {
    const kappa_work *const work = payload;
    const size_t num_blocks = (work->num + LANES - 1) / LANES;
    const size_t end = ps_share_begin(num_blocks, index + 1, count);
    for (size_t i = ps_share_begin(num_blocks, index, count); i < end; i++) {
        do_block(work, i * LANES);
    }
}

void ps_representer_kappa(const ps_representer *representer, size_t num, const double *points,
                          double *kappa) {
    const kappa_work work = {
        .representer = representer, .num = num, .points = points, .kappa = kappa};
    ps_workers_share(num * representer->num_terms, do_share, (void *)&work);
}
