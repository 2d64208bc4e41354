/* A user's own integrands by their coefficients on the sphere and the hemisphere: polynomials whose
 * coefficients are known, z^2 as the integrand of that name, texts of all orders and of half of
 * them, arrays with the conjugates, and the sentences of what is refused. */
#include "harness_integrands.h"

#include "math/pi.h"
#include "test_folder.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void write_text(const char *path, const char *text) {
    assert_true(test_write_file(path, text, strlen(text)));
}

static double value_at(const ps_integrand *self, const double *u) {
    double value = 0;
    ps_integrand_values(self, u, 1, &value);
    return value;
}

static void unit_vector(int i, double *u) {
    const double z = 1 - (2 * i + 1) / 40.0;
    const double phi = 2.4 * i;
    u[0] = sqrt(1 - z * z) * cos(phi);
    u[1] = sqrt(1 - z * z) * sin(phi);
    u[2] = z;
}

/* ---- z^2 ----------------------------------------------------------------------------------- */

static void write_square(void) {
    char text[128];
    snprintf(text, sizeof text, "# l m re im\n2,0,%.17g,0\n0,0,%.17g,0\n",
             2 * sqrt(PS_FOUR_PI / 5) / 3, sqrt(PS_FOUR_PI) / 3);
    write_text("square.txt", text);
}

static void is_square(ps_integrand_place place) {
    ps_integrand *const own = test_integrand("coefficients:file=square.txt", place);
    ps_integrand *const square = test_integrand("square", place);
    double powers[2][5];
    test_near("z^2", "the integral", ps_integrand_integral(own), ps_integrand_integral(square),
              1e-14);
    test_near("z^2", "the energy", ps_integrand_energy(own), ps_integrand_energy(square), 1e-14);
    test_near("z^2", "the reach", ps_integrand_reach(own), 2, 0);
    assert_ok(ps_integrand_degrees(own, 4, powers[0], error));
    assert_ok(ps_integrand_degrees(square, 4, powers[1], error));
    for (int l = 1; l <= 4; l++) {
        test_near("z^2", "a power", powers[0][l], powers[1][l], 1e-14);
    }
    double set[3 * 10];
    double variances[2];
    for (int i = 0; i < 10; i++) {
        unit_vector(i, set + 3 * (size_t)i);
        test_near("z^2", "a value", value_at(own, set + 3 * (size_t)i), pow(set[3 * i + 2], 2),
                  1e-14);
    }
    assert_ok(ps_integrand_pairwise(own, set, NULL, 10, &variances[0], error));
    assert_ok(ps_integrand_pairwise(square, set, NULL, 10, &variances[1], error));
    test_near("z^2", "the sum over pairs", variances[0], variances[1], 1e-13);
    ps_integrand_destroy(own);
    ps_integrand_destroy(square);
}

static void squares(void **state) {
    (void)state;
    write_square();
    is_square(TEST_SPHERE);
    is_square(TEST_HEMISPHERE);
}

/* ---- orders -------------------------------------------------------------------------------- */

/* xz + 2 yz - 3 z: with n = sqrt(15/(8 pi)), Y_21 = -n (x + iy) z. */
static void is_polynomial(const char *text) {
    ps_integrand *const own = test_integrand(text, TEST_SPHERE);
    for (int i = 0; i < 40; i++) {
        double u[3];
        unit_vector(i, u);
        test_near(text, "a value", value_at(own, u), u[0] * u[2] + 2 * u[1] * u[2] - 3 * u[2],
                  1e-14);
    }
    static const double north[3] = {0, 0, 1};
    test_near(text, "a value", value_at(own, north), -3, 1e-14);
    test_near(text, "the integral", ps_integrand_integral(own), 0, 0);
    /* int x^2 z^2 = 4 pi/15, int z^2 = 4 pi/3 */
    test_near(text, "the energy", ps_integrand_energy(own), PS_FOUR_PI * (5. / 15 + 9. / 3), 1e-13);
    ps_integrand_destroy(own);
}

