/* Integrands of the torus: exact values of reference/torus.json and tables.json, Parseval, sums
 * over pairs against sums over frequencies, values against integrals, what is refused. */
#include "harness.h"

#include "integrands/integrand.h"
#include "math/gauss_legendre.h"
#include "math/pi.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static ps_integrand *parse_in(const char *text, unsigned dimension) {
    ps_integrand *integrand = NULL;
    ps_error error = {0};
    const ps_integrand_place place = {PS_SAMPLES_TORUS, dimension};
    if (ps_integrand_parse(&integrand, text, place, &error) != PSPEC_OK) {
        fail_msg("%s: %s", text, error.message);
    }
    return integrand;
}

static double power_of(const ps_integrand *integrand, const int32_t *k) {
    double power = 0;
    assert_int_equal(ps_integrand_powers(integrand, k, 1, &power, NULL), PSPEC_OK);
    return power;
}

static void is_near(const char *what, double found, double expected, double tolerance) {
    if (!(fabs(found - expected) <= tolerance)) {
        fail_msg("%s: %.17g, not %.17g: off by %.2g, %.2g is allowed", what, found, expected,
                 found - expected, tolerance);
    }
}

/* ---- reference values ---------------------------------------------------------------------- */

/* A whole |k|^2 as k of the plane. */
static void find_vector(int64_t norm2, int32_t k[2]) {
    for (k[0] = 0; (int64_t)k[0] * k[0] <= norm2; k[0]++) {
        k[1] = (int32_t)lround(sqrt((double)(norm2 - (int64_t)k[0] * k[0])));
        if ((int64_t)k[0] * k[0] + (int64_t)k[1] * k[1] == norm2) {
            return;
        }
    }
    fail_msg("%lld is no sum of two squares", (long long)norm2);
}

static void disk_coefficients(void **state) {
    cJSON *const tables = test_read_reference("tables.json");
    const cJSON *table = NULL;
    unsigned num = 0;
    (void)state;
    cJSON_ArrayForEach(table, cJSON_GetObjectItem(tables, "disk")) {
        char text[64];
        const cJSON *row = NULL;
        snprintf(text, sizeof text, "disk:radius=%s", cJSON_GetObjectItem(table, "r")->valuestring);
        ps_integrand *const disk = parse_in(text, 2);
        cJSON_ArrayForEach(row, cJSON_GetObjectItem(table, "rows")) {
            int32_t k[2];
            const double norm2 = test_number(cJSON_GetArrayItem(row, 0));
            const double f = test_number(cJSON_GetArrayItem(row, 1));
            find_vector((int64_t)norm2, k);
            /* the phase 2 pi r |k| has a rounding of its own */
            is_near(text, power_of(disk, k), f * f, 1e-12 * f * f + 1e-15 * fabs(f));
            num++;
        }
        ps_integrand_destroy(disk);
    }
    assert_true(num > 10);
    cJSON_Delete(tables);
}

static void describe(char *text, size_t size, const cJSON *row) {
    const char *const name = cJSON_GetObjectItem(row, "integrand")->valuestring;
    const bool is_disk = strcmp(name, "disk") == 0;
    snprintf(text, size, "%s:%s=%s", is_disk ? "disk" : "gaussian", is_disk ? "radius" : "sigma",
             cJSON_GetObjectItem(row, is_disk ? "r" : "sigma")->valuestring);
}

/* N^-1 sum over |k_i| <= K of P |f|^2, straight from the definition. */
static double sum_of_box(const ps_integrand *integrand, const test_set *set, int32_t limit,
                         double *energy) {
    long double sum = 0;
    long double held = 0;
    for (int32_t k0 = -limit; k0 <= limit; k0++) {
        for (int32_t k1 = -limit; k1 <= limit; k1++) {
            const int32_t k[2] = {k0, k1};
            double re = 0;
            double im = 0;
            if (k0 == 0 && k1 == 0) {
                continue; /* tests/jobs/variance/test_variance_files.c has it */
            }
            for (size_t j = 0; j < set->num_points; j++) {
                const double *const x = set->points + 2 * j;
                const double w = set->weights != NULL ? set->weights[j] : 1;
                const double turns = fmod(k0 * x[0], 1) + fmod(k1 * x[1], 1);
                re += w * cos(PS_TWO_PI * turns);
                im += w * sin(PS_TWO_PI * turns);
            }
            const double power = power_of(integrand, k);
            held += power;
            sum += power * (re * re + im * im);
        }
    }
    *energy = (double)held;
    return (double)sum / (set->weight_sum * set->weight_sum);
}

/* (V2) of single sets within 1e-6 and 1e-13 of the integral of F^2; what (V1) has up to a cut-off
 * and its bracket contain it. */
