/* Where integrands end, and their transforms at any |k|: what lies beyond the reach is rounding,
 * and little less than the reach would not do. */
#include "harness.h"

#include "integrands/integrand.h"
#include "math/gauss_legendre.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>

static ps_integrand *parse(const char *text, ps_sampler_domain where, unsigned dimension) {
    ps_integrand *integrand = NULL;
    ps_error error = {0};
    const ps_integrand_place place = {where, dimension};
    if (ps_integrand_parse(&integrand, text, place, &error) != PSPEC_OK) {
        fail_msg("%s: %s", text, error.message);
    }
    return integrand;
}

/* ---- the torus ----------------------------------------------------------------------------- */

/* Sum of the powers with from < max |k_i| <= to. */
static double sum_between(const ps_integrand *integrand, int32_t from, int32_t to) {
    const unsigned dimension = integrand->place.dimension;
    int32_t k[3] = {-to, -to, -to};
    long double sum = 0;
    for (unsigned axis = 0; axis < dimension;) {
        int32_t largest = 0;
        for (unsigned i = 0; i < dimension; i++) {
            largest = abs(k[i]) > largest ? abs(k[i]) : largest;
        }
        if (largest > from) {
            double power = 0;
            assert_int_equal(ps_integrand_powers(integrand, k, 1, &power, NULL), PSPEC_OK);
            sum += power;
        }
        for (axis = 0; axis < dimension && k[axis] == to; axis++) {
            k[axis] = -to;
        }
        if (axis < dimension) {
            k[axis]++;
            axis = 0;
        }
    }
    return (double)sum;
}

static void gaussians(void **state) {
    static const struct {
        const char *text;
        unsigned dimension;
    } cases[] = {{"gaussian:sigma=0.0625", 1}, {"gaussian:sigma=0.0625", 2},
                 {"gaussian:sigma=0.3", 2},    {"gaussian:sigma=1", 2},
                 {"gaussian:sigma=0.2", 3},    {"gaussian:sigma=0.05", 2}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        ps_integrand *const f = parse(cases[i].text, PS_SAMPLES_TORUS, cases[i].dimension);
        const int32_t reach = (int32_t)ps_integrand_reach(f);
        const double energy = sum_between(f, 0, reach);
        const double beyond = sum_between(f, reach, 2 * reach + 2);
        if (beyond > PS_BEYOND_REACH * energy) {
            fail_msg("%s: %g of the energy beyond %d", cases[i].text, beyond / energy, (int)reach);
        }
        /* one less would not do */
        if (reach > 1 && sum_between(f, reach - 1, 2 * reach + 2) <= PS_BEYOND_REACH * energy) {
            fail_msg("%s: %d is too far", cases[i].text, (int)reach);
        }
        ps_integrand_destroy(f);
    }
}

/* ---- the sphere ---------------------------------------------------------------------------- */

static void lobes(void **state) {
    static const struct {
        const char *text;
        ps_sampler_domain where;
    } cases[] = {{"lobe:n=0.001", PS_SAMPLES_SPHERE},       {"lobe:n=1", PS_SAMPLES_SPHERE},
                 {"lobe:n=30", PS_SAMPLES_SPHERE},          {"lobe:n=3000", PS_SAMPLES_SPHERE},
                 {"lobe:n=40", PS_SAMPLES_HEMISPHERE},      {"lobe:n=1000", PS_SAMPLES_HEMISPHERE},
                 {"glossy:n=50", PS_SAMPLES_SPHERE},        {"glossy:n=50", PS_SAMPLES_HEMISPHERE},
                 {"glossy:n=3,cut=none", PS_SAMPLES_SPHERE}};
    enum { MORE = 400 };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        ps_integrand *const f = parse(cases[i].text, cases[i].where, 3);
        const size_t reach = (size_t)ps_integrand_reach(f);
        double *const powers = calloc(reach + MORE + 1, sizeof *powers);
        assert_non_null(powers);
        assert_int_equal(ps_integrand_degrees(f, reach + MORE, powers, NULL), PSPEC_OK);
        double sum = 0;
        size_t least = reach + MORE; /* that would do */
        while (sum + powers[least] <= PS_BEYOND_REACH * ps_integrand_energy(f)) {
            sum += powers[least--];
        }
        if (least > reach || reach > least + 3 + least / 50) {
            fail_msg("%s: reach %zu, %zu would do", cases[i].text, reach, least);
        }
        free(powers);
        ps_integrand_destroy(f);
    }
}

/* ---- exact and endless ones ---------------------------------------------------------------- */

typedef struct known {
    const char *text;
    ps_sampler_domain where;
    double reach;
} known;

