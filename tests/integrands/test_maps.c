/* Maps as integrands: what is said of them against Gauss sums of their values and the harmonics of
 * GSL, Parseval, turns about z, maps with closed forms, and the sentences of what is refused. */
#include "harness_integrands.h"

#include "math/gauss_legendre.h"
#include "math/gsl/special.h"
#include "math/pi.h"

#include <complex.h>
#include <math.h>

enum { LAST = 24 };

/* ---- against Gauss sums -------------------------------------------------------------------- */

enum { NODES = 24 };

typedef struct sums {
    double integral, square;
    double complex f[LAST + 1][LAST + 1]; /* [l][m] */
} sums;

static void add_point(sums *out, const ps_integrand *self, double theta, double phi, double weight,
                      const double *functions) {
    const double u[3] = {sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta)};
    double value = 0;
    ps_integrand_values(self, u, 1, &value);
    out->integral += weight * value;
    out->square += weight * value * value;
    for (size_t m = 0; m <= LAST; m++) {
        const double complex phase = weight * value * cexp(-I * (double)m * phi);
        for (size_t l = m; l <= LAST; l++) {
            out->f[l][m] += phase * functions[ps_legendre_place(l, m)];
        }
    }
}

/* Between the centres of pixels F is smooth. Of a hemisphere of odd height a row is the horizon. */
static void integrate(sums *out, const ps_integrand *self, const test_light *image, bool is_upper) {
    double nodes[NODES];
    double weights[NODES];
    const double first = PS_PI / (double)image->width;
    const size_t pieces =
        image->width * (image->width < 8 ? 8 : 1); /* short ones, for order LAST */
    double *const functions = calloc(ps_legendre_room(LAST), sizeof *functions);
    ps_gauss_legendre(NODES, nodes, weights);
    *out = (sums){.integral = 0};
    for (size_t row = 0; row <= image->height; row++) {
        const double step = PS_PI / (double)image->height;
        const double begin = row == 0 ? 0 : ((double)row - 0.5) * step;
        const double most = is_upper ? PS_PI / 2 : PS_PI;
        const double end = fmin(row == image->height ? PS_PI : ((double)row + 0.5) * step, most);
        for (size_t i = 0; i < NODES && end > begin + 1e-12; i++) {
            const double theta = begin + (end - begin) * nodes[i];
            ps_legendre_functions(LAST, cos(theta), functions);
            for (size_t j = 0; j < pieces * NODES; j++) {
                const double turn = PS_TWO_PI / (double)pieces;
                const double phi = turn * ((double)(j / NODES) + nodes[j % NODES]) + first;
                add_point(out, self, theta, phi,
                          weights[i] * (end - begin) * sin(theta) * turn * weights[j % NODES],
                          functions);
            }
        }
    }
    free(functions);
}

static void check_sums(size_t width, size_t height, bool is_upper) {
    static test_light made;
    static sums expected;
    double powers[LAST + 1];
    test_light_fill(&made, width, height);
    test_light_write("map.pfm", &made);
    ps_integrand *const self =
        test_integrand("map:file=map.pfm", is_upper ? TEST_HEMISPHERE : TEST_SPHERE);
    integrate(&expected, self, &made, is_upper);
    const double whole = expected.integral;
    const double energy = is_upper ? 2 * expected.square - whole * whole / PS_PI
                                   : expected.square - whole * whole / PS_FOUR_PI;
    test_near("map", "the integral", ps_integrand_integral(self), whole, 1e-13 * PS_FOUR_PI);
    test_near("map", "the energy", ps_integrand_energy(self), energy, 1e-12);
    assert_ok(ps_integrand_degrees(self, LAST, powers, error));
    for (size_t l = 0; l <= LAST; l++) {
        const double factor = !is_upper ? 1 : l % 2 == 0 ? 4 : 0;
        double power = 0;
        for (size_t m = 0; m <= l; m++) {
            power += (m > 0 ? 2 : 1) * factor * creal(expected.f[l][m] * conj(expected.f[l][m]));
        }
        test_near("map", "a degree", powers[l], power, 1e-13);
    }
    ps_integrand_destroy(self);
}

static void sums_of_values(void **state) {
    (void)state;
    for (int is_upper = 0; is_upper < 2; is_upper++) {
        check_sums(1, 1, is_upper != 0);
        check_sums(2, 1, is_upper != 0);
        check_sums(8, 4, is_upper != 0);
        check_sums(5, 3, is_upper != 0);
        check_sums(3, 7, is_upper != 0);
    }
}