static void variances_of_sets(void **state) {
    cJSON *const torus = test_read_reference("torus.json");
    const cJSON *json = NULL;
    unsigned num = 0;
    (void)state;
    cJSON_ArrayForEach(json, cJSON_GetObjectItem(torus, "sets")) {
        const cJSON *row = NULL;
        test_set set = test_read_set(json);
        cJSON_ArrayForEach(row, cJSON_GetObjectItem(json, "variance")) {
            char text[64];
            double found = 0;
            double held = 0;
            if (strcmp(cJSON_GetObjectItem(row, "integrand")->valuestring, "pixel_image") == 0) {
                continue;
            }
            describe(text, sizeof text, row);
            ps_integrand *const integrand = parse_in(text, 2);
            const double exact = test_field(row, "var_random_shift");
            const double mean = test_field(row, "mean");
            const double whole = ps_integrand_energy(integrand) + mean * mean;
            is_near(text, ps_integrand_integral(integrand), mean, 1e-15);
            assert_int_equal(ps_integrand_pairwise(integrand, set.points, set.weights,
                                                   set.num_points, &found, NULL),
                             PSPEC_OK);
            is_near(text, found, exact, 1e-6 * exact + 1e-13 * whole);
            const double lower = sum_of_box(integrand, &set, 24, &held);
            const double share = pow(set.weight_size_sum / set.weight_sum, 2); /* P_max / N */
            const double tail = ps_integrand_energy(integrand) - held;
            assert_true(lower <= exact + 1e-13 * whole);
            assert_true(exact <= lower + share * tail + 1e-13 * whole);
            ps_integrand_destroy(integrand);
            num++;
        }
        test_free_set(&set);
    }
    assert_true(num >= 15);
    cJSON_Delete(torus);
}

/* ---- laws ---------------------------------------------------------------------------------- */

static const struct {
    const char *text;
    unsigned dimension;
    int32_t limit; /* of a box of frequencies that holds the energy .. */
    double share;  /* .. but for so much of it */
} KINDS[] = {
    {"disk:radius=0.3", 1, 2000, 2e-3},
    {"disk:radius=0.25", 2, 100, 1.5e-2},
    {"disk:radius=0.5,centre=0.25x0.75", 2, 100, 1e-2},
    {"ball:radius=0.4", 3, 24, 5e-2},
    {"box:sides=0.5x0.25,centre=0.1x0.9", 2, 100, 1e-2},
    {"box:sides=0.125x1x0.75", 3, 20, 2e-1},
    {"half-plane", 2, 100, 1e-2},
    {"half-plane:angle=2.5,offset=-0.3", 2, 100, 3e-2},
    {"gaussian", 2, 12, 1e-9},
    {"gaussian:sigma=0.5,centre=0.2x0.9", 2, 8, 1e-13},
    {"gaussian:sigma=0.03", 1, 40, 1e-9},
    {"gaussian:sigma=0.25,cut=yes", 2, 100, 1e-4},
    {"gaussian:sigma=0.8,cut=yes", 1, 2000, 1e-3},
    {"gaussian:sigma=0.2", 3, 4, 1e-6},
    {"wave:k=3x-2,phase=0.1", 2, 3, 0},
    {"constant:value=-2.5", 2, 4, 0},
};
enum { NUM_KINDS = sizeof KINDS / sizeof KINDS[0] };

/* sum of |f_k|^2 cos(2 pi k.x) over the k != 0 of a box. */
static double sum_over_box(const ps_integrand *integrand, int32_t limit, const double *x) {
    const unsigned dimension = integrand->place.dimension;
    const size_t side = 2 * (size_t)limit + 1;
    size_t num = 0;
    size_t num_codes = 1;
    long double sum = 0;
    for (unsigned i = 0; i < dimension; i++) {
        num_codes *= side;
    }
    int32_t *const k = calloc(num_codes * dimension, sizeof *k);
    double *const powers = calloc(num_codes, sizeof *powers);
    for (size_t code = 0; code < num_codes; code++) {
        size_t rest = code;
        for (unsigned i = 0; i < dimension; i++) {
            k[num * dimension + i] = (int32_t)(rest % side) - limit;
            rest /= side;
        }
        num += code != num_codes / 2; /* the middle is 0 */
    }
    assert_int_equal(ps_integrand_powers(integrand, k, num, powers, NULL), PSPEC_OK);
    for (size_t i = 0; i < num; i++) {
        double turns = 0;
        for (unsigned axis = 0; axis < dimension; axis++) {
            turns += x != NULL ? k[i * dimension + axis] * x[axis] : 0;
        }
        sum += powers[i] * cos(PS_TWO_PI * turns);
    }
    free(k);
    free(powers);
    return (double)sum;
}