static void orders(void **state) {
    const double n = sqrt(15 / (8 * PS_PI));
    const double one = -3 * sqrt(PS_FOUR_PI / 3);
    char text[512];
    (void)state;
    snprintf(text, sizeof text, "2 1 %.17g %.17g\n1 0 %.17g 0\n", -1 / (2 * n), 1 / n, one);
    write_text("half.txt", text);
    is_polynomial("coefficients:file=half.txt");
    snprintf(text, sizeof text, "2 -1 %.17g %.17g\n2 1 %.17g %.17g\n1 0 %.17g 0\n", 1 / (2 * n),
             1 / n, -1 / (2 * n), 1 / n, one);
    write_text("whole.txt", text);
    is_polynomial("coefficients:file=whole.txt");
    /* m (2L + 1 - m)/2 + l, the conjugates */
    double c[6][2] = {{0}};
    c[1][0] = one;
    c[4][0] = -1 / (2 * n);
    c[4][1] = -1 / n;
    assert_true(test_write_array("own.npy", "<c16", "False", "(6,)", c, sizeof c));
    is_polynomial("coefficients:file=own.npy");
}

/* Zonal ones of a high degree as the integrand of that name, and no sum over pairs of more. */
static void high_degrees(void **state) {
    (void)state;
    write_text("high.txt", "300 0 1 0\n");
    ps_integrand *const own = test_integrand("coefficients:file=high.txt", TEST_SPHERE);
    ps_integrand *const harmonic = test_integrand("harmonic:degree=300", TEST_SPHERE);
    for (int i = 0; i < 40; i++) {
        double u[3];
        unit_vector(i, u);
        test_near("high.txt", "a value", value_at(own, u), value_at(harmonic, u), 1e-11);
    }
    assert_true(ps_integrand_has_pairs(own));
    ps_integrand_destroy(own);
    ps_integrand_destroy(harmonic);
    write_text("high.txt", "401 0 1 0\n");
    ps_integrand *const higher = test_integrand("coefficients:file=high.txt", TEST_SPHERE);
    assert_false(ps_integrand_has_pairs(higher));
    ps_integrand_destroy(higher);
}

/* ---- refused ------------------------------------------------------------------------------- */

static void refuses(const char *path, ps_integrand_place place, const char *sentence) {
    char text[64];
    ps_integrand *self = NULL;
    ps_error error = {0};
    snprintf(text, sizeof text, "coefficients:file=%s", path);
    assert_int_equal(ps_integrand_parse(&self, text, place, &error), PSPEC_ERROR_INPUT);
    assert_null(self);
    if (strstr(error.message, sentence) == NULL) {
        fail_msg("%s: \"%s\", not \"%s\"", text, error.message, sentence);
    }
}

static void refuses_rows(const char *rows, ps_integrand_place place, const char *sentence) {
    write_text("bad.txt", rows);
    refuses("bad.txt", place, sentence);
}

static void refused(void **state) {
    const double c[7][2] = {{0, 1}};
    (void)state;
    refuses_rows("2 3 1 0\n", TEST_SPHERE,
                 "line 1: order 3 is not a whole number between -2 and 2");
    refuses_rows("1001 0 1 0\n", TEST_SPHERE, "degree 1001 is not");
    refuses_rows("-1 0 1 0\n", TEST_SPHERE, "degree -1 is not");
    refuses_rows("2 0 1 1\n", TEST_SPHERE, "l = 2, m = 0 has the imaginary part 1");
    refuses_rows("2 1 1 1\n2 -1 1 -1\n", TEST_SPHERE,
                 "lines 1 and 2: the coefficients at l = 2, m = 1 and l = 2, m = -1");
    refuses_rows("2 -1 1 1\n", TEST_SPHERE, "without its opposite at l = 2, m = 1");
    refuses_rows("2 1 1 1\n2 1 1 1\n", TEST_SPHERE, "given twice");
    refuses_rows("2 0 1 0\n3 1 1 0\n", TEST_HEMISPHERE, "l = 3, m = 1 is not 0: on the hemisphere");
    assert_true(test_write_array("bad.npy", "<c16", "False", "(7,)", c, sizeof c));
    refuses("bad.npy", TEST_SPHERE, "shape (7,); coefficients up to degree L");
    assert_true(test_write_array("bad.npy", "<c16", "False", "(6,)", c, 6 * sizeof *c));
    refuses("bad.npy", TEST_SPHERE, "l = 0, m = 0 has the imaginary part -1");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(squares),
        cmocka_unit_test(orders),
        cmocka_unit_test(high_degrees),
        cmocka_unit_test(refused),
    };
    return cmocka_run_group_tests_name("sphere_coefficient_files", tests, test_enter_lobes,
                                       test_leave_lobes);
}
