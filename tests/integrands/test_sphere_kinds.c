/* Caps against tests/reference, large degrees, notes and refusals of integrands of the sphere and
 * the hemisphere. */
#include "harness_integrands.h"

#include "math/pi.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- degrees -------------------------------------------------------------------------------- */

/* Degrees that are asked for, whatever the width. */
static void large_degrees(void **state) {
    enum { MOST = 40000 };
    static const char *const texts[] = {"cap:angle=1e-6",      "cap:angle=3.14159", "lobe:n=1e6",
                                        "lobe:n=0.001",        "phong:n=1e6",       "glossy:n=1e5",
                                        "harmonic:degree=1000"};
    double *f = calloc(MOST + 1, sizeof *f);
    (void)state;
    for (size_t i = 0; i < 2 * sizeof texts / sizeof *texts; i++) {
        ps_integrand *self = NULL;
        ps_error error = {0};
        const char *const text = texts[i / 2];
        if (ps_integrand_parse(&self, text, i % 2 == 0 ? TEST_SPHERE : TEST_HEMISPHERE, &error) !=
            PSPEC_OK) {
            assert_string_equal(text, "cap:angle=3.14159");
            continue;
        }
        double sum = 0;
        assert_ok(ps_integrand_degrees(self, MOST, f, error));
        for (size_t l = 0; l <= MOST; l++) {
            assert_true(isfinite(f[l]) && f[l] >= 0);
            sum += l > 0 ? f[l] : 0;
        }
        assert_true(sum <= ps_integrand_energy(self) + 1e-13 * (f[0] + sum));
        ps_integrand_destroy(self);
    }
    free(f);
}

/* ---- caps ------------------------------------------------------------------------------------ */

static double cell(const cJSON *row, int column) {
    return test_number(cJSON_GetArrayItem(row, column));
}

static void caps(void **state) {
    enum { LAST_ROW = 2000 };
    const double relative = 1e-12; /* of the reference's README, of F_l0 */
    cJSON *json = test_read_reference("tables.json");
    const cJSON *table = NULL;
    (void)state;
    cJSON_ArrayForEach(table, cJSON_GetObjectItem(json, "cap")) {
        char text[64];
        double f[LAST_ROW + 1];
        const cJSON *row = NULL;
        snprintf(text, sizeof text, "cap:angle=%.17g", test_field(table, "theta0"));
        ps_integrand *self = test_integrand(text, TEST_SPHERE);
        const double energy = ps_integrand_energy(self);
        assert_ok(ps_integrand_degrees(self, LAST_ROW, f, error));
        test_near(text, "the energy", energy, test_field(table, "energy_l>=1"), relative * energy);
        double worst = 0;
        cJSON_ArrayForEach(row, cJSON_GetObjectItem(table, "rows")) {
            const double exact = fabs(cell(row, 1));
            const double size = sqrt(f[(size_t)cell(row, 0)]);
            worst = fmax(worst, exact > 1e-15 ? fabs(size - exact) / exact : 0);
            test_near(text, "a coefficient", size, exact, relative * exact + 1e-15);
        }
        print_message("%-32s coefficients are %.2g off\n", text, worst);
        ps_integrand_destroy(self);
    }
    cJSON_Delete(json);
}

/* Small caps are disks, whose overlap is a lens. */
static void small_caps(void **state) {
    const double t = 1e-5;
    ps_integrand *self = test_integrand("cap:angle=1e-5", TEST_SPHERE);
    const double area = ps_integrand_integral(self);
    (void)state;
    for (int i = 0; i <= 20; i++) {
        const double x = 1 - pow(2 * t * i / 20, 2) / 2;
        const double q = asin(sqrt((1 - x) / 2)) / t; /* g/(2t) of the rounded x */
        const double lens = q < 1 ? 2 / PS_PI * (acos(q) - q * sqrt((1 - q) * (1 + q))) : 0;
        test_near("small cap", "the overlap", self->kind->correlation(self, &x) / area, lens, 1e-9);
    }
    ps_integrand_destroy(self);
}

/* ---- files and refusals ---------------------------------------------------------------------- */