/* Powers never exceed the energy, and what a box lacks is the tail. */
static void parseval(void **state) {
    (void)state;
    for (unsigned i = 0; i < NUM_KINDS; i++) {
        ps_integrand *const integrand = parse_in(KINDS[i].text, KINDS[i].dimension);
        const double energy = ps_integrand_energy(integrand);
        const double held = sum_over_box(integrand, KINDS[i].limit, NULL);
        const double lacks = energy - held;
        if (!(lacks >= -1e-14 && lacks <= KINDS[i].share * energy + 1e-14)) {
            fail_msg("%s: %.17g of %.17g, which lacks %.3g of it", KINDS[i].text, held, energy,
                     lacks / energy);
        }
        /* the rest of disks and half-planes falls as 1/R: half of it in twice the box */
        if (KINDS[i].share > 1e-3 && KINDS[i].dimension == 2) {
            const double rest = energy - sum_over_box(integrand, 2 * KINDS[i].limit, NULL);
            is_near(KINDS[i].text, rest / lacks, 0.5, 0.05);
        }
        ps_integrand_destroy(integrand);
    }
}

/* A(x) = f_0^2 + sum |f_k|^2 cos(2 pi k.x), to what the tail holds; A(0) = int F^2. */
static void correlations(void **state) {
    static const double places[][6] = {
        {0}, {0.01, 0.02, 0}, {0.3, 0.1, 0.7}, {0.5, 0.5, 0.5}, {-0.9, 0.25, 0.05}};
    (void)state;
    for (unsigned i = 0; i < NUM_KINDS; i++) {
        ps_integrand *const integrand = parse_in(KINDS[i].text, KINDS[i].dimension);
        const double whole = ps_integrand_integral(integrand);
        const double energy = ps_integrand_energy(integrand);
        for (unsigned p = 0; p < sizeof places / sizeof places[0]; p++) {
            const double series =
                whole * whole + sum_over_box(integrand, KINDS[i].limit, places[p]);
            is_near(KINDS[i].text, integrand->kind->correlation(integrand, places[p]), series,
                    KINDS[i].share * energy + 1e-13);
        }
        ps_integrand_destroy(integrand);
    }
}

/* Values at a lattice of points that is shifted at random: their mean is the integral, that of
 * squares the energy; smooth integrands to rounding, jumps to the share of cells that they cut. */
static void values_have_these_integrals(void **state) {
    enum { POINTS = 1 << 16 };
    static double points[3 * POINTS];
    static double values[POINTS];
    (void)state;
    for (unsigned i = 0; i < NUM_KINDS; i++) {
        const unsigned dimension = KINDS[i].dimension;
        ps_integrand *const integrand = parse_in(KINDS[i].text, dimension);
        const unsigned side = dimension == 1 ? POINTS : dimension == 2 ? 256 : 40;
        size_t num = 0;
        long double sum = 0;
        long double squares = 0;
        const size_t num_codes = (size_t)lround(pow(side, dimension));
        for (size_t code = 0; code < num_codes; code++) {
            size_t rest = code;
            for (unsigned axis = 0; axis < dimension; axis++) {
                points[num * dimension + axis] = ((double)(rest % side) + 0.37 + 0.1 * axis) / side;
                rest /= side;
            }
            num++;
        }
        ps_integrand_values(integrand, points, num, values);
        for (size_t j = 0; j < num; j++) {
            sum += values[j];
            squares += values[j] * values[j];
        }
        const double whole = ps_integrand_integral(integrand);
        const bool is_smooth =
            integrand->kind->is_isotropic != NULL && strncmp(KINDS[i].text, "disk", 4) != 0 &&
            strncmp(KINDS[i].text, "ball", 4) != 0 && strstr(KINDS[i].text, "cut") == NULL;
        const double jumps = 4.0 / side; /* more than any boundary here cuts */
        is_near(KINDS[i].text, (double)sum / (double)num, whole, is_smooth ? 1e-12 : jumps);
        is_near(KINDS[i].text, (double)squares / (double)num,
                ps_integrand_energy(integrand) + whole * whole, is_smooth ? 1e-12 : jumps);
        ps_integrand_destroy(integrand);
    }
}

