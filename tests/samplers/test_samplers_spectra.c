/* Expected power spectra, docs/mathematics/samplers.md#spectra-on-the-torus, against direct sums
 * over many realizations. */
#include "test_samplers.h"

#include "math/pi.h"

#include <math.h>

/* 2000 realizations give a standard error of 2 % of the power of white noise. A mean 4 standard
 * errors off comes by chance once in 16000; there are about 200 comparisons, with fixed seeds. */
enum { M = 2000, MOST_POINTS = 64 };
static const double SIGMAS = 4;

typedef struct law {
    const char *text;
    size_t num_points;
    unsigned dimension;
    uint64_t strata[PS_MAX_DIMENSION]; /* for those laws that speak of strata */
    double (*expected)(const struct law *, const int *k);
} law;

static double sinc(double x) {
    return x == 0 ? 1 : sin(PS_PI * x) / (PS_PI * x);
}

static double expect_one(const law *l, const int *k) {
    (void)l;
    (void)k;
    return 1;
}

static double expect_jittered(const law *l, const int *k) {
    double product = 1;
    for (unsigned i = 0; i < l->dimension; i++) {
        product *= pow(sinc(k[i] / (double)l->strata[i]), 2);
    }
    return 1 - product;
}

static double expect_latin(const law *l, const int *k) {
    const double n = (double)l->num_points;
    double product = 1;
    for (unsigned i = 0; i < l->dimension; i++) {
        product *= k[i] == 0 ? 1 : -pow(sinc(k[i] / n), 2) / (n - 1);
    }
    return 1 + (n - 1) * product;
}

static double expect_centred_latin(const law *l, const int *k) {
    const double n = (double)l->num_points;
    double product = 1;
    for (unsigned i = 0; i < l->dimension; i++) {
        product *= k[i] % (int)l->num_points == 0 ? 1 : -1 / (n - 1);
    }
    return 1 + (n - 1) * product;
}

static double expect_regular(const law *l, const int *k) {
    for (unsigned i = 0; i < l->dimension; i++) {
        if (k[i] % (int)l->strata[i] != 0) {
            return 0;
        }
    }
    return (double)l->num_points;
}

/* Nested scrambling of a (0,m,1)-net puts one independent uniform point into each stratum. */
static double expect_owen_line(const law *l, const int *k) {
    return 1 - pow(sinc(k[0] / (double)l->num_points), 2);
}

static const law LAWS[] = {
    {"white", 16, 2, {0}, expect_one},
    {"jittered", 13, 1, {13}, expect_jittered},
    {"jittered", 16, 2, {4, 4}, expect_jittered},
    {"jittered", 12, 2, {3, 4}, expect_jittered},
    {"jittered:strata=2x9", 18, 2, {2, 9}, expect_jittered},
    {"jittered", 12, 3, {2, 2, 3}, expect_jittered},
    {"jittered", 64, 6, {2, 2, 2, 2, 2, 2}, expect_jittered},
    {"regular", 12, 2, {3, 4}, expect_regular},
    {"regular", 27, 3, {3, 3, 3}, expect_regular},
    {"latin-hypercube", 8, 2, {0}, expect_latin},
    {"latin-hypercube", 5, 3, {0}, expect_latin},
    {"latin-hypercube:offset=centred", 4, 2, {0}, expect_centred_latin},
    {"latin-hypercube:offset=centred", 3, 3, {0}, expect_centred_latin},
    {"sobol:scramble=xor", 16, 1, {16}, expect_regular},
    {"sobol:scramble=owen", 16, 1, {0}, expect_owen_line},
    {"sobol:scramble=owen", 2, 1, {0}, expect_owen_line},
    {"sobol:scramble=owen", 64, 1, {0}, expect_owen_line},
    {"sobol:scramble=hash", 16, 1, {0}, expect_owen_line},
    /* Two points in opposite halves of every axis, axes independent: a Latin hypercube. */
    {"sobol:scramble=owen", 2, 2, {0}, expect_latin},
    {"sobol:scramble=owen", 2, 6, {0}, expect_latin},
};

