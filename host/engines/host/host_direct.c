/* The referee plays in another arithmetic than the device engines: long double terms and sums,
 * library cosines and sines, phases reduced by splitting coordinates instead of fixed point.
 */
#include "engines/host/host_direct.h"

#include "base/memory.h"
#include "math/pi.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* k x mod 1, in [-1/2, 1/2]. x = high + low with high a multiple of 2^-32 (2^-25 where long double
 * is double), so that k high is exact for |k| <= 2^28 and its whole part can be dropped without
 * error; k low is below 2^-5 (4) and rounds at 2^-69 (2^-51). */
static long double reduced_phase(int32_t k, double x) {
    const long double scale = LDBL_MANT_DIG >= 64 ? 4294967296.0L : 33554432.0L;
    const long double high = rintl((long double)x * scale) / scale;
    const long double low = (long double)x - high;
    const long double whole = (long double)k * high;
    return whole - rintl(whole) + (long double)k * low;
}

/* Ten million sorted points add up to a few thousandths, but their partial sums to millions, whose
 * rounding would be larger than that of engines that sum in pairs: Neumaier's sum. */
typedef struct compensated {
    long double sum, rest;
} compensated;

static void add(compensated *total, long double term) {
    const long double sum = total->sum + term;
    total->rest +=
        fabsl(total->sum) >= fabsl(term) ? (total->sum - sum) + term : (term - sum) + total->sum;
    total->sum = sum;
}

void ps_host_sum(const pspec_pattern *pattern, const int32_t *k, long double *re, long double *im) {
    compensated cosines = {0, 0};
    compensated sines = {0, 0};
    for (size_t j = 0; j < pattern->num_points; j++) {
        const double *x = pattern->points + j * pattern->dimension;
        long double turns = 0;
        for (unsigned axis = 0; axis < pattern->dimension; axis++) {
            turns += reduced_phase(k[axis], x[axis]);
        }
        const long double angle = PS_TWO_PI_L * (turns - rintl(turns));
        const long double weight = pattern->weights != NULL ? pattern->weights[j] : 1;
        add(&cosines, weight * cosl(angle));
        add(&sines, weight * sinl(angle));
    }
    *re = cosines.sum + cosines.rest;
    *im = -(sines.sum + sines.rest);
}

/* ---- the engine -------------------------------------------------------------------------- */

typedef struct host_direct {
    const ps_frequencies *frequencies;
    double *power; /* [batch][number of frequencies] */
} host_direct;

static ps_work work_of(const ps_problem *problem) {
    const double realizations =
        problem->num_realizations > 0 ? (double)problem->num_realizations : 1;
    const double num = (double)problem->frequencies->num;
    /* A degree takes a step for every order, each about a tenth of a cosine and a sine. */
    const double step = 0.1;
    const double terms = ps_problem_domain(problem) == PS_ON_SPHERE
                             ? num * problem->frequencies->max_frequency / 2 * step
                             : num;
    return (ps_work){.phases = terms * (double)problem->num_points * realizations,
                     .bytes_per_realization = num * sizeof(double),
                     .largest_buffer_per_realization = num * sizeof(double)};
}

/* Results are handed on as doubles: their rounding, not the sums (below 1e-18), is the error. Where
 * long double is double, k low rounds at 2^-51 turns, 3e-15. */
static double error_at(double mean_power) {
    const double sums = LDBL_MANT_DIG >= 64 ? 1e-18 : 1e-14;
    return sums + DBL_EPSILON / 2 * sqrt(mean_power);
}

static ps_survey survey(const ps_problem *problem, const ps_device_limits *limits,
                        ps_precision precision) {
    (void)limits;
    return (ps_survey){.why_not = precision == PS_EXTENDED ? NULL : "extended precision only",
                       .work = work_of(problem),
                       .error = error_at(ps_expected_power(problem))};
}

static double error_of_state(const void *state, double mean_power, double weight_share) {
    (void)state;
    (void)weight_share;
    return error_at(mean_power);
}

static void destroy(void *state) {
    free(((host_direct *)state)->power);
}

static pspec_status create(void *state, const ps_problem *problem, ps_precision precision,
                           size_t batch, ps_device *device, ps_error *error) {
    host_direct *const self = state;
    size_t num_powers = 0;
    (void)precision;
    (void)device;
    self->frequencies = problem->frequencies;
    return ps_size_multiply(batch, problem->frequencies->num, &num_powers)
               ? PS_NEW(&self->power, num_powers, "the powers of a batch", error)
               : ps_fail(error, PSPEC_ERROR_MEMORY, "%zu realizations of %zu powers are too many",
                         batch, problem->frequencies->num);
}