/* One axis of the cut Gaussian by quadrature; mathematics 1.4b has two values. */
static void cut_gaussians(void **state) {
    enum { NODES = 200 };
    static double nodes[NODES];
    static double weights[NODES];
    static const double sigmas[] = {0.02, 0.0625, 0.25, 0.5, 1};
    (void)state;
    ps_gauss_legendre(NODES, nodes, weights);
    for (unsigned i = 0; i < sizeof sigmas / sizeof sigmas[0]; i++) {
        char text[64];
        snprintf(text, sizeof text, "gaussian:sigma=%g,cut=yes", sigmas[i]);
        ps_integrand *const integrand = parse_in(text, 1);
        for (int32_t k = 1; k <= 50; k++) {
            long double sum = 0;
            for (unsigned n = 0; n < NODES; n++) {
                const double t = nodes[n] / 2;
                sum +=
                    weights[n] * exp(-t * t / (2 * sigmas[i] * sigmas[i])) * cos(PS_TWO_PI * k * t);
            }
            is_near(text, sqrt(power_of(integrand, &k)), fabs((double)sum), 1e-14);
        }
        ps_integrand_destroy(integrand);
    }
    ps_integrand *const cut = parse_in("gaussian:sigma=0.25,cut=yes", 1);
    ps_integrand *const whole = parse_in("gaussian:sigma=0.25", 1);
    const int32_t k = 3;
    is_near("cut", sqrt(power_of(cut, &k)), 5.7e-3, 5e-5);
    is_near("periodised", sqrt(power_of(whole, &k)), 9.4e-6, 5e-8);
    ps_integrand_destroy(cut);
    ps_integrand_destroy(whole);
}

/* Tails of mathematics 1.4: of a disk Per/(2 pi^2 R) beyond R, of a half-plane at 0.4 .00629 beyond
 * 20. */
static double beyond(const char *text, int32_t limit, double radius) {
    ps_integrand *const integrand = parse_in(text, 2);
    long double held = 0;
    for (int32_t x = -limit; x <= limit; x++) {
        for (int32_t y = -limit; y <= limit; y++) {
            const int32_t k[2] = {x, y};
            const double norm2 = (double)x * x + (double)y * y;
            held += norm2 > 0 && norm2 <= radius * radius ? power_of(integrand, k) : 0;
        }
    }
    const double rest = ps_integrand_energy(integrand) - (double)held;
    ps_integrand_destroy(integrand);
    return rest;
}

static void tails(void **state) {
    (void)state;
    is_near("disk", beyond("disk:radius=0.25", 400, 400) * 400, 0.25 / PS_PI, 0.002);
    is_near("half-plane", beyond("half-plane:angle=0.4", 20, 20), 0.00629, 1e-5); /* three digits */
}

/* ---- refused ------------------------------------------------------------------------------- */

static void refuses(const char *text, unsigned dimension, const char *sentence) {
    ps_integrand *integrand = NULL;
    ps_error error = {0};
    const ps_integrand_place place = {PS_SAMPLES_TORUS, dimension};
    assert_int_equal(ps_integrand_parse(&integrand, text, place, &error),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_null(integrand);
    if (strstr(error.message, sentence) == NULL) {
        fail_msg("%s: \"%s\", not \"%s\"", text, error.message, sentence);
    }
}

static void bad_texts(void **state) {
    (void)state;
    refuses("disc", 2, "unknown integrand \"disc\"; there are disk, ");
    refuses("disk:radius=0.6", 2, "radius of integrand disk");
    refuses("disk:radius=0", 2, "radius=0: a ball has a radius above 0");
    refuses("disk:radius=nan", 2, "radius of integrand disk");
    refuses("disk:size=1", 2, "size");
    refuses("disk:centre=0.1x0.2x0.3", 2, "is not one number, nor 2 with x between them");
    refuses("disk:centre=0.1x", 2, "centre of integrand disk");
    refuses("box:sides=1.5", 2, "sides of integrand box");
    refuses("box:sides=0x1", 2, "sides are above 0");
    refuses("half-plane", 3, "points have 3 dimensions, and it has 2 to 2");
    refuses("half-plane:angle=0,offset=-0.1", 2, "misses the cell");
    refuses("half-plane:angle=0,offset=1.1", 2, "misses the cell");
    refuses("gaussian:sigma=2", 2, "sigma of integrand gaussian");
    refuses("gaussian:cut=maybe", 2, "cut=maybe: yes or no");
    refuses("wave:k=0", 2, "0 is no wave");
    refuses("wave:k=1.5", 1, "whole numbers");
    ps_integrand *integrand = NULL;
    const ps_integrand_place sphere = {PS_SAMPLES_SPHERE, 3};
    ps_error error = {0};
    assert_int_equal(ps_integrand_parse(&integrand, "disk", sphere, &error),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(error.message, "there is none on the sphere"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(disk_coefficients),
        cmocka_unit_test(variances_of_sets),
        cmocka_unit_test(parseval),
        cmocka_unit_test(correlations),
        cmocka_unit_test(values_have_these_integrals),
        cmocka_unit_test(cut_gaussians),
        cmocka_unit_test(tails),
        cmocka_unit_test(bad_texts),
    };
    return cmocka_run_group_tests_name("torus_integrands", tests, NULL, NULL);
}
