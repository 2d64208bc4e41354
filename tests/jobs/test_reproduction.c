/* What Marques et al. measured with random sets, and the two forms of the worst-case error for
 * every sampler of the hemisphere. Their sets without randomness are in test_optimal_weights.c and
 * test_worst_case.c, Table 1 is in test_truncation.c. */
#include "harness_quadrature.h"
#include "harness_sphere.h"

#include "engines/host/host_direct.h"
#include "rules/optimal_weights.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { NUM_LOBES = 2, NAME = 128 };
static const char *const lobes[NUM_LOBES] = {"diffuse", "glossy:n=30"};
static const char *const morphs[NUM_LOBES] = {"morph=diffuse", "morph=glossy,n=30"};

static char *join(char text[NAME], const char *sampler, int lobe) {
    snprintf(text, NAME, "%s%s", sampler, morphs[lobe]);
    return text;
}

/* ---- slopes of Fig. 4 ---------------------------------------------------------------------- */

/* Means of E^2 over SETS sets and the deviations of these means, for N = 64, 128, 256, 512. */
enum { SIZES = 4, SMALLEST = 64, SETS = 50 };
typedef struct curve {
    double mean[SIZES], deviation[SIZES];
} curve;

static double squared(const ps_representer *r, size_t num, const double *points, bool is_optimal) {
    ps_optimal_weights found;
    if (!is_optimal) {
        return test_squared_error(r, num, points, NULL);
    }
    double *weights = calloc(num, sizeof *weights);
    assert_ok(ps_optimal_weights_find(r, num, points, NULL, false, NULL, weights, &found, error));
    free(weights);
    return found.squared;
}

static curve measure(const ps_representer *r, const char *sampler, bool is_optimal) {
    curve out = {{0}, {0}};
    for (int k = 0; k < SIZES; k++) {
        const size_t num = (size_t)SMALLEST << k;
        double square = 0;
        for (uint64_t i = 0; i < SETS; i++) {
            double *points = test_rule_points(sampler, num, i);
            const double e2 = squared(r, num, points, is_optimal);
            out.mean[k] += e2 / SETS;
            square += e2 * e2 / SETS;
            free(points);
        }
        out.deviation[k] = sqrt((square - out.mean[k] * out.mean[k]) / (SETS - 1));
    }
    return out;
}

/* Of log E over log N, by least squares. */
static double slope_of(const curve *measured) {
    double slope = 0;
    for (int k = 0; k < SIZES; k++) {
        slope += (k - 1.5) * log2(measured->mean[k]) / 2 / 5; /* sum (k - 1.5)^2 = 5 */
    }
    return slope;
}

/* The slopes of docs/mathematics/quadrature.md#reference-errors, but for random points with equal
 * weights, where -1/2 is exact. */
static void stochastic_slopes(void **state) {
    static const struct {
        const char *sampler;
        double equal[NUM_LOBES], optimal[NUM_LOBES];
    } sets[] = {{"white-hemisphere:", {-.5, -.5}, {-.758, -.730}},
                {"jittered:lift=hemisphere,", {-.778, -.755}, {-.764, -.753}},
                {"bnot:lift=hemisphere,", {-.76, -.76}, {-.76, -.75}}}; /* those of the paper */
    static const double tolerance = 0.05;
    (void)state;
    for (int lobe = 0; lobe < NUM_LOBES; lobe++) {
        ps_representer r = test_representer(lobes[lobe], 1.5, 1e-12);
        for (size_t i = 0; i < sizeof sets / sizeof sets[0]; i++) {
            char text[NAME];
            const curve equal = measure(&r, join(text, sets[i].sampler, lobe), false);
            const curve optimal = measure(&r, text, true);
            print_message("%-44s %.4f, optimal %.4f\n", text, slope_of(&equal), slope_of(&optimal));
            assert_true(fabs(slope_of(&equal) - sets[i].equal[lobe]) <= tolerance);
            assert_true(fabs(slope_of(&optimal) - sets[i].optimal[lobe]) <= tolerance);
            for (int k = 0; k < SIZES; k++) {
                assert_true(optimal.mean[k] < equal.mean[k]);
            }
        }
        ps_representer_destroy(&r);
    }
}

/* E = .98274/sqrt N and .56708/sqrt N at every size of the figure. */
static void random_constants(void **state) {
    static const double constants[NUM_LOBES] = {.98274, .56708};
    (void)state;
    for (int lobe = 0; lobe < NUM_LOBES; lobe++) {
        ps_representer r = test_representer(lobes[lobe], 1.5, 1e-12);
        char text[NAME];
        const curve seen = measure(&r, join(text, "white-hemisphere:", lobe), false);
        for (int k = 0; k < SIZES; k++) {
            const double exact = constants[lobe] * constants[lobe] / (SMALLEST << k);
            const double off = (seen.mean[k] - exact) / seen.deviation[k];
            print_message("%s N %d: %.2f deviations\n", text, SMALLEST << k, off);
            assert_true(fabs(off) <= 4);
        }
        ps_representer_destroy(&r);
    }
}