static void files_and_notes(void **state) {
    ps_integrand *self = test_integrand("zonal:file=lobe.txt", TEST_SPHERE);
    (void)state;
    assert_true(ps_integrand_is_isotropic(self));
    ps_integrand_destroy(self);
    self = test_integrand("glossy:n=3", TEST_SPHERE);
    assert_non_null(strstr(ps_integrand_note(self), "cut at the horizon"));
    ps_integrand_destroy(self);
    self = test_integrand("glossy:n=3", TEST_HEMISPHERE);
    assert_null(ps_integrand_note(self));
    ps_integrand_destroy(self);
    self = test_integrand("lobe:n=3", TEST_HEMISPHERE);
    assert_non_null(strstr(ps_integrand_note(self), "horizon"));
    ps_integrand_destroy(self);
}

static void refuses(const char *text, ps_integrand_place place, const char *part) {
    ps_integrand *self = NULL;
    ps_error error = {0};
    assert_int_not_equal(ps_integrand_parse(&self, text, place, &error), PSPEC_OK);
    assert_null(self);
    if (strstr(error.message, part) == NULL) {
        fail_msg("%s: \"%s\" lacks \"%s\"", text, error.message, part);
    }
}

static void refusals(void **state) {
    static const char *const names[] = {"cap",     "harmonic",   "square",    "lobe",
                                        "diffuse", "glossy:n=3", "phong:n=3", "zonal:file=a"};
    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        refuses(names[i], (ps_integrand_place){PS_SAMPLES_TORUS, 3}, "there is none on the torus");
    }
    refuses("disk", TEST_SPHERE, "there is none on the sphere");
    refuses("cap:angle=0", TEST_SPHERE, "above 0 and below pi");
    refuses("cap:angle=3.1415926535897931", TEST_SPHERE, "above 0 and below pi");
    refuses("cap:angle=4", TEST_SPHERE, "angle of integrand cap");
    refuses("cap:angle=1.6", TEST_HEMISPHERE, "angle=1.6: a cap of the hemisphere");
    refuses("cap:axis=0x0x0", TEST_SPHERE, "axis=0x0x0: 0 is no direction");
    refuses("cap:axis=1x2", TEST_SPHERE, "3 with x between them");
    refuses("cap:axis=1x2xy", TEST_SPHERE, "axis of integrand cap");
    refuses("cap:degree=3", TEST_SPHERE, "degree");
    refuses("cap:axis=0x0x-1", TEST_HEMISPHERE,
            "integrand cap: axis=0x0x-1: integrands of the hemi");
    refuses("harmonic:axis=1x0x0", TEST_HEMISPHERE, "have the axis z, 0x0x1");
    refuses("square:axis=1e-9x0x1", TEST_HEMISPHERE, "have the axis z, 0x0x1");
    refuses("lobe:axis=1", TEST_HEMISPHERE, "have the axis z, 0x0x1");
    refuses("harmonic:degree=0", TEST_SPHERE, "degree of integrand harmonic");
    refuses("harmonic:degree=1001", TEST_SPHERE, "degree of integrand harmonic");
    refuses("harmonic:degree=2.5", TEST_SPHERE, "degree of integrand harmonic");
    refuses("harmonic:degree=3", TEST_HEMISPHERE, "degree=3: on the hemisphere");
    refuses("lobe:n=0", TEST_SPHERE, "n of integrand lobe");
    refuses("lobe:n=1e7", TEST_SPHERE, "n of integrand lobe");
    refuses("diffuse:n=2", TEST_SPHERE, "has no parameters");
    refuses("glossy", TEST_SPHERE, "needs its exponent");
    refuses("glossy:n=0", TEST_SPHERE, "exponent n of the lobe");
    refuses("glossy:n=3,cut=half", TEST_SPHERE, "is not one of horizon, none");
    refuses("glossy:n=3,cut=none", TEST_HEMISPHERE,
            "integrand glossy: the lobe goes below the horizon");
    refuses("phong", TEST_SPHERE, "needs its exponent");
    refuses("zonal", TEST_SPHERE, "needs its table");
    refuses("zonal:file=absent.txt", TEST_SPHERE, "absent.txt");
    refuses("zonal:file=lobe.txt", TEST_HEMISPHERE,
            "integrand zonal: the lobe goes below the horizon");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(large_degrees), cmocka_unit_test(caps), cmocka_unit_test(small_caps),
        cmocka_unit_test_setup_teardown(files_and_notes, test_enter_lobes, test_leave_lobes),
        cmocka_unit_test_setup_teardown(refusals, test_enter_lobes, test_leave_lobes)};
    return cmocka_run_group_tests_name("sphere kinds", tests, NULL, NULL);
}