pspec_status ps_host_power(const pspec_pattern *pattern, const ps_frequencies *set, size_t i,
                           int exponent, long double *power, ps_error *error) {
    long double re = 0;
    long double im = 0;
    if (set->kind == PS_FREQUENCIES_DEGREES) {
        ps_host_degree degree;
        PS_TRY(ps_host_degree_create(&degree, set->vectors[i], error));
        ps_host_degree_sum(&degree, pattern);
        re = sqrtl(ps_host_degree_power(&degree));
        ps_host_degree_free(&degree);
    } else {
        ps_host_sum(pattern, set->vectors + i * set->dimension, &re, &im);
    }
    re = ldexpl(re, -exponent);
    im = ldexpl(im, -exponent);
    *power = re * re + im * im;
    return PSPEC_OK;
}

static ps_rows rows_of(const host_direct *self, size_t num_rows) {
    return (ps_rows){.num_rows = num_rows,
                     .stride = self->frequencies->num,
                     .precision = PS_DOUBLE,
                     .host = self->power};
}

static pspec_status run(void *state, const ps_batch *batch, ps_rows *rows, ps_error *error) {
    host_direct *self = state;
    const ps_frequencies *set = self->frequencies;
    for (size_t r = 0; r < batch->num_patterns; r++) {
        const int exponent = batch->exponents != NULL ? batch->exponents[r] : 0;
        for (size_t i = 0; i < set->num; i++) {
            long double power = 0;
            PS_TRY(ps_batch_go_on(batch, error));
            PS_TRY(ps_host_power(&batch->patterns[r], set, i, exponent, &power, error));
            self->power[r * set->num + i] = (double)(power * batch->scales[r]);
        }
    }
    *rows = rows_of(self, batch->num_patterns);
    return PSPEC_OK;
}

/* Orders of a degree, which lie far apart in the output. */
static void write_degree(const ps_host_degree *degree, int64_t max_degree, double *out) {
    const int64_t l = degree->degree;
    for (int64_t m = 0; m <= l; m++) {
        double *to = out + m * (2 * max_degree + 1 - m) + 2 * l;
        to[0] = (double)degree->sums[m][0];
        to[1] = (double)degree->sums[m][1];
    }
}

static pspec_status degree_coefficients(host_direct *self, const ps_batch *one, ps_rows *rows,
                                        double *out, ps_error *error) {
    const ps_frequencies *set = self->frequencies;
    const int exponent = rows != NULL && one->exponents != NULL ? one->exponents[0] : 0;
    memset(out, 0, ps_num_coefficients(set->max_frequency) * sizeof *out);
    for (int32_t l = 0; l <= set->max_frequency; l += set->degree_step) {
        ps_host_degree degree;
        PS_TRY(ps_batch_go_on(one, error));
        PS_TRY(ps_host_degree_create(&degree, l, error));
        ps_host_degree_sum(&degree, one->patterns);
        write_degree(&degree, set->max_frequency, out);
        if (rows != NULL && l > 0) {
            const long double power = ps_host_degree_power(&degree);
            const long double root = ldexpl(sqrtl(power), -exponent); /* as in ps_host_power */
            self->power[l / set->degree_step - 1] = (double)(root * root * one->scales[0]);
        }
        ps_host_degree_free(&degree);
    }
    if (rows != NULL) {
        *rows = rows_of(self, 1);
    }
    return PSPEC_OK;
}

static pspec_status exponential_coefficients(host_direct *self, const ps_batch *one, ps_rows *rows,
                                             double *out, ps_error *error) {
    const ps_frequencies *set = self->frequencies;
    const int exponent = rows != NULL && one->exponents != NULL ? one->exponents[0] : 0;
    for (size_t i = 0; i < set->num; i++) {
        long double re = 0;
        long double im = 0;
        PS_TRY(ps_batch_go_on(one, error));
        ps_host_sum(one->patterns, set->vectors + i * set->dimension, &re, &im);
        out[2 * i] = (double)re;
        out[2 * i + 1] = (double)im;
        if (rows != NULL) { /* as in ps_host_power */
            re = ldexpl(re, -exponent);
            im = ldexpl(im, -exponent);
            self->power[i] = (double)((re * re + im * im) * one->scales[0]);
        }
    }
    if (rows != NULL) {
        *rows = rows_of(self, 1);
    }
    return PSPEC_OK;
}

static pspec_status coefficients(void *state, const ps_batch *one, ps_rows *rows, double *out,
                                 ps_error *error) {
    host_direct *self = state;
    return self->frequencies->kind == PS_FREQUENCIES_DEGREES
               ? degree_coefficients(self, one, rows, out, error)
               : exponential_coefficients(self, one, rows, out, error);
}

static void describe(const void *state, ps_text *text) {
    (void)state;
    ps_text_append(text, "(host_direct precision=extended digits=%d)", LDBL_DIG);
}

const ps_engine ps_host_direct = {
    .name = "host_direct",
    .domains = PS_ON_TORUS | PS_ON_SPHERE,
    .needs_device = false,
    .has_precision = {false, false, true},
    .survey = survey,
    .error_of_state = error_of_state,
    .state_bytes = sizeof(host_direct),
    .create = create,
    .run = run,
    .coefficients = coefficients,
    .describe = describe,
    .destroy = destroy,
};