static void others(void **state) {
    static const known cases[] = {{"wave:k=3x-7", PS_SAMPLES_TORUS, 7},
                                  {"wave:k=-268435456x1", PS_SAMPLES_TORUS, 268435456},
                                  {"constant", PS_SAMPLES_TORUS, 0},
                                  {"constant", PS_SAMPLES_SPHERE, 0},
                                  {"harmonic:degree=9", PS_SAMPLES_SPHERE, 9},
                                  {"harmonic:degree=8", PS_SAMPLES_HEMISPHERE, 8},
                                  {"square", PS_SAMPLES_SPHERE, 2},
                                  {"square", PS_SAMPLES_HEMISPHERE, 2},
                                  {"phong:n=6", PS_SAMPLES_HEMISPHERE, 6},
                                  {"phong:n=7", PS_SAMPLES_HEMISPHERE, INFINITY},
                                  {"phong:n=6.5", PS_SAMPLES_HEMISPHERE, INFINITY},
                                  {"phong:n=6", PS_SAMPLES_SPHERE, INFINITY},
                                  {"disk", PS_SAMPLES_TORUS, INFINITY},
                                  {"box", PS_SAMPLES_TORUS, INFINITY},
                                  {"half-plane", PS_SAMPLES_TORUS, INFINITY},
                                  {"gaussian:cut=yes", PS_SAMPLES_TORUS, INFINITY},
                                  {"cap", PS_SAMPLES_SPHERE, INFINITY},
                                  {"diffuse", PS_SAMPLES_SPHERE, INFINITY},
                                  {"lobe:n=30", PS_SAMPLES_HEMISPHERE, INFINITY},
                                  {"glossy:n=30", PS_SAMPLES_SPHERE, INFINITY}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const bool is_on_torus = cases[i].where == PS_SAMPLES_TORUS;
        ps_integrand *const f = parse(cases[i].text, cases[i].where, is_on_torus ? 2 : 3);
        const double reach = ps_integrand_reach(f);
        if (!(reach == cases[i].reach)) {
            fail_msg("%s: reach %g, not %g", cases[i].text, reach, cases[i].reach);
        }
        if (!is_on_torus && isfinite(reach)) {
            double powers[32];
            double sum = 0;
            assert_int_equal(ps_integrand_degrees(f, 31, powers, NULL), PSPEC_OK);
            for (size_t l = (size_t)reach + 1; l < 32; l++) {
                sum += powers[l];
            }
            assert_true(sum <= PS_BEYOND_REACH * ps_integrand_energy(f));
            assert_true(powers[(size_t)reach] > 0);
        }
        ps_integrand_destroy(f);
    }
}

/* ---- any |k| ------------------------------------------------------------------------------- */

static void is_near(const char *what, double found, double expected, double tolerance) {
    if (!(fabs(found - expected) <= tolerance)) {
        fail_msg("%s: %.17g, not %.17g within %g", what, found, expected, tolerance);
    }
}

/* Plancherel: S_d int |f|^2 k^(d-1) dk = int F^2 over all of space. */
static void squares_of_gaussians(void **state) {
    enum { NUM = 40 };
    double nodes[NUM], weights[NUM];
    (void)state;
    ps_gauss_legendre(NUM, nodes, weights);
    for (unsigned d = 1; d <= 4; d++) {
        const double surface = 2 * pow(PS_PI, d / 2.0) / tgamma(d / 2.0);
        ps_integrand *const f = parse("gaussian:sigma=0.3", PS_SAMPLES_TORUS, d);
        double sum = 0;
        for (size_t i = 0; i < NUM; i++) {
            const double k = 4 * nodes[i];
            sum += 4 * weights[i] * surface * pow(k, d - 1.0) * ps_integrand_radial(f, k);
        }
        assert_true(ps_integrand_is_radial(f));
        is_near("gaussian", ps_integrand_whole_square(f), sum, 1e-12 * sum);
        ps_integrand_destroy(f);
    }
}

static void between_whole_frequencies(void **state) {
    static const char *const texts[] = {"disk:radius=0.3", "gaussian:sigma=0.1"};
    static const char *const not [] = {"constant", "box", "half-plane", "wave", "gaussian:cut=yes"};
    const double r = 0.3;
    (void)state;
    for (size_t i = 0; i < 2; i++) {
        ps_integrand *const f = parse(texts[i], PS_SAMPLES_TORUS, 2);
        const int32_t k[2] = {4, -3};
        double power = 0;
        assert_int_equal(ps_integrand_powers(f, k, 1, &power, NULL), PSPEC_OK);
        is_near(texts[i], ps_integrand_radial(f, 5), power, 1e-14 * power);
        const double mean = ps_integrand_integral(f);
        is_near(texts[i], ps_integrand_radial(f, 0), mean * mean, 1e-15);
        is_near(texts[i], ps_integrand_radial(f, 1e-6), mean * mean, 1e-10 * mean * mean);
        ps_integrand_destroy(f);
    }
    ps_integrand *const interval = parse("disk:radius=0.3", PS_SAMPLES_TORUS, 1);
    const double f = sin(PS_TWO_PI * r * 0.7) / (PS_PI * 0.7);
    is_near("interval", ps_integrand_radial(interval, 0.7), f * f, 1e-14);
    is_near("interval", ps_integrand_whole_square(interval), 2 * r, 1e-15);
    ps_integrand_destroy(interval);
    for (size_t i = 0; i < sizeof not / sizeof not [0]; i++) {
        ps_integrand *const other = parse(not [i], PS_SAMPLES_TORUS, 2);
        assert_false(ps_integrand_is_radial(other));
        ps_integrand_destroy(other);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gaussians),
        cmocka_unit_test(lobes),
        cmocka_unit_test(others),
        cmocka_unit_test(squares_of_gaussians),
        cmocka_unit_test(between_whole_frequencies),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