/* ---- laws ---------------------------------------------------------------------------------- */

/* Kinks along circles and meridians: what is beyond L falls as L^-2 or faster. */
static void all_degrees_are_the_energy(void **state) {
    enum { DEGREES = 400 };
    static test_light made;
    double powers[DEGREES + 1];
    double sum = 0;
    (void)state;
    test_light_fill(&made, 12, 6);
    test_light_write("map.pfm", &made);
    ps_integrand *const self = test_integrand("map:file=map.pfm", TEST_SPHERE);
    assert_ok(ps_integrand_degrees(self, DEGREES, powers, error));
    for (size_t l = 1; l <= DEGREES; l++) {
        sum += powers[l];
    }
    assert_true(sum < ps_integrand_energy(self));
    test_near("map", "the energy", sum, ps_integrand_energy(self), 1e-4 * sum);
    ps_integrand_destroy(self);
}

/* The same at any place of pixels along a row, and at twice as many degrees. */
static void turns_change_nothing(void **state) {
    static test_light made, turned;
    double powers[LAST + 1];
    double others[2 * LAST + 1];
    (void)state;
    test_light_fill(&made, 30, 15);
    turned = made;
    for (size_t i = 0; i < made.width * made.height; i++) {
        turned.light[i] = made.light[i / made.width * made.width + (i + 11) % made.width];
    }
    test_light_write("map.pfm", &made);
    test_light_write("turned.pfm", &turned);
    ps_integrand *const first = test_integrand("map:file=map.pfm", TEST_SPHERE);
    ps_integrand *const second = test_integrand("map:file=turned.pfm", TEST_SPHERE);
    assert_ok(ps_integrand_degrees(first, LAST, powers, error));
    assert_ok(ps_integrand_degrees(second, 2 * LAST, others, error));
    for (size_t l = 0; l <= LAST; l++) {
        test_near("map", "a degree of the turned one", others[l], powers[l], 1e-14);
    }
    ps_integrand_destroy(first);
    ps_integrand_destroy(second);
}

/* Squares of linear pieces: with h = pi/H, z^2 is off by h^2/4 of its second derivative at most. */
static void closed_forms(void **state) {
    static test_light made = {.width = 128, .height = 64};
    double powers[LAST + 1];
    (void)state;
    for (size_t i = 0; i < made.width * made.height; i++) {
        made.light[i] = 2.5f;
    }
    test_light_write("map.pfm", &made);
    ps_integrand *self = test_integrand("map:file=map.pfm", TEST_SPHERE);
    test_near("constant", "the integral", ps_integrand_integral(self), 2.5 * PS_FOUR_PI, 1e-13);
    test_near("constant", "the energy", ps_integrand_energy(self), 0, 1e-25);
    assert_ok(ps_integrand_degrees(self, LAST, powers, error));
    test_near("constant", "degree 0", powers[0], 2.5 * 2.5 * PS_FOUR_PI, 1e-12);
    for (size_t l = 1; l <= LAST; l++) {
        test_near("constant", "a degree", powers[l], 0, 1e-25);
    }
    ps_integrand_destroy(self);
}

/* Maps of functions with a closed form, which are raised where they are negative: bilinear values
 * are off by h^2/8 times second derivatives along both axes, and F_lm by sqrt(4 pi) times that. A
 * step at the horizon is between two rows, and as wide as they are apart: odd about it, it is off
 * by h^2 as well, with what was measured in the place of a derivative. */