/* ---- spectral form against kernel form ----------------------------------------------------- */

/* Weights 1/N. */
static void coefficients_of(size_t num, const double *points, int32_t last, double *c_l0,
                            double *c2) {
    const pspec_pattern pattern = {.dimension = 3, .num_points = num, .points = points};
    const double n = (double)num;
    ps_frequencies degrees = test_degrees(last, false);
    double *c = test_coefficients(&ps_host_direct, PS_EXTENDED, NULL, &degrees, &pattern);
    for (int32_t l = 0; l <= last; l++) {
        c_l0[l] = c[2 * test_coefficient(last, l, 0)] / n;
        c2[l] = 0;
        for (int32_t m = 1; m <= l; m++) {
            const double *one = c + 2 * test_coefficient(last, l, m);
            c2[l] += 2 * (one[0] * one[0] + one[1] * one[1]) / (n * n);
        }
    }
    free(c);
    ps_frequencies_free(&degrees);
}

enum { MOST_DEGREES = 100, NUM_SMOOTHNESS = 3 };
static const double smoothness[NUM_SMOOTHNESS] = {1.1, 1.5, 1.9};

/* Numbers of points and degrees; where these reach far beyond sqrt N, the model of the rest is
 * right within a factor 3, since phases are as good as random there. */
typedef struct extent {
    size_t num;
    int32_t last;
    bool is_far;
} extent;

/* The bracket of the rest is [0, bound]. */
static void compare_forms(const ps_representer *representers, const extent *sizes,
                          const double *points) {
    double c_l0[MOST_DEGREES + 1];
    double c2[MOST_DEGREES + 1];
    const ps_rule rule = {sizes->num, points, NULL};
    const ps_weight_sums weights = ps_rule_weight_sums(&rule);
    coefficients_of(sizes->num, points, sizes->last, c_l0, c2);
    for (int k = 0; k < NUM_SMOOTHNESS; k++) {
        const ps_representer *const r = &representers[k];
        ps_spectral_error e;
        assert_ok(
            ps_spectral_error_of(r, (size_t)sizes->last, c_l0, c2, &weights, NULL, &e, error));
        const double rest =
            test_squared_error(r, sizes->num, points, NULL) - e.zonal - e.anisotropic;
        if (!(rest >= -1e-13 && rest <= e.tail_bound)) {
            fail_msg("N %zu, s %.1f: rest %.4g, not in [0, %.4g]", sizes->num, r->smoothness, rest,
                     e.tail_bound);
        }
        if (sizes->is_far && !(rest > e.tail_model / 3 && rest < 3 * e.tail_model)) {
            fail_msg("N %zu, s %.1f: rest %.4g, model %.4g", sizes->num, r->smoothness, rest,
                     e.tail_model);
        }
    }
}

/* With the degrees that are compared, however few kappa needs. */
static ps_representer make_representer(const char *lobe, double s) {
    ps_representer r = {0};
    ps_brdf *brdf = NULL;
    assert_ok(ps_brdf_parse(&brdf, lobe, error));
    assert_ok(ps_representer_create(&r, brdf, s, 1e-12, MOST_DEGREES, error));
    ps_brdf_destroy(brdf);
    return r;
}

static void two_forms(void **state) {
    static const char *const samplers[] = {
        "white-hemisphere:",
        "fibonacci-hemisphere:",
        "white:lift=hemisphere,",
        "regular:lift=hemisphere,",
        "jittered:lift=hemisphere,",
        "latin-hypercube:lift=hemisphere,",
        "sobol:lift=hemisphere,",
        "sobol:scramble=owen,lift=hemisphere,",
        "halton:lift=hemisphere,",
        "hammersley:lift=hemisphere,",
        "larcher-pillichshammer:lift=hemisphere,",
        "larcher-pillichshammer:scramble=xor,lift=hemisphere,",
    };
    static const extent extents[] = {
        {64, MOST_DEGREES, true}, {256, MOST_DEGREES, true}, {1024, 64, false}, {4096, 32, false}};
    (void)state;
    for (int lobe = 0; lobe < NUM_LOBES; lobe++) {
        ps_representer representers[NUM_SMOOTHNESS];
        for (int k = 0; k < NUM_SMOOTHNESS; k++) {
            representers[k] = make_representer(lobes[lobe], smoothness[k]);
        }
        for (size_t i = 0; i < sizeof samplers / sizeof samplers[0]; i++) {
            for (size_t n = 0; n < sizeof extents / sizeof extents[0]; n++) {
                char text[NAME];
                double *points = test_rule_points(join(text, samplers[i], lobe), extents[n].num, 0);
                compare_forms(representers, &extents[n], points);
                free(points);
            }
        }
        for (int k = 0; k < NUM_SMOOTHNESS; k++) {
            ps_representer_destroy(&representers[k]);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(stochastic_slopes),
                                       cmocka_unit_test(random_constants),
                                       cmocka_unit_test(two_forms)};
    return cmocka_run_group_tests_name("reproduction", tests, NULL, NULL);
}