/* Axes, diagonals, signs, and multiples of the small strata above. */
static const int FREQUENCIES[][PS_MAX_DIMENSION] = {
    {1, 0, 0, 0, 0, 0}, {0, 1, 0, 0, 0, 0},  {1, 1, 0, 0, 0, 0},  {1, -1, 0, 0, 0, 0},
    {2, 1, 1, 0, 0, 0}, {3, -4, 0, 1, 0, 0}, {4, 0, 0, 0, 0, 0},  {3, 3, 3, 0, 0, 0},
    {0, 0, 1, 0, 0, 0}, {4, 8, 0, 0, 0, 0},  {5, -5, 0, 0, 0, 0}, {0, 7, 0, 0, 0, 0},
    {1, 1, 1, 1, 1, 1}, {6, 4, 0, 0, 0, 2},  {16, 0, 0, 0, 0, 0}, {33, 0, 0, 0, 0, 0},
};
enum { NUM_FREQUENCIES = sizeof FREQUENCIES / sizeof FREQUENCIES[0] };

static bool is_dc(const int *k, unsigned dimension) {
    for (unsigned i = 0; i < dimension; i++) {
        if (k[i] != 0) {
            return false;
        }
    }
    return true;
}

static double power(const law *l, const double *points, const int *k) {
    double re = 0;
    double im = 0;
    for (size_t j = 0; j < l->num_points; j++) {
        double phase = 0;
        for (unsigned i = 0; i < l->dimension; i++) {
            phase += k[i] * points[j * l->dimension + i];
        }
        re += cos(PS_TWO_PI * phase);
        im += sin(PS_TWO_PI * phase);
    }
    return (re * re + im * im) / (double)l->num_points;
}

static void assert_mean(const law *l, const int *k, double sum, double sum_of_squares) {
    const double mean = sum / M;
    const double variance = fmax(sum_of_squares / M - mean * mean, 0);
    const double expected = l->expected(l, k);
    const double rounding = 1e-12 * (double)l->num_points; /* where the power does not vary */
    if (!(fabs(mean - expected) <= SIGMAS * sqrt(variance / (M - 1)) + rounding)) {
        fail_msg("%s, N = %zu, d = %u, k = (%d, %d, %d ..): %g is not %g (standard error %g)",
                 l->text, l->num_points, l->dimension, k[0], k[1], k[2], mean, expected,
                 sqrt(variance / (M - 1)));
    }
}

static void assert_law(const law *l, bool homogenize, uint64_t seed) {
    double sums[NUM_FREQUENCIES][2] = {{0}};
    double points[MOST_POINTS * PS_MAX_DIMENSION];
    ps_sampler_request request = make_request(l->text, l->num_points, l->dimension);
    request.homogenize = homogenize;
    request.seed = seed;
    for (uint64_t r = 0; r < M; r++) {
        generate_into(&request, r, points);
        for (unsigned f = 0; f < NUM_FREQUENCIES; f++) {
            const double p = power(l, points, FREQUENCIES[f]);
            sums[f][0] += p;
            sums[f][1] += p * p;
        }
    }
    for (unsigned f = 0; f < NUM_FREQUENCIES; f++) {
        if (!is_dc(FREQUENCIES[f], l->dimension)) {
            assert_mean(l, FREQUENCIES[f], sums[f][0], sums[f][1]);
        }
    }
}

static void spectra_obey_their_laws(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof LAWS / sizeof LAWS[0]; i++) {
        assert_law(&LAWS[i], false, 1);
    }
}

static void a_random_shift_leaves_the_laws_unchanged(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof LAWS / sizeof LAWS[0]; i++) {
        assert_law(&LAWS[i], true, 2);
    }
}

/* For each realization, not only on average. */
static void a_random_shift_leaves_each_power_unchanged(void **state) {
    (void)state;
    const law l = {.num_points = 64, .dimension = 2};
    ps_sampler_request request = make_request("sobol:scramble=owen", 64, 2);
    for (uint64_t r = 0; r < 20; r++) {
        double plain[MOST_POINTS * 2];
        double shifted[MOST_POINTS * 2];
        request.homogenize = false;
        generate_into(&request, r, plain);
        request.homogenize = true;
        generate_into(&request, r, shifted);
        for (unsigned f = 0; f < NUM_FREQUENCIES; f++) {
            const double difference =
                power(&l, plain, FREQUENCIES[f]) - power(&l, shifted, FREQUENCIES[f]);
            assert_true(fabs(difference) < 1e-11);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spectra_obey_their_laws),
        cmocka_unit_test(a_random_shift_leaves_the_laws_unchanged),
        cmocka_unit_test(a_random_shift_leaves_each_power_unchanged),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