static void sampled_functions(void **state) {
    enum { NUM = (LAST + 1) * (LAST + 2), WIDTH = 128, HEIGHT = 64 };
    static const struct {
        const char *text;
        double raise, curvature;
    } rows[] = {{"square:axis=1x2x2", 0, 2},
                {"harmonic:degree=1,axis=1x1x0", 1, 1},
                {"harmonic:degree=3", 1, 8},
                {"lobe:n=5,axis=1x2x-2", 0, 5},
                {"cap:angle=1.5707963267948966", 0, 4}};
    static test_light made;
    (void)state;
    test_light_fill(&made, WIDTH, HEIGHT);
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
        double expected[NUM];
        double found[NUM];
        ps_integrand *const exact = test_integrand(rows[k].text, TEST_SPHERE);
        for (size_t i = 0; i < WIDTH * HEIGHT; i++) {
            const double theta = PS_PI * ((double)(i / WIDTH) + 0.5) / HEIGHT;
            const double phi = PS_TWO_PI * ((double)(i % WIDTH) + 0.5) / WIDTH;
            const double u[] = {sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta)};
            double value = 0;
            ps_integrand_values(exact, u, 1, &value);
            made.light[i] = (float)(value + rows[k].raise);
        }
        test_light_write("map.pfm", &made);
        ps_integrand *const map = test_integrand("map:file=map.pfm", TEST_SPHERE);
        assert_ok(ps_integrand_harmonics(exact, LAST, expected, error));
        assert_ok(ps_integrand_harmonics(map, LAST, found, error));
        expected[0] += rows[k].raise * sqrt(PS_FOUR_PI);
        const double off =
            sqrt(PS_FOUR_PI) * (PS_PI / HEIGHT) * (PS_PI / HEIGHT) / 4 * rows[k].curvature;
        for (size_t i = 0; i < NUM; i++) {
            test_near(rows[k].text, "a coefficient", found[i], expected[i], off);
        }
        test_near(rows[k].text, "the integral", ps_integrand_integral(map),
                  ps_integrand_integral(exact) + PS_FOUR_PI * rows[k].raise, PS_FOUR_PI * off);
        ps_integrand_destroy(map);
        ps_integrand_destroy(exact);
    }
}

/* Light made up is a function of the direction: sizes agree, nothing is as bright as the sun. */
static void made_up_light(void **state) {
    static const double sun[] = {0.33585924, 0.52306741, 0.78332691}; /* 0.9 above, azimuth 1 */
    ps_integrand *const few = test_integrand("map:width=256", TEST_SPHERE);
    ps_integrand *const many = test_integrand("map:width=512", TEST_SPHERE);
    double bright = 0;
    (void)state;
    ps_integrand_values(many, sun, 1, &bright);
    for (size_t i = 0; i < many->num_table; i++) {
        assert_true(many->table[i] > 0 && many->table[i] < 1.01 * bright);
    }
    assert_true(bright > 5);
    test_near("made up", "the integral", ps_integrand_integral(few), ps_integrand_integral(many),
              0.01 * ps_integrand_integral(many));
    ps_integrand_destroy(few);
    ps_integrand_destroy(many);
}

/* ---- words --------------------------------------------------------------------------------- */

static void refuse(const char *text, const char *piece) {
    ps_integrand *self = NULL;
    ps_error error = {0};
    assert_true(ps_integrand_parse(&self, text, TEST_SPHERE, &error) != PSPEC_OK);
    assert_null(self);
    if (strstr(error.message, piece) == NULL) {
        fail_msg("\"%s\" has no \"%s\"", error.message, piece);
    }
}

static void words(void **state) {
    static test_light made;
    (void)state;
    test_light_fill(&made, 4, 3);
    made.light[5] = -1;
    test_light_write("map.pfm", &made);
    refuse("map:file=map.pfm", "row 1, column 1, from 0, is -1, which is no light; clamp=yes");
    refuse("map:file=map.pfm,clamp=maybe", "no|yes");
    refuse("map:file=map.pfm,channel=alpha", "luminance|red|green|blue");
    refuse("map:file=nothing.hdr", "nothing.hdr");
    refuse("map:width=1", "1 is not between 2 and 16384");
    ps_integrand *self = test_integrand("map:width=8", TEST_SPHERE);
    assert_string_equal(ps_integrand_note(self), "8 x 4 pixels made up for want of a file");
    ps_integrand_destroy(self);
    self = test_integrand("map:file=map.pfm,clamp=yes", TEST_SPHERE);
    assert_string_equal(ps_integrand_note(self),
                        "4 x 3 pixels cover the sphere, which are not 2:1; 1 pixels were negative "
                        "or not finite, and count as 0");
    ps_integrand_destroy(self);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_of_values),
        cmocka_unit_test(all_degrees_are_the_energy),
        cmocka_unit_test(turns_change_nothing),
        cmocka_unit_test(closed_forms),
        cmocka_unit_test(sampled_functions),
        cmocka_unit_test(made_up_light),
        cmocka_unit_test(words),
    };
    return cmocka_run_group_tests_name("maps", tests, test_enter_lobes, test_leave_lobes);
}
